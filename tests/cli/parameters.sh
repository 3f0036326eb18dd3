# parameters.sh: tests of parameters (`let NAME=NAME or VALUE`) and -D. Part of run.sh.

cat >cells.fl <<'END'
let CELLS=CELLS or 200 -- 1..500 how many cells
    SPEED=SPEED or 1.5 TITLE=TITLE or 'a dish'
let FIXED=7
import bar from 'cells_module.fl'
!n c=CELLS s=SPEED t=TITLE f=FIXED b=bar
END
cat >cells_module.fl <<'END'
let WIDE=WIDE or 3 -- 1..9 metres
    bar=WIDE*2
END

petri check --werror cells.fl
check "a parameter's name on the right is not an unbound name in check" status_is 0
petri run --frames 2 --print tree,error cells.fl
check "a parameter's name on the right is not an unbound name in a run" empty err
check "a parameter's name on the right is not an unbound name in a module" out_is "@0 time=0 beat=0
!n c=200 s=1.5 t='a dish' f=7 b=6
@1 time=0.016666666666666666 beat=0.03333333333333333
!n c=200 s=1.5 t='a dish' f=7 b=6"
petri run --frames 1 --print tree -D CELLS=5 -D 'TITLE=b c' cells.fl
check "-D sets parameters" out_is "@0 time=0 beat=0
!n c=5 s=1.5 t='b c' f=7 b=6"
check "setting parameters gives no message" empty err

# Optional definitions with a plain default are parameters. Files that are included count, too.
cat >optional_part.fl <<'END'
let WIDTH=RECORD or (7;8)
!n a=WIDTH b=(1 if FAST else 2) c=WRONG+1 d=(1 if BOTH)
END
cat >optional.fl <<'END'
%include "optional_part.fl"
let GAP=DISTANCE or -5 -- -9..9 pixels
    SIZE=FILM or 9 FRAMES=(60 if FILM)
    CELLS=CELSL or 3
    OTHER=SOME or time
!n g=GAP s=SIZE f=FRAMES c=CELLS o=OTHER b=BOTH
END
petri run --parameters optional.fl
check "an optional definition is a parameter if it occurs once and has a plain default" out_is "RECORD    (7;8)
DISTANCE  -5     -9..9  pixels"
petri run --frames 1 --print tree optional.fl
check "only names that are used without a test are unbound" \
    [ "$(grep -o "unbound name '[A-Z]*'" err | sort -u | tr '\n' ' ')" = "unbound name 'BOTH' unbound name 'WRONG' " ]
petri run --frames 1 --print tree -D DISTANCE=4 -D RECORD=1 optional.fl
check "-D sets an optional definition" has out "!n g=4"
petri check optional.fl
check "check lists optional definitions of included files" has err "optional_part.fl:2:20: note: 'FAST' is optional"
check "a similar name is not a parameter" has err "'CELSL' is optional"

echo 'let N=N or 900 -- 1..500
!n v=N' >outside.fl
petri check outside.fl
check "check reports a default outside its range" has err "outside.fl:1:5: warning: the default of 'N' is outside the range"
petri run --frames 1 outside.fl
check "a run does not report a default outside its range" empty err

# Parameters for which 0 is a value.
echo "let GAIN=GAIN if GAIN != null else 5 -- 0..9|1 how strong
!n g=GAIN" >gain.fl
petri check --werror gain.fl
check "a parameter that accepts 0 has no warnings" status_is 0
petri run --parameters gain.fl -D GAIN=0
check "a parameter that accepts 0 is listed with its range" out_is "GAIN  0 (default 5)  0..9|1  how strong"
petri run --frames 1 --print tree gain.fl -D GAIN=0
check "0 sets a parameter that accepts it" has out "!n g=0"
echo "let GAIN=GAIN or 5 -- 0..9|1 how strong
!n g=GAIN" >gain.fl
petri check gain.fl
check "check reports a range with values that 'or' replaces" has err 'gain.fl:1:5: warning: the range contains 0, but `or` replaces 0 by the default 5 [zero-in-range]'
check "check writes the declaration that accepts 0" has err "write 'let GAIN=GAIN if GAIN != null else 5'"
petri run --frames 1 --print tree gain.fl -D GAIN=0
check "a run does not use the default instead of 0" eval 'status_is 1 && empty out'
check "the error writes the declaration that accepts 0" has err "write 'let GAIN=GAIN if GAIN != null else 5'"

