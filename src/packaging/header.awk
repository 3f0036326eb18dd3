# header.awk: generates the manual page of a public header, such as petri.h(3). Variables: version.
#
# Comments at the start of a line become text. Declarations are copied with their trailing comments.
# Preprocessor directives are omitted, but rows that are included as enumerators are shown.
function escaped(text) {
    gsub(/\\/, "\\e", text)
    gsub(/-/, "\\-", text)
    gsub(/'/, "\\(aq", text)
    gsub(/`/, "\\(ga", text)
    gsub(/\^/, "\\(ha", text)
    gsub(/~/, "\\(ti", text)
    return (text ~ /^\./ ? "\\\\&" : "") text
}
function show(kind) {
    if (shown == kind)
        return
    if (shown == "code")
        print ".EE"
    if (kind == "code")
        print ".PP\n.EX"
    else if (kind == "text" && started)
        print ".PP"
    shown = kind
}
FNR == 1 {
    name = FILENAME
    sub(/.*\//, "", name)
    summary = $0
    sub(/^[^:]*: /, "", summary)
    end = index(summary, ". ")
    $0 = end ? "// " substr(summary, end + 2) : "//"
    summary = substr(summary, 1, end ? end - 1 : length(summary) - 1)
    upper = toupper(name)
    gsub(/-/, "\\-", upper)
    printf ".TH %s 3 \"\" \"petri %s\" petri\n.SH NAME\n%s \\- %s\n", upper, version, escaped(name), escaped(summary)
    printf ".SH SYNOPSIS\n.B #include <%s>\n.PP\ncc ... $(pkg\\-config \\-\\-cflags \\-\\-libs %s)\n", escaped(name),
        escaped(name ~ /-draw/ ? "petri-draw" : "petri")
    print ".SH DESCRIPTION"
}
/^#define PETRI.*##name,$/ { # the next line includes the rows
    row = "^(" substr($2, 1, index($2, "(") - 1) (/COMMAND/ ? "|PETRI_PAINT)[(]" : ")[(]")
    rows = FILENAME
    sub(/[^\/]*$/, "petri-display-list.inc", rows)
    while ((getline line < rows) > 0)
        if (line ~ row)
            print "    " escaped(line)
    close(rows)
    next
}
/^#(if|ifdef|ifndef|else|endif|pragma|include|error|elif)/ || /\\$/ || /^extern "C"/ || (/^}$/ && !depth) { next }
/^#define PETRI(_DRAW)?_H$/ || /^#define PETRI_API/ { next }
{ sub(/^PETRI_API /, "") }
/^$/ {
    pending = 1
    next
}
depth == 0 && /^\/\// {
    if (pending)
        show("")
    pending = 0
    line = $0
    sub(/^\/\/ ?/, "", line)
    if (line == "")
        show("")
    else if (line ~ /^- /) {
        show("item")
        print ".IP \\(bu 2\n" escaped(substr(line, 3))
        started = 1
    } else {
        if (shown != "item" || line !~ /^  /)
            show("text")
        sub(/^ +/, "", line)
        print escaped(line)
        started = 1
    }
    next
}
{
    behind = shown == "code"
    show("code")
    if (pending && behind)
        print ".sp"
    pending = 0
    sub(/PETRI_API /, "")
    print escaped($0)
    text = $0
    sub(/\/\/.*/, "", text)
    depth += gsub(/{/, "", text) - gsub(/}/, "", text)
}
END {
    show("")
    printf ".SH SEE ALSO\n.BR petri (1),\n.BR petri (5)\n"
}
