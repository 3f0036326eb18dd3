# syntax_hints.sh: tests that each mistake in syntax_hints.txt gets its hint, and that the proposed code works. Part of
# run.sh.

# hint_field NUMBER ROW: prints a field of a row, counted from 1.
hint_field() { printf '%s\n' "$2" | awk -F ' ~ ' -v n="$1" '{ print $n }'; }
hint_is_reported() { grep -Fq -e "mistake.fl:$1" err; }
hint_is_proposed() { [ "$1" = - ] || grep -Fxq -e "    $1" err; }

syntax_hints=0
while IFS= read -r row; do
    case $row in '#'*) continue ;; esac
    syntax_hints=$((syntax_hints + 1))
    wrong=$(hint_field 1 "$row")
    right=$(hint_field 4 "$row")
    printf '%b\n' "$wrong" >mistake.fl
    petri check mistake.fl
    check "mistake $syntax_hints is reported" hint_is_reported "$(hint_field 2 "$row")"
    check "mistake $syntax_hints has its hint" hint_is_proposed "$(hint_field 3 "$row")"
    [ "$right" = - ] && continue
    printf '%b\n' "$right" >mistake.fl
    petri check --werror mistake.fl
    check "the proposed code for mistake $syntax_hints passes" status_is 0
    check "the proposed code for mistake $syntax_hints has no warnings" lines_are err 1
done <"$here/syntax_hints.txt"
check "there are more than 100 syntax hints" [ "$syntax_hints" -gt 100 ]

# An unfinished binding is one error, and further mistakes are still reported.
while IFS= read -r row; do
    printf '%b\n' "${row#* ~ }" >mistake.fl
    petri check --format=gcc mistake.fl
    check "one error per mistake: ${row#* ~ }" lines_are out "${row%% ~ *}"
done <<'END'
1 ~ let a=5\n    b=\n\nfunc f(x)\n    x
1 ~ let a=1\n    b=\n    c=2\n!o a=a b=b c=c
1 ~ let a=5\n    b\n!o a=a\n!x\n    !y
1 ~ let a=5 b=\n    c=3\nfor i in ..3\n    !o
2 ~ let a=5\n    b=3+\n    c=4\nfor i in ..3\n    !o x=
2 ~ let a=1\n    b=\n    c=
3 ~ if 1\n    let a=1\n        b=\n    !x y=\n!z v=*
2 ~ let f(x)\n    x*2\n!o y=*
1 ~ let a=1\n    b=2 +\n    c=3 d=4\n    e=5\nif a\n    !x\nelse\n    !y
2 ~ let a=1\n    b=*\nletter=5
END
