# habits.sh: each habit of habits.txt is answered with its hint, and what the hint proposes works. Part of run.sh.

# habit_field NUMBER ROW
habit_field() { printf '%s\n' "$2" | awk -F ' ~ ' -v n="$1" '{ print $n }'; }
habit_is_told() { grep -Fq -e "habit.fl:$1" err; }
habit_is_hinted() { [ "$1" = - ] || grep -Fxq -e "    $1" err; }

habits=0
while IFS= read -r row; do
    case $row in '#'*) continue ;; esac
    habits=$((habits + 1))
    wrong=$(habit_field 1 "$row")
    right=$(habit_field 4 "$row")
    printf '%b\n' "$wrong" >habit.fl
    petri check habit.fl
    check "habit $habits is told" habit_is_told "$(habit_field 2 "$row")"
    check "habit $habits has its hint" habit_is_hinted "$(habit_field 3 "$row")"
    [ "$right" = - ] && continue
    printf '%b\n' "$right" >habit.fl
    petri check --werror habit.fl
    check "habit $habits is right as it is proposed" status_is 0
    check "habit $habits is right without a word" lines_are err 1
done <"$here/habits.txt"
check "there are habits" [ "$habits" -gt 100 ]
