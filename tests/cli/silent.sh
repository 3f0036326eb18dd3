# silent.sh: tests that each script in silent_mistakes.txt, which is valid but does not do what its author wants, is
# reported, and that the proposed script is not. Part of run.sh.

silent=0
while IFS= read -r row; do
    case $row in '#'*) continue ;; esac
    silent=$((silent + 1))
    printf '%b\n' "${row%% ~ *}" >mistake.fl
    rest=${row#* ~ }
    expected=${rest%% ~ *}
    right=${rest#* ~ }
    petri check --format=gcc mistake.fl
    check "silent mistake $silent is reported by check" has out "mistake.fl:$expected"
    cp out reported
    petri run mistake.fl --frames 3
    check "silent mistake $silent is reported by run" has err "mistake.fl:${expected%%;*}"
    check "silent mistake $silent is reported once" count_is err " warning: " "$(grep -c . reported)"
    [ "$right" = - ] && continue
    printf '%b\n' "$right" >mistake.fl
    petri check --werror mistake.fl
    check "the proposed code for silent mistake $silent has no warnings" lines_are err 1
    petri run --frames 3 mistake.fl
    check "a run of the proposed code for silent mistake $silent has no warnings" lacks err " warning: "
done <"$here/silent_mistakes.txt"
check "there are more than 30 silent mistakes" [ "$silent" -gt 30 ]

# Scripts that are unusual but right are not reported.
while IFS= read -r row; do
    case $row in '#'*) continue ;; esac
    printf '%b\n' "$row" >mistake.fl
    petri check --werror mistake.fl
    check "no false alarm: $row" last_line_is err "petri: 1 file checked: 0 errors, 0 warnings"
done <"$here/silent_right.txt"
