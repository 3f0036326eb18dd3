# display_list.awk: generates JavaScript from the rows of petri-display-list.inc: functions that read the operands of
# commands with a reader r and pass them to a painter p, the numbers of operands of path elements, and words.
function camel_case(name,    parts, count, i, out) {
    count = split(tolower(name), parts, "_")
    out = parts[1]
    for (i = 2; i <= count; i++)
        out = out toupper(substr(parts[i], 1, 1)) substr(parts[i], 2)
    return out
}
BEGIN {
    sizes["NUMBER"] = sizes["ALPHA"] = sizes["FLAG"] = sizes["WORD"] = 1
    sizes["PAIR"] = 2
    reads["LIST"] = reads["FILTER"] = reads["EFFECT"] = "list"
    split("COLOUR MATRIX STOPS STRING PATH PIXELS PAINT", types)
    for (i in types)
        reads[types[i]] = tolower(types[i])
}
# Adds code that reads `run` successive numbers. Spreading an array is slower, but shorter.
function add_numbers() {
    if (run > 6)
        add("...r.numbers(" run ")")
    for (; run > 0 && run <= 6; run--)
        add("r.number()")
    run = 0
}
function add(code) {
    arguments = arguments (arguments == "" ? "" : ", ") code
}
/^PETRI_(COMMAND|PAINT|PATH_ELEMENT)\(/ {
    match($0, /\([A-Z_]+/)
    name = camel_case(substr($0, RSTART + 1, RLENGTH - 1))
    rest = substr($0, RSTART + RLENGTH)
    sub(/, ?"[^"]*"\)$/, "", rest) # the text
    arguments = ""
    run = size = 0
    while (match(rest, /[A-Z]+\([^)]*\)/)) {
        split(substr(rest, RSTART, RLENGTH - 1), operand, /[(, "]+/)
        numbers = operand[1] == "NUMBERS" ? operand[3] : sizes[operand[1]]
        run += numbers
        size += numbers
        if (operand[1] == "WORD") {
            text = substr(rest, RSTART, RLENGTH - 2)
            sub(/.*"/, "", text)
            gsub(/, /, "', '", text)
            words = words "    " operand[2] ": ['" text "'],\n"
        } else if (!numbers) {
            add_numbers()
            add("r." reads[operand[1]] "()")
        }
        rest = substr(rest, RSTART + RLENGTH)
    }
    add_numbers()
    if (/^PETRI_PATH/)
        elements = elements "    ['" name "', " size "],\n"
    else
        commands = commands "    ['" name "', (r, p) => p." name "(" arguments ")],\n"
}
END {
    printf "export const COMMANDS = [\n%s];\nexport const PATH_ELEMENTS = [\n%s];\n", commands, elements
    printf "export const WORDS = {\n%s};\n", words
}
