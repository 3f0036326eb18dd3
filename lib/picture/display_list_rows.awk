# display_list_rows.awk: generates rows from the lists in petri-draw.h, which describe the format of display lists: for
# language=c, macros as COMMAND(PATH, NUMBER(fill) NUMBER(stroke) NUMBER(rule) PATH(path)); for language=js, functions
# that read the operands of commands with a reader r and pass them to a painter p, and the numbers of operands of path
# elements. A row is the name of a command (PETRI_DRAW_), path element (PETRI_PATH_) or filter (PETRI_FILTER_), and its
# operands, which follow the colon in the comment.
BEGIN {
    MACROS = "COMMAND ELEMENT FILTER_KIND NUMBER NUMBERS TABLE MATRIX COLOUR PATH STOPS STRING PIXELS FILTER PAINT " \
        "DASHES COMMANDS"
    if (language == "c")
        print_defaults()
    types["matrix"] = types["colour"] = types["path"] = types["stops"] = types["string"] = types["pixels"] = 1
    types["filter"] = types["paint"] = types["dashes"] = types["commands"] = 1
    lists["dashes"] = lists["commands"] = lists["filter"] = 1 # a length, then that many numbers
    macros["DRAW"] = "COMMAND"; macros["PATH"] = "ELEMENT"; macros["FILTER"] = "FILTER_KIND"
    arrays["DRAW"] = "COMMANDS"; arrays["PATH"] = "PATH_ELEMENTS"
}
# Rows and operands whose macros are not defined are ignored. All macros are undefined at the end.
function print_defaults(    names, count, i) {
    count = split(MACROS, names, " ")
    for (i = 1; i <= count; i++)
        printf "#ifndef %s\n#define %s(...)\n#endif\n", names[i], names[i]
}
function camel_case(name,    parts, count, i, out) {
    count = split(tolower(name), parts, "_")
    out = parts[1]
    for (i = 2; i <= count; i++)
        out = out toupper(substr(parts[i], 1, 1)) substr(parts[i], 2)
    return out
}
# Returns the row's part for an operand such as "size (width, height)", "elements (20)", "family string" or "alpha".
function operand_row(text,    remark, words, count, type, parts) {
    remark = ""
    if (match(text, / \(.*\)$/)) {
        remark = substr(text, RSTART + 2, RLENGTH - 3)
        text = substr(text, 1, RSTART - 1)
    }
    gsub(/-/, " ", text)
    count = split(text, words, " ")
    type = words[count]
    gsub(/ /, "_", text)
    if (text !~ /^[a-z]+(_[a-z]+)*$/) {
        print "cannot read the operand '" text "' of PETRI_" prefix "_" name >"/dev/stderr"
        exit failed = 1
    }
    if (type in types)
        return language == "c" ? toupper(type) "(" text ")" : "r." (type in lists ? "list" : type) "()"
    if (remark ~ /^[0-9]+$/)
        return language == "c" ? "TABLE(" text ", " remark ")" : "r.numbers(" remark ")"
    if (language == "js" && remark ~ /^0: [a-z ]+(, [0-9]: [a-z ]+)+$/)
        add_words(text, remark)
    parts = remark ~ /^[a-z]+(, [a-z]+)+$/ ? split(remark, words, ", ") : 1
    size += parts
    if (language == "c")
        return parts > 1 ? "NUMBERS(" text ", " parts ")" : "NUMBER(" text ")"
    return parts
}
# Adds the meanings of an operand's values, from a remark such as "0: upright, 1: oblique".
function add_words(name, remark) {
    gsub(/[0-9]: /, "", remark)
    gsub(/, /, "', '", remark)
    words_of_values = words_of_values "    " name ": ['" remark "'],\n"
}
# Returns JavaScript that reads successive numbers. Spreading an array is slower, but shorter.
function numbers_read(count,    out) {
    if (count > 6)
        return "...r.numbers(" count ")"
    for (out = ""; count > 0; count--)
        out = out (out == "" ? "" : ", ") "r.number()"
    return out
}
function joined(out, row) {
    return out (out == "" || row == "" ? "" : language == "js" ? ", " : " ") row
}
# Splits operands at commas outside brackets.
function operand_rows(text,    i, c, depth, part, row, run, out) {
    text = text ","
    for (i = 1; i <= length(text); i++) {
        c = substr(text, i, 1)
        depth += (c == "(") - (c == ")")
        if (c != "," || depth) {
            part = part c
            continue
        }
        gsub(/^ +| +$/, "", part)
        row = operand_row(part)
        part = ""
        if (row ~ /^[0-9]+$/) {
            run += row
        } else {
            out = joined(joined(out, numbers_read(run)), row)
            run = 0
        }
    }
    return joined(out, numbers_read(run))
}
match($0, /^ *PETRI_(DRAW|PATH|FILTER)_[A-Z_]+,/) {
    name = substr($0, RSTART, RLENGTH - 1)
    sub(/^ *PETRI_/, "", name)
    prefix = name
    sub(/_.*/, "", prefix)
    sub(/^[A-Z]+_/, "", name)
    if (match($0, /\/\/ /))
        comment = comment substr($0, RSTART + 3)
    at = match(comment, /: /)
    size = 0
    operands = at ? operand_rows(substr(comment, at + 2)) : ""
    comment = ""
    if (language == "c") {
        printf "%s(%s, %s)\n", macros[prefix], name, operands
    } else if (prefix != "FILTER") { # petri_filter_draw reads filters
        if (prefix != last)
            printf "%sexport const %s = [\n", last == "" ? "" : "];\n", arrays[prefix]
        printf prefix == "PATH" ? "    ['%s', %d],\n" : "    ['%s', %s],\n", camel_case(name),
            prefix == "PATH" ? size : "(r, p) => p." camel_case(name) "(" operands ")"
    }
    last = prefix
    next
}
/^ *\/\/ / {
    sub(/^ *\/\/ /, "")
    comment = comment $0 " "
    next
}
{ comment = "" }
END {
    if (failed || last == "")
        exit 1
    if (language == "js")
        printf "];\nexport const WORDS = {\n%s};\n", words_of_values
    count = language == "c" ? split(MACROS, words, " ") : 0
    for (i = 1; i <= count; i++)
        print "#undef " words[i]
}
