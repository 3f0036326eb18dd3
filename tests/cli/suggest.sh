# suggest.sh: what is typed wrong, and help on whatever word. Part of run.sh.

echo '!n a=1' >dish.fl
mkdir -p shelf
cp dish.fl shelf/book.fl
cp dish.fl shelf/lamp.fl

# suggests WORD ARGUMENTS...: the command line is wrong (or the file missing) and the message names what was meant.
suggests() {
    word=$1
    shift
    petri "$@"
    check "petri $* suggests $word" has err "did you mean '$word'?"
}
suggests --version --verison
suggests --version -v
suggests --version -version
suggests --version run --verison dish.fl
suggests --frames run -frames 3 dish.fl
suggests 'petri run' rnu dish.fl
suggests 'petri render' rendr
suggests 'petri dish.fl' dish
suggests dish.fl run dish
suggests dish.fl run dihs.fl
suggests dish.fl dish.fl.bak
suggests dish.fl check dsih.fl
suggests shelf/lamp.fl run shelf/lmap.fl
suggests shelf/book.fl run book.fl
suggests 'petri help sin' help sni
suggests 'petri help view' help vew
suggests 'petri help particle' help '!partical'
suggests 'petri help tempo' help tmpo
suggests 'petri help dimensions' help dimension
cp dish.fl dish.fl.bak
petri run --frames 1 --print tree dish.fl.bak
check "a script may be called anything" has out "!n a=1"
petri run dish2
check "a name like no other is one message" lines_are err 1
petri run shelf
check "a folder is told to be one" has err "'shelf': it is a directory"
check "and what is in it" has err "choose a script in it: shelf/book.fl, shelf/lamp.fl"
petri run ''
check "an empty name is a wrong command line" status_is 2
check "an empty name is told" [ "$(cat err)" = "petri: the script name is empty" ]
petri ''
check "also without a command" [ "$(cat err)" = "petri: the script name is empty" ]
petri check ''
check "also to be checked" has err "the script name is empty"
petri run -o x.png dish.fl
check "another command's option is told to be that" has err "'petri run' has no option '-o', but 'petri render' has"
petri view --print tree dish.fl
check "another command's long option, too" has err "'petri view' has no option '--print', but 'petri run' has"

# version and help
petri --version
cp out version
for words in version -V "run --version" "help version"; do
    # shellcheck disable=SC2086 # the words are words
    petri $words
    check "petri $words prints the version" cmp -s out version
done
# helps TEXT TOPIC
helps() {
    petri help "$2"
    check "help $2 exits with 0" status_is 0
    check "help $2 says what it is" has out "$1"
}
helps 'sin(x)' sin
helps '!particle (physics)' particle
helps '!particle (physics)' '!particle'
helps 'beats per minute' tempo
helps 'gives names to values' let
helps '    !particle  number' charge
helps 'petri run' --frames
helps '-D, --define' -D
helps 'at the prompt of petri repl' .step
petri help random
check "a name that is a node only" has out "!random (physics)"
petri help no-such-thing
check "no help on something is a wrong command line" status_is 2
# shellcheck disable=SC2013 # words
for name in $(sed -n 's/^ENGINE_NAME([A-Z_]*, *"\([a-z_]*\)".*/\1/p' "$here/../../lib/program/engine_names.h"); do
    petri help "$name"
    check "help $name tells of the value" status_is 0
done

# values that lack their option, options that lack their value
petri run dish.fl SIZE=5
check "NAME=VALUE alone is taken for a definition" has err "'SIZE=5' is not a script; did you mean '-D SIZE=5'?"
petri render dish.fl dish.png
check "a picture alone is taken for an output" has err "to write it, run: petri render dish.fl -o dish.png"
petri view dish.png dish.fl
check "in whatever order" has err "to write it, run: petri render dish.fl -o dish.png"
petri run dish.fl shelf/book.fl
check "two scripts are told to be two" has err "too many scripts: 'dish.fl' and 'shelf/book.fl'"
petri run dish.fl --frames
check "an option tells what its value would do" has err "option '--frames' needs a value: N, stop after N frames"
petri nodes
check "a list of help alone is found" has err "did you mean 'petri help nodes'?"
petri list
check "a word like no other suggests nothing" lacks err "did you mean"
petri test dish.fl
check "a test without goldens tells where to read of them" has err "see 'petri help test'"
petri
check "nothing to do tells how to begin" has err "try 'petri new NAME'"

# help fits a screen that is not wide, and gives examples
for command in run view render repl test check new help; do
    petri help "$command"
    check "help $command fits 112 columns" [ "$(awk 'length > 112' out | wc -l)" -eq 0 ]
done
for command in run view render repl test check; do
    petri help "$command"
    sed -n "s/^  petri $command \\(.*\\)/\\1/p" out >examples
    check "help $command has examples" test -s examples
done
petri help test
echo '!n a=frame' >made.fl
sed -n "s/^  echo \\('.*'\\) >dish.golden/echo \\1 >made.golden/p" out >making.sh
check "how to make a golden" [ "$(wc -l <making.sh)" -eq 1 ]
# shellcheck source=/dev/null
. ./making.sh
petri test --update made.fl
petri test made.fl
check "makes one" has out "1 passed"
