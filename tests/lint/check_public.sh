#!/bin/sh
# check_public.sh SOURCE_ROOT: each public function has a comment: before it, before the functions that it stands with, or
# behind it. It says how long what a pointer leads to lives, and which statuses there are beside PETRI_OK. Threads: all
# but the functions that take no handle keep to the rule at the top of petri.h.
set -eu
cd "$1/lib/include"
grep -q '^// - .*used by one thread at a time' petri.h
grep -q 'take no handle may be called by any thread' petri.h
for header in petri petri-draw; do
    awk -v header=$header.h '
        function fault(what) {
            print header ":" FNR ": " name " " what
            faults = 1
        }
        /^$/ { comment = "" }
        /^\/\// { comment = behind ? $0 : comment " " $0; behind = 0 }
        /^PETRI_API/ { declaration = "" }
        /^PETRI_API/, /;/ { declaration = declaration " " $0 }
        /;/ && declaration != "" {
            match(declaration, /petri_[a-z_]+\(/)
            name = substr(declaration, RSTART, RLENGTH - 1)
            result = substr(declaration, 1, RSTART - 1)
            said = comment (match(declaration, /\/\/.*/) ? substr(declaration, RSTART) : "")
            if (said == "")
                fault("has no comment")
            else if ((result ~ /\*/ || result ~ /PetriValue|PetriColumn/) && said !~ /[Vv]alid|[Ll]ives|[Ff]ree/)
                fault("does not say how long its result lives")
            else if (result ~ /PetriStatus/ && said !~ /PETRI_[A-Z]+/)
                fault("names no status")
            declaration = ""
            behind = 1
            count++
        }
        END { if (!count) fault("nothing found"); exit faults }' $header.h || faults=1
done
exit ${faults:-0}
