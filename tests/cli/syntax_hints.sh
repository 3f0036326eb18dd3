# syntax_hints.sh: each habit of syntax_hints.txt is answered with its hint, and what the hint proposes works. Part of run.sh.

# hint_field NUMBER ROW
hint_field() { printf '%s\n' "$2" | awk -F ' ~ ' -v n="$1" '{ print $n }'; }
hint_is_reported() { grep -Fq -e "habit.fl:$1" err; }
hint_is_proposed() { [ "$1" = - ] || grep -Fxq -e "    $1" err; }

syntax_hints=0
while IFS= read -r row; do
    case $row in '#'*) continue ;; esac
    syntax_hints=$((syntax_hints + 1))
    wrong=$(hint_field 1 "$row")
    right=$(hint_field 4 "$row")
    printf '%b\n' "$wrong" >habit.fl
    petri check habit.fl
    check "habit $syntax_hints is told" hint_is_reported "$(hint_field 2 "$row")"
    check "habit $syntax_hints has its hint" hint_is_proposed "$(hint_field 3 "$row")"
    [ "$right" = - ] && continue
    printf '%b\n' "$right" >habit.fl
    petri check --werror habit.fl
    check "habit $syntax_hints is right as it is proposed" status_is 0
    check "habit $syntax_hints is right without a word" lines_are err 1
done <"$here/syntax_hints.txt"
check "there are syntax_hints" [ "$syntax_hints" -gt 100 ]
