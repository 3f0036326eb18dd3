#!/bin/sh
# check_public.sh SOURCE_ROOT: each public function has a comment before it, before its group, or after it. The comment
# states the lifetime of a returned pointer, and the statuses besides PETRI_OK. petri.h must have the rule on threads.
set -eu
cd "$1/lib/include"
grep -q "^// - Only one thread at a time may use a session" petri.h
grep -q 'take no handle may be called by any thread' petri.h
for header in petri petri-edit petri-ranks petri-archive petri-draw; do
    awk -v header=$header.h '
        function fault(what) {
            print header ":" FNR ": " name " " what
            faults = 1
        }
        /^$/ { comment = "" }
        /^\/\// { comment = after_declaration ? $0 : comment " " $0; after_declaration = 0 }
        /^PETRI_API/ { declaration = "" }
        /^PETRI_API/, /;/ { declaration = declaration " " $0 }
        /;/ && declaration != "" {
            match(declaration, /petri_[a-z_]+\(/)
            name = substr(declaration, RSTART, RLENGTH - 1)
            result = substr(declaration, 1, RSTART - 1)
            text = comment (match(declaration, /\/\/.*/) ? substr(declaration, RSTART) : "")
            if (text == "")
                fault("has no comment")
            else if ((result ~ /\*/ || result ~ /PetriValue|PetriColumn/) && text !~ /[Vv]alid|[Ll]ives|[Ff]ree/)
                fault("does not state the lifetime of its result")
            else if (result ~ /PetriStatus/ && text !~ /PETRI_[A-Z]+/)
                fault("names no status")
            declaration = ""
            after_declaration = 1
            count++
        }
        END { if (!count) fault("no functions found"); exit faults }' $header.h || faults=1
done
exit ${faults:-0}
