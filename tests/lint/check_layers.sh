#!/bin/sh
# check_layers.sh SOURCE_ROOT BUILD_ROOT: no room includes or calls one that layers.txt does not allow it. Looked at are the
# headers that the compiler has read for each object file, those behind other headers among them, the symbols that each
# object file takes from others, and the #include lines, for what this build leaves out.
set -eu
cd "$1"
root=$PWD
table=$root/tests/lint/layers.txt
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# Lines `ROOM TARGET WHERE WHAT`.
grep -n '^[ 	]*#[ 	]*include[ 	]*"' lib/*/*.[ch] grammar/*.re grammar/*.y src/*/*.[ch] | awk -F '"' '
    {
        split($1, place, ":")
        count = split(place[1], part, "/")
        header = $2
        if (header ~ /^\.|\/\.\./)
            target = "relative-path"
        else if (header ~ /\//)
            target = substr(header, 1, index(header, "/") - 1)
        else
            target = header == "parser.h" ? "grammar" : substr(header, 1, length(header) - 2)
        print part[count - 1], target, place[1] ":" place[2], "includes \"" header "\""
    }' >"$scratch/lines"

# The room of an object file is its folder; in src/ meson puts that before the name of the file.
room_of='
    function room_of(object, part, name) {
        split(object, part, "/")
        if (part[1] == "lib")
            return part[2]
        if (part[1] == "grammar")
            return part[1]
        name = part[3]
        return name ~ /^meson-generated/ ? "cli" : substr(name, 1, index(name, "_") - 1)
    }'
cd "$2"
ninja -t deps | awk "$room_of"'
    /^[^ ]/ { object = $1; sub(/:$/, "", object); ours = object ~ /^(lib|src|grammar)\/.*\.o$/; room = room_of(object) }
    ours && /^[^ ]/ { print object >objects }
    ours && /^ .*\.h$/ && match($1, /(^|\/)(lib\/[a-z]+|src\/[a-z]+|grammar)\/[a-z_-]+\.h$/) {
        count = split($1, part, "/")
        target = part[count - 1]
        if (target == "include")
            target = substr(part[count], 1, length(part[count]) - 2)
        print room, target, object, "reads " target "/" part[count]
    }' objects="$scratch/objects" >"$scratch/headers"
xargs nm -gA <"$scratch/objects" | awk "$room_of"'
    {
        object = $1
        sub(/:.*/, "", object)
        name = $NF
    }
    $(NF - 1) == "U" { taken[++count] = object " " name; next }
    !(name in owner) {
        owner[name] = room_of(object)
        # What is public is used by its name in petri.h.
        if (name ~ /^petri_/ && owner[name] ~ /^(session|draw)$/)
            owner[name] = owner[name] == "draw" ? "petri-draw" : "petri"
    }
    END {
        for (i = 1; i <= count; i++) {
            split(taken[i], use, " ")
            if (use[2] in owner)
                print room_of(use[1]), owner[use[2]], use[1], "calls " use[2]
        }
    }' >"$scratch/symbols"

status=0
for found in lines headers symbols; do
    awk -v found=$found '
        function complain(text) {
            print text
            faults++
        }
        FNR == NR {
            if ($0 ~ /^#/ || NF == 0)
                next
            room = $1
            sub(/:$/, "", room)
            is_room[room] = may[room, room] = 1
            for (i = 2; i <= NF; i++) {
                may[room, $i] = 1
                # Behind a header there may be those that its room may use.
                if (found == "headers")
                    for (low in is_room)
                        if (($i, low) in may)
                            may[room, low] = 1
                if (!($i in is_room) && $i !~ /^petri/)
                    complain("layers.txt: " room " may only use rooms that stand above it, not " $i)
            }
            next
        }
        { uses++ }
        !($1 in is_room) && !unknown[$1]++ { complain("layers.txt does not know the room " $1) }
        !(($1, $2) in may) {
            what = $4
            for (i = 5; i <= NF; i++)
                what = what " " $i
            complain($3 ": " what ", but " $1 " may not use " $2)
        }
        END {
            if (uses < 200)
                complain("only " (uses + 0) " " found " to look at")
            exit faults > 0
        }' "$table" "$scratch/$found" || status=1
done
exit $status
