# parameters.sh: what -D can set: `let NAME=NAME or VALUE`. Part of run.sh.

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
check "a parameter's name on the right is no unbound name" status_is 0
petri run --frames 2 --print tree,error cells.fl
check "… nor in a run" empty err
check "… nor in a module, in any frame" out_is "@0 time=0 beat=0
!n c=200 s=1.5 t='a dish' f=7 b=6
@1 time=0.016666666666666666 beat=0.03333333333333333
!n c=200 s=1.5 t='a dish' f=7 b=6"
petri run --frames 1 --print tree -D CELLS=5 -D 'TITLE=b c' cells.fl
check "-D sets parameters" out_is "@0 time=0 beat=0
!n c=5 s=1.5 t='b c' f=7 b=6"
check "… without a word" empty err

echo 'let N=N or 900 -- 1..500
!n v=N' >outside.fl
petri check outside.fl
check "a default outside its own range is told" has err "outside.fl:1:5: warning: the default of 'N' is outside the range"
petri run --frames 1 outside.fl
check "… by a check only" empty err

petri run --parameters cells.fl
check "--parameters lists name, default, range and comment" out_is "CELLS  200       1..500  how many cells
SPEED  1.5
TITLE  'a dish'

cells_module.fl, a module: definitions do not apply, defaults are used
WIDE  3  1..9  metres"
check "--parameters succeeds" status_is 0
check "--parameters does not run the script" lacks out "@0"
petri run --parameters -D CELLS=5 cells.fl
check "--parameters shows what -D has set" has out "CELLS  5 (default 200)  1..500  how many cells"
petri run --parameters plain.fl
check "a script without parameters has none" empty out
check "… and how to make one is told" has err "plain.fl has no parameters"
petri help run
tr '\n' ' ' <out >joined # the help is wrapped
check "help tells what a parameter is" has joined "let CELLS=CELLS or 200 -- 1..500"
check "help tells of --parameters" has out "--parameters"

# What a script does not take is told, with the place, and does not fail the run.
petri run --frames 1 -D FIXED=8 cells.fl
check "-D of a name that the script binds is a warning" has err "cells.fl:3:5: warning: unused definition 'FIXED'"
check "… with a hint" has err 'with `let FIXED=FIXED or'
check "… and no failure" status_is 0
petri run --frames 1 -D CELS=8 cells.fl
check "-D of a name that is not read is a warning" has err "cells.fl:1:5: warning: unused definition 'CELS'"
check "… with the nearest parameter" has err "did you mean 'CELLS'?"
petri run --frames 1 -D WIDE=8 cells.fl
check "-D of a module's parameter is a warning there" has err "cells_module.fl:1:5: warning: the definition of 'WIDE'"
petri run --frames 1 -D CELLS=501 cells.fl
check "-D outside the range is a warning" has err "cells.fl:1:5: warning: CELLS=501 is outside the range 1..500"
petri run --frames 1 -D CELLS=0 cells.fl
check "-D of 0 is told to count as none" has err "0 is false, so that \`or\` takes the default 200"
petri run --frames 1 --quiet -D CELLS=501 -D FIXED=8 -D CELS=8 cells.fl
check "--quiet keeps all that back" empty err

# A malformed definition is a wrong command line.
for wrong in 5 =5 CELLS 5=5 'a b=5' CELLS=12x CELLS= CELLS=many; do
    petri run --frames 1 --print tree cells.fl -D "$wrong"
    check "-D '$wrong' is a wrong command line" status_is 2
    check "-D '$wrong' gives one error" [ "$(grep -Ec 'error: |petri: ' err)" -eq 1 ]
    check "-D '$wrong' runs nothing" empty out
done
petri render cells.fl -o never.png -D CELLS=12x
check "render knows wrong definitions" status_is 2
petri view --terminal cells.fl -D CELLS=12x
check "view knows wrong definitions" status_is 2
petri repl cells.fl -D CELLS=12x
check "repl, too" status_is 2
petri repl cells.fl -D 5=5
check "repl knows wrong definitions" status_is 2

# The tour's `console` blocks: what `$ petri …` writes, with the files that it names.
# shellcheck disable=SC2016 # awk's dollars
awk '/^```flitter .*\.fl$/ { file = $2; next }
     /^```console$/ { console = 1; next }
     /^```/ { file = ""; console = 0; next }
     file != "" { print > file }
     console && sub(/^\$ petri /, "") { ++count; print > ("tour" count ".words"); printf "" > ("tour" count ".wanted"); next }
     console { print > ("tour" count ".wanted") }' "$here/../../grammar/README.md"
for words in tour*.words; do
    # shellcheck disable=SC2046 # the words are words
    petri $(cat "$words")
    check "the tour is right about petri $(cat "$words")" cmp -s out "${words%.words}.wanted"
done
check "the tour has such examples" test -s tour2.wanted
