# check.sh: what `petri check` says beyond faults. Part of run.sh.

cat >lints.fl <<'END'
%pragma temp 60
let a=1 b=2
let sin=3
func f(x, y, z=1)
    x
!n v=f(1) w=f(1,2,3,4) u=f(1, 2, q=3) t=cos(1,2) s=a;sin
if 1
    !x
else
    !y
!m q=coz(1)
END
petri check lints.fl
check "warnings alone do not fail a check" status_is 0
check "a check writes nothing to stdout" empty out
check "an unknown pragma is told with the nearest name" has err "lints.fl:1:1: warning: unknown pragma 'temp'"
check "… which is tempo" has err "did you mean tempo?"
check "an unused let is told" has err "lints.fl:2:9: warning: unused let 'b'"
check "a used let is not" lacks err "unused let 'a'"
check "a name that hides a built-in is noted" has err "lints.fl:3:5: note: 'sin' hides the built-in"
check "unused parameters are told" count_is err "unused parameter" 2
check "a missing argument is told" has err "lints.fl:6:6: warning: no argument for 'y'"
check "surplus arguments are told" has err "4 arguments for a function of 3"
check "an unknown named argument is told" has err "no parameter 'q'"
check "the arguments of built-ins are counted" has err "2 arguments for cos(x)"
check "an else that is never reached is told" has err "lints.fl:7:4: warning: always true"
check "an unbound name is told with the nearest name" has err "did you mean 'cos'?"
check "the summary counts" last_line_is err "petri: 1 file checked: 0 errors, 10 warnings"
petri check --werror lints.fl
check "--werror makes warnings fail" status_is 1
petri run --frames 1 lints.fl
check "a run does not lint" lacks err "unused"

cat >clean.fl <<'END'
let a=1
func twice(_unused, x)
    x*2
for i in ..3
    !n v=twice(0, a)
END
petri check --werror clean.fl
check "a clean script passes --werror" status_is 0
check "… and says so in one line" lines_are err 1
cat >library.fl <<'END'
let shared=1
func helper(x)
    x+1
END
petri check --werror library.fl
check "a file that only binds names is a module: none is unused" status_is 0
