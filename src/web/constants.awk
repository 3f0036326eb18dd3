# constants.awk: generates names of enumerators as JavaScript, from public headers and the rows of
# composite_list.h. Arrays are indexed by the values; in objects, names are mapped to values. With -v language=ts,
# generates the types of the names in TypeScript.
BEGIN {
    arrays["PetriStatus"] = "STATUSES"; prefixes["PetriStatus"] = "PETRI_"
    arrays["PetriLevel"] = "LEVELS"; prefixes["PetriLevel"] = "PETRI_"
    arrays["PetriTokenKind"] = "TOKENS"; prefixes["PetriTokenKind"] = "PETRI_TOKEN_"
    split("STATUSES Status LEVELS Level TOKENS TokenKind SECTIONS Section COMPOSITES Composite", pairs)
    for (i = 1; i in pairs; i += 2)
        types[pairs[i]] = pairs[i + 1]
}
{ sub(/ *\/\/.*/, "") }
/^typedef enum / { kind = $3 }
/^enum \{/ { kind = "enum" }
kind in arrays || kind == "enum" {
    text = text " " $0
    if ($0 !~ /\}/)
        next
    sub(/^[^{]*\{ */, "", text)
    sub(/,? *\}.*/, "", text)
    count = split(text, names, / *, */)
    list = ""
    for (i = 1; i <= count; i++) {
        if (kind == "enum" && names[i] !~ /^PETRI_PRINT_/)
            continue
        sub("^" (kind == "enum" ? "PETRI_PRINT_" : prefixes[kind]), "", names[i])
        name = tolower(names[i])
        sub(/ = /, ": ", name)
        list = list (list == "" ? "" : ", ") (kind == "enum" ? name : "'" name "'")
    }
    if (list != "")
        print_list(kind == "enum" ? "SECTIONS" : arrays[kind], kind == "enum" ? "{ " : "[", list, kind == "enum" ? " }" : "]")
    kind = text = ""
}
/^(PREMULTIPLIED|SEPARABLE|NONSEPARABLE)\(/ {
    split($0, parts, "\"")
    comma = composites == "" ? "" : ", "
    composites = composites comma "'" parts[4] "'"
    modes = modes comma "'" parts[2] "'"
}
END {
    print_list("COMPOSITES", "[", composites, "]")
    if (language != "ts")
        print_list("CANVAS_MODES", "[", modes, "]")
}
# Breaks lines after at most 120 characters.
function print_list(name, open, list, close_,    line) {
    if (language == "ts") {
        gsub(/: [0-9]+/, "", list)
        gsub(/[^, ']+/, "'&'", list)
        gsub(/''/, "'", list)
        gsub(/, /, " | ", list)
        line = "export type " types[name] " = " list ";"
    } else {
        line = "export const " name " = " open list close_ ";"
    }
    while (length(line) > 120 && match(substr(line, 1, 120), /.*[,|] /)) {
        print substr(line, 1, RLENGTH - 1)
        line = "    " substr(line, RLENGTH + 1)
    }
    print line
}
