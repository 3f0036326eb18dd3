#!/bin/sh
# check_layers.sh SOURCE_ROOT: reads every #include "…" of lib/, grammar/ and src/ against layers.txt.
set -eu
cd "$1"

awk '
function complain(text) {
    printf "%s:%d: %s\n", FILENAME, FNR, text
    faults++
}

FILENAME == ARGV[1] {
    if ($0 ~ /^#/ || NF == 0)
        next
    room = $1
    sub(/:$/, "", room)
    is_room[room] = 1
    may[room, room] = 1
    for (i = 2; i <= NF; i++) {
        may[room, $i] = 1
        if (!($i in is_room) && $i !~ /^petri/)
            complain("room " room " may only include rooms that stand above it, not " $i)
    }
    next
}

FNR == 1 {
    files++
    parts = split(FILENAME, part, "/")
    room = part[parts - 1]
    if (!(room in is_room))
        complain("layers.txt does not know the room " room)
}

/^[ \t]*#[ \t]*include[ \t]*"/ {
    split($0, quoted, "\"")
    header = quoted[2]
    includes++
    if (header ~ /^\.|\/\.\./)
        complain("include \"" header "\" goes by a relative path; write \"room/file.h\"")
    else if (header ~ /\//)
        target = substr(header, 1, index(header, "/") - 1)
    else if (header ~ /^petri(-draw)?\.h$/)
        target = substr(header, 1, length(header) - 2)
    else if (header == "parser.h")
        target = "grammar"
    else
        complain("include \"" header "\" names no room")
    if (target != "" && !((room, target) in may))
        complain("room " room " may not include " target " (\"" header "\")")
    target = ""
}

END {
    if (files == 0 || includes == 0) {
        print "no file to check"
        faults++
    }
    exit faults > 0
}
' tests/lint/layers.txt lib/*/*.[ch] grammar/*.re grammar/*.y src/*/*.[ch]
