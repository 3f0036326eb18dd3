#!/bin/sh
# check_layers.sh SOURCE_ROOT BUILD_ROOT: components include and call only components that layers.txt allows. Checks the
# headers that the compiler read for each object file, directly or indirectly, the symbols that each object file uses,
# and, for sources outside this build, the #include lines.
set -eu
cd "$1"
root=$PWD
table=$root/tests/lint/layers.txt
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# Writes lines `COMPONENT TARGET POSITION TEXT`.
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
            target = header ~ /\.inc$/ ? "petri-draw" : header == "parser.h" ? "grammar" : substr(header, 1, length(header) - 2)
        print part[count - 1], target, place[1] ":" place[2], "includes \"" header "\""
    }' >"$scratch/lines"

# The component of an object file follows from its folder. In src/, meson prefixes the name of the object file with the
# folder.
component_of='
    function component_of(object, part, name) {
        split(object, part, "/")
        if (part[1] == "lib")
            return part[2]
        if (part[1] == "grammar")
            return part[1]
        name = part[3]
        return name ~ /^meson-generated/ ? "cli" : substr(name, 1, index(name, "_") - 1)
    }'
cd "$2"
ninja -t deps | awk "$component_of"'
    /^[^ ]/ { object = $1; sub(/:$/, "", object); ours = object ~ /^(lib|src|grammar)\/.*\.o$/; component = component_of(object) }
    ours && /^[^ ]/ { print object >objects }
    ours && /^ .*\.h$/ && match($1, /(^|\/)(lib\/[a-z0-9]+|src\/[a-z0-9]+|grammar)\/[a-z_-]+\.h$/) {
        count = split($1, part, "/")
        target = part[count - 1]
        if (target == "include")
            target = substr(part[count], 1, length(part[count]) - 2)
        print component, target, object, "reads " target "/" part[count]
    }' objects="$scratch/objects" >"$scratch/headers"
xargs nm -gA <"$scratch/objects" | awk "$component_of"'
    FNR == NR { header[$2] = $1; next }
    {
        object = $1
        sub(/:.*/, "", object)
        name = $NF
    }
    $(NF - 1) == "U" { used[++count] = object " " name; next }
    # A weak definition is the default of a function that a program may replace.
    !(name in owner) || $(NF - 1) == "W" {
        owner[name] = component_of(object)
        # Public functions belong to the component of their header.
        if (name in header)
            owner[name] = header[name]
    }
    END {
        for (i = 1; i <= count; i++) {
            split(used[i], use, " ")
            if (use[2] in owner)
                print component_of(use[1]), owner[use[2]], use[1], "calls " use[2]
        }
    }' "$root/tests/lint/abi.txt" - >"$scratch/symbols"

status=0
for found in lines headers symbols; do
    awk -v found=$found '
        function report_fault(text) {
            print text
            faults++
        }
        FNR == NR {
            if ($0 ~ /^#/ || NF == 0)
                next
            component = $1
            sub(/:$/, "", component)
            is_component[component] = may[component, component] = 1
            for (i = 2; i <= NF; i++) {
                may[component, $i] = 1
                # A component may read further headers indirectly: a header that it includes may itself include whatever
                # the component of that header may include.
                if (found == "headers")
                    for (low in is_component)
                        if (($i, low) in may)
                            may[component, low] = 1
                if (!($i in is_component) && $i !~ /^petri/)
                    report_fault("layers.txt: " component " may only use components listed above it, not " $i)
            }
            next
        }
        { uses++ }
        !($1 in is_component) && !unknown[$1]++ { report_fault("layers.txt has no component " $1) }
        !(($1, $2) in may) {
            what = $4
            for (i = 5; i <= NF; i++)
                what = what " " $i
            report_fault($3 ": " what ", but " $1 " may not use " $2)
        }
        END {
            if (uses < 200)
                report_fault("found only " (uses + 0) " " found)
            exit faults > 0
        }' "$table" "$scratch/$found" || status=1
done
exit $status