for row in '1/240=0.004166666666666667' '-3/2=-1.5' '1k/8=125'; do
    petri run --frames 1 gain.fl -D "GAIN=${row%=*}"
    check "the number ${row#*=} is suggested for the quotient ${row%=*}" eval 'status_is 2 && has err "write ${row#*=} for ${row%=*}"'
done
for value in 1/0 1/ /2 1/2/3 a/b ':1/23'; do
    petri run --frames 1 gain.fl -D "GAIN=$value"
    check "no number is suggested for $value" eval 'status_is 2 && has err "is not a number" && lacks err "write"'
done

petri run --parameters cells.fl
check "--parameters lists name, default, range and comment" out_is "CELLS  200       1..500  how many cells
SPEED  1.5
TITLE  'a dish'

cells_module.fl, a module: -D does not affect it, its parameters have their defaults
WIDE  3  1..9  metres"
check "--parameters succeeds" status_is 0
check "--parameters does not run the script" lacks out "@0"
petri run --parameters -D CELLS=5 cells.fl
check "--parameters shows what -D has set" has out "CELLS  5 (default 200)  1..500  how many cells"
petri run --parameters plain.fl
check "--parameters prints nothing for a script without parameters" empty out
check "--parameters explains how to add a parameter" has err "plain.fl has no parameters"
petri help run
tr '\n' ' ' <out >joined # the help text is wrapped
check "help explains parameters" has joined "let CELLS=CELLS or 200 -- 1..500"
check "help lists --parameters" has out "--parameters"

# Definitions that a script does not accept are reported with a position and do not fail the run.
petri run --frames 1 -D FIXED=8 cells.fl
check "-D of a name that the script binds is a warning" has err "cells.fl:3:5: warning: unused definition 'FIXED'"
check "the warning about an unused definition has a hint" has err 'write `let FIXED=FIXED or'
check "an unused definition does not fail the run" status_is 0
petri run --frames 1 -D CELS=8 cells.fl
check "-D of a name that is not read is a warning" has err "cells.fl:1:5: warning: unused definition 'CELS'"
check "the warning about an unused definition suggests the nearest parameter" has err "did you mean 'CELLS'?"
petri run --frames 1 -D WIDE=8 cells.fl
check "-D of a module's parameter is a warning there" has err "cells_module.fl:1:5: warning: unused definition 'WIDE'"
petri run --frames 1 -D CELLS=501 cells.fl
check "-D outside the range is a warning" has err "cells.fl:1:5: warning: CELLS=501 is outside the range 1..500"
petri run --frames 1 -D CELLS=0 cells.fl
check "-D of 0 is reported to mean the default" has err "0 is false, so \`or\` uses the default 200"
petri run --frames 1 --quiet -D CELLS=501 -D FIXED=8 -D CELS=8 cells.fl
check "--quiet suppresses warnings about definitions" empty err

# An invalid definition is a usage error.
for wrong in 5 =5 CELLS 5=5 'a b=5' CELLS=12x CELLS= CELLS=many; do
    petri run --frames 1 --print tree cells.fl -D "$wrong"
    check "-D '$wrong' is a wrong command line" status_is 2
    check "-D '$wrong' gives one error" [ "$(grep -Ec 'error: |petri: ' err)" -eq 1 ]
    check "-D '$wrong' runs nothing" empty out
done
petri render cells.fl -o never.png -D CELLS=12x
check "render rejects an invalid parameter value" status_is 2
petri view --terminal cells.fl -D CELLS=12x
check "view rejects an invalid parameter value" status_is 2
petri repl cells.fl -D CELLS=12x
check "repl rejects an invalid parameter value" status_is 2
petri repl cells.fl -D 5=5
check "repl rejects an invalid definition" status_is 2

# Extracts the `console` blocks of the language tour (grammar/README.md): commands, their files and their output.
# shellcheck disable=SC2016 # awk's dollars
awk '/^```flitter .*\.fl$/ { file = $2; next }
     /^```console$/ { console = 1; next }
     /^```/ { file = ""; console = 0; next }
     file != "" { print > file }
     console && sub(/^\$ petri /, "") { ++count; print > ("tour" count ".words"); printf "" > ("tour" count ".wanted"); next }
     console { print > ("tour" count ".wanted") }' "$here/../../grammar/README.md"
for words in tour*.words; do
    # shellcheck disable=SC2046 # split into words
    petri $(cat "$words")
    check "the output of petri $(cat "$words") in the language tour is correct" cmp -s out "${words%.words}.wanted"
done
check "the language tour has examples" test -s tour2.wanted
