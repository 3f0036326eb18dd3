# suggest.sh: tests of suggestions for mistyped command lines, and of help on words. Part of run.sh.

echo '!n a=1' >dish.fl
mkdir -p shelf
cp dish.fl shelf/book.fl
cp dish.fl shelf/lamp.fl

# suggests WORD ARGUMENTS...: checks that the command line is invalid (or the file missing) and that the message
# suggests WORD.
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
check "a script can have any name" has out "!n a=1"
petri run dish2
check "an unknown name without a similar one gives one message" lines_are err 1
petri run shelf
check "a folder is reported as a directory" has err "'shelf': it is a directory"
check "a folder's scripts are suggested" has err "choose a script in the folder: shelf/book.fl, shelf/lamp.fl"
petri run ''
check "an empty name is a wrong command line" status_is 2
check "an empty script name is reported" [ "$(cat err)" = "petri: the script name is empty" ]
petri ''
check "an empty script name without a command is reported" [ "$(cat err)" = "petri: the script name is empty" ]
petri check ''
check "check reports an empty script name" has err "the script name is empty"
petri run -o x.png dish.fl
check "an option of another command names that command" has err "'petri run' has no option '-o', but 'petri render' has"
petri view --print tree dish.fl
check "a long option of another command names that command" has err "'petri view' has no option '--print', but 'petri run' has"

# version and help
petri --version
cp out version
for words in version -V "run --version" "help version"; do
    # shellcheck disable=SC2086 # split into words
    petri $words
    check "petri $words prints the version" cmp -s out version
done
# helps TEXT TOPIC: checks that `petri help TOPIC` prints TEXT.
helps() {
    petri help "$2"
    check "help $2 exits with 0" status_is 0
    check "help $2 shows its topic" has out "$1"
}
helps 'sin(x)' sin
helps '!particle (physics)' particle
helps '!particle (physics)' '!particle'
helps 'beats per minute' tempo
helps 'binds names to values' let
helps '    !particle  number' charge
helps 'petri run' --frames
helps '-D, --define' -D
helps 'at the prompt of petri repl' .step
petri help random
check "help shows a name that is only a node" has out "!random (physics)"
petri help no-such-thing
check "help on an unknown topic is a usage error" status_is 2
# everyday words
helps '!ellipse (canvas)' circle
helps 'circle: see ellipse' circle
helps '!ellipse (canvas)' '!circle'
helps '!distance (physics)' spring
helps '!barrier (physics)' wall
helps '!rect (canvas)' background
helps 'quad(x)' easing
helps 'map(xs, ys, zs)' lerp
helps 'RECIPES.md' keyframe
helps 'petri test' golden
helps 'RECIPES.md' trail
helps '!pointer (canvas)' mouse
helps 'see also: uniform, normal, beta' random
helps '!drag (physics)' temperature
helps 'no Lennard-Jones force' lennard
helps 'semi-implicit Euler' verlet
helps '    !particle' boids
petri help '!random'
check "help !random is only about nodes" lacks out uniform
petri help '!easing'
check "a word for functions is not a node" status_is 2
petri help mosue
check "an unknown topic like an everyday word does not suggest what has no help" status_is 2
# Each word of both lists has help, whose notes name topics that exist. The search compares words in small letters.
sed -n 's/^EVERYDAY("\([^"]*\)".*/\1/p; s/^SYNONYM("\([^"]*\)".*/\1/p' "$here/../../src/cli/everyday_list.h" \
    "$here/../../lib/schema/synonym_list.h" >rows
check "there are everyday words" [ "$(wc -w <rows)" -gt 150 ]
check "everyday words are in small letters" [ "$(grep -c '[A-Z]' rows)" -eq 0 ]
for word in $(cat rows); do
    petri help "$word"
    check "help $word explains the word" status_is 0
    grep -o "petri help [a-z]*" out >>named
    sed -n "s/.*see '\(.*\)' in samples\/RECIPES.md.*/## \1/p" out >>recipes
done
check "notes name recipes that exist" [ -z "$(sort -u recipes | grep -vxFf "$here/../../samples/RECIPES.md")" ]
check "there are such notes" [ "$(wc -l <recipes)" -gt 10 ]
sed 's/^petri help //' named | sort -u >topics
for topic in $(cat topics); do
    petri help "$topic"
    check "notes name a topic that exists: $topic" status_is 0
done
awk -F'"' '/^SYNONYM/ { count = split($2, word, " "); for (i = 1; i <= count; i++) print word[i], $4 }' \
    "$here/../../lib/schema/synonym_list.h" >synonyms
while read -r word kind; do
    petri help "!$word"
    check "help !$word shows !$kind" has out "!$kind ("
done <synonyms
# names contain no blanks
for name in $(sed -n 's/^ENGINE_NAME([A-Z_]*, *"\([a-z_]*\)".*/\1/p' "$here/../../lib/program/engine_names.h"); do
    petri help "$name"
    check "help $name explains the value" status_is 0
done

# values without their option, and options without their value
petri run dish.fl SIZE=5
check "NAME=VALUE without -D suggests -D" has err "'SIZE=5' is not a script; did you mean '-D SIZE=5'?"
petri render dish.fl dish.png
check "a picture without -o suggests -o" has err "to write it, run: petri render dish.fl -o dish.png"
petri view dish.png dish.fl
check "a picture before the script suggests -o" has err "to write it, run: petri render dish.fl -o dish.png"
petri run dish.fl shelf/book.fl
check "a second script is reported" has err "too many scripts: 'dish.fl' and 'shelf/book.fl'"
petri run dish.fl --frames
check "an option without its value shows its help" has err "option '--frames' needs a value; '--frames N' means: stop after N frames"
petri nodes
check "the name of a help list as a command suggests petri help" has err "did you mean 'petri help nodes'?"
petri list
check "a word unlike any other gives no suggestion" lacks err "did you mean"
petri test dish.fl
check "test without goldens shows how to create one" has err "run: petri test --new dish.fl"
petri
check "petri without arguments suggests new" has err "try 'petri new NAME'"

# help fits narrow terminals and has examples
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
sed -n 's/^  petri \(test --new \)dish.fl\( .*\)/petri \1made.fl\2/p' out | head -n 1 >making.sh
check "help test shows one command that creates a golden" [ "$(wc -l <making.sh)" -eq 1 ]
# shellcheck source=/dev/null
. ./making.sh
petri test made.fl
check "the command in help test creates a golden" has out "1 passed"
