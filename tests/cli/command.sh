# command.sh: tests of options, exit codes and output streams. Part of run.sh.

# help and version
petri --version
check "--version prints the version" status_is 0
check "the version has a number" grep -Eq '^petri [0-9]+\.[0-9]+\.[0-9]+$' out
petri --help
check "--help exits with 0" status_is 0
check "--help lists the commands" has out "check"
check "--help writes nothing to stderr" empty err
cp out overview
petri help
check "help is the same as --help" cmp -s out overview
petri help run
check "help run lists its options" has out "--frames N"
cp out run_help
petri run --help
check "run --help is the same as help run" cmp -s out run_help
# fits COLUMNS: succeeds if no line of the output is longer.
fits() { ! grep -Eq ".{$(($1 + 1))}" out; }
for topic in '' view sweep particle builtins --frames; do
    petri help $topic
    check "help${topic:+ $topic} is wrapped at 80 columns without a terminal" fits 80
done
check "wrapped lines of a list are indented to the column of its texts" grep -Eq '^ {30}[a-z]' run_help
petri help --help
check "help has help" has out "usage: petri help [TOPIC]"
for topics in 'run sin' 'archive sin' 'archive verify run'; do
    petri help $topics
    check "help on several topics is a usage error: $topics" status_is 2
    check "the message names the second topic: $topics" has err "too many arguments: '$(echo "$topics" | cut -d ' ' -f 2)'"
done
for old in open send verify info cite unpack; do
    check "help does not list the old command $old" lacks overview "  $old "
    petri help $old
    check "the old command $old has help" eval 'status_is 0 && has out "usage: petri "'
done
petri help archive
for action in verify info cite unpack; do
    check "help lists the action $action" has out "  petri archive $action RUN.petri"
    petri archive $action --help
    mv out action_help
    check "an action has help: $action" has action_help "usage: petri archive $action [options] RUN.petri"
    petri help archive $action
    check "help of an action is the same: $action" cmp -s out action_help
    petri archive $action
    check "an action needs an archive: $action" has err "no archive given; usage: petri archive $action [options] RUN.petri"
    petri help archive
done
for wrong in 'verfy x.petri' verfy; do
    petri archive $wrong
    check "a mistyped action is a usage error: $wrong" status_is 2
    check "the message suggests an action: $wrong" has err "no such action: 'verfy'; did you mean 'petri archive verify'?"
done
petri archive
check "archive needs an action" has err "no action given: petri archive ACTION RUN.petri"
petri view --send socket --help
check "view --send has help" has out "usage: petri view --send"
petri view --send socket
check "view --send needs code" has err "no code given; usage: petri view --send"
for arguments in '' socket 'socket text more'; do
    petri send $arguments
    check "send needs a socket and code, not '$arguments'" status_is 2
    check "send reports what it needs, not '$arguments'" has err "expected a socket and code, as in: petri view --send"
done
mkdir -p no-scripts
petri fmt no-scripts
check "fmt of a folder without scripts is an error" one_message "no script found: no file is named *.fl"
petri sweep x.fl --metric n=1 --shard 1/2
check "a shard without a table is a usage error" status_is 2
check "the message names the option for the table" has err "option '--shard' needs a file for the table; add -o FILE.csv"
petri sweep x.fl --metric n=1 --plot x.txt -o t.csv
check "a plot of an unknown format is a usage error" status_is 2
check "the message lists the formats of plots" has err "expects a file name that ends in .svg, .png or .pdf, not 'x.txt'"
petri test --help
check "test has help" has out "--update"
petri check --help
check "check has help" has out "usage: petri check"
petri help builtins
check "help builtins lists functions" grep -q '^sin(' out
petri help nonsense
check "help on an unknown topic is a wrong command line" status_is 2
petri help complete
check "a command without help is an unknown topic" status_is 2

# invalid command lines
petri
check "no arguments are a wrong command line" status_is 2
check "no arguments give a message" has err "petri: "
check "no arguments print nothing on stdout" empty out
petri run
check "run without a script is a wrong command line" status_is 2
petri run plain.fl count.fl
check "two scripts are a wrong command line" status_is 2
petri run --frame 3 plain.fl
check "an unknown option is a wrong command line" status_is 2
check "an unknown option names the nearest one" has err "did you mean '--frames'"
petri run --evrey=3 plain.fl
check "a mistyped option with a value names the nearest one" has err "did you mean '--every'"
petri run --zzzzzz plain.fl
check "an option unlike any other names the help command" has err "petri help run"
petri --quite plain.fl
check "options without a command are those of run" has err "did you mean '--quiet'"
petri test --updat .
check "test suggests its own options" has err "did you mean '--update'"
petri chek plain.fl
check "an unknown command is a wrong command line" status_is 2
check "an unknown command names the nearest one" has err "petri check"
petri run --frames
check "an option without its value is a wrong command line" status_is 2
for wrong in --frames=-1 --frames=x --frames=1.5 --frames= --every=0 --fps=0 --fps=nan --runtime=soon --threads=0 \
    --print=trees --print= --color=sometimes --dump=all --neighbours=few --quiet=1 -D1 --define==1 -q; do
    petri run "$wrong" plain.fl
    check "$wrong is a wrong command line" status_is 2
    check "$wrong gives one message" lines_are err 1
done

# running
petri run --frames 3 count.fl -D x=1
check "a run exits with 0" status_is 0
check "logs alone are printed by default" out_is "> 0
> 1
> 2"
check "a run without a terminal is silent on stderr" empty err
petri count.fl --frames 3 -D x=1
check "petri SCRIPT.fl runs the script" out_is "> 0
> 1
> 2"
petri run -D x=1 count.fl
check "a run makes 600 frames by default" lines_are out 600
petri run --runtime 0.5 --fps 10 -Dx=1 count.fl
check "--runtime counts seconds" lines_are out 5
petri run --runtime 0:02 --fps=10 -Dx=1 count.fl
check "--runtime takes a time code" lines_are out 20
petri run --runtime 2 --frames 3 -Dx=1 count.fl
check "the smaller of --frames and --runtime ends the run" lines_are out 3
petri run --frames 0 -Dx=1 count.fl
check "--frames 0 is accepted" status_is 0
check "--frames 0 prints nothing" empty out
petri run --frames 7 --every 3 --print tree --fps 4 -D 'x=1;:two;three' count.fl
check "--every prints every K-th frame, --print the tree, -D a vector" out_is "@0 time=0 beat=0
!n a=0 b=1;:two;'three'
@3 time=0.75 beat=1.5
!n a=3 b=1;:two;'three'
@6 time=1.5 beat=3
!n a=6 b=1;:two;'three'"
petri run --frames=1 --print=tree --define=x=2 -- count.fl
check "--name=value and -- are understood" out_is "@0 time=0 beat=0
!n a=0 b=2"
petri run --frames 1 --print tree,log --define x=2 count.fl
check "--print takes several sections" out_is "@0 time=0 beat=0
!n a=0 b=2
> 0"
printf '!counter state=:c initial=1\ndebug(frame)\n!n\n' >counter.fl
petri run --frames 2 --every 2 --print hash,log,tree counter.fl
check "--print hash adds a line after the other sections" out_is "@0 time=0 beat=0
!counter state=:c initial=1
!n
> 0
= $(printf '$:c = 1\n$(:c;:time) = 0\n' | sha256sum | cut -d ' ' -f 1)"
cp out both
petri run --frames 2 --every 2 --print hash,log,tree,state counter.fl
check "--print hash adds its line after the state" [ "$(grep -v '^\$' out)" = "$(cat both)" ]
petri run --realtime --frames 2 --fps 50 -D x=1 count.fl
check "--realtime runs" lines_are out 2
petri run --realtime --frames 1 --print tree -D x=1 count.fl
check "time starts at 0 with --realtime" has out "@0 time=0 beat=0"
petri run --threads 3 --neighbours always --nosimplify --lockstep --frames 1 -D x=1 count.fl
check "--threads, --neighbours, --nosimplify and --lockstep are accepted" out_is "> 0"
petri run --dump=ast plain.fl
check "--dump=ast prints the syntax tree" test -s out
petri run --dump code plain.fl
check "--dump=code prints the code" test -s out

# the profile
cat >slow.fl <<'END'
func twice(x)
    2*x
let many=sum(sin(i+frame) for i in ..200000)
for i in ..5
    if frame >= 0
        !item a=twice(many+i)
    let never=i
END
petri run --profile --frames 10 --print tree slow.fl
check "--profile does not change the output" lines_are out 60
check "--profile prints the number of frames" has err "ms per frame, 10 frames"
check "--profile has the slowest line first" [ "$(sed -n 's/.*\(slow.fl:[0-9]*\).*/\1/p' err | head -n 1)" = slow.fl:3 ]
check "--profile counts how often a line runs" grep -Eq ' 5  slow.fl:6: !item a=twice\(many\+i\)$' err
check "--profile counts a function's lines" grep -Eq ' 5  slow.fl:2: 2\*x$' err
check "--profile counts physics and output" grep -Eq '[0-9] +physics$' err
check "--profile counts output" grep -Eq '[0-9] +output$' err
check "the times of --profile add up to the total" awk '/%/ { sum += $1 } END { exit sum < 99 || sum > 101 }' err
petri run --frames 10 slow.fl
check "without --profile no profile is printed" empty err

# verbosity
petri run --frames 2 warn.fl
check "a warning does not fail the run" status_is 0
check "a repeated warning is reported once" count_is err "warning: " 1
check "a warning is not coloured without a terminal" lacks err "$(printf '\033')"
petri run --frames 2 --color always warn.fl
check "--color always colours" has err "$(printf '\033')"
petri run --frames 2 --quiet warn.fl
check "--quiet suppresses warnings" empty err
petri run --frames 2 --verbose plain.fl
check "--verbose gives a summary" has err "petri: 2 frames in "
petri run --frames 2 --trace plain.fl
check "--trace reports every frame" has err "petri: frame 1: "
petri run --frames 2 --quiet --verbose --quiet plain.fl
check "the last verbosity option takes effect" empty err

# streams
{ timeout 100 "$petri" run --frames 1000000 --print tree plain.fl 2>err; echo $? >code; } | head -n 1 >out
status=$(cat code)
check "a closed pipe ends the run" status_is 0
check "a closed pipe gives no message" empty err
check "output before a closed pipe is correct" out_is "@0 time=0 beat=0"
if [ -c /dev/full ]; then
    for words in "run --print tree plain.fl" "help" "help builtins"; do
        # shellcheck disable=SC2086 # split into words
        timeout 100 "$petri" $words >/dev/full 2>err </dev/null
        status=$?
        check "'$words' to a full device fails" status_is 1
        check "'$words' to a full device reports the reason" has err "No space left"
    done
fi
timeout 100 "$petri" run --frames 1 --print tree plain.fl >&- 2>err
status=$?
check "a closed stdout is an error" status_is 1
rm out # output of the previous command
"$petri" run --frames 1000000000 --print tree --every 100 --verbose plain.fl >out 2>err &
job=$!
tries=0
until [ -s out ] || [ $tries -ge 600 ]; do # waits until the previous command has printed something
    sleep 0.1
    tries=$((tries + 1))
done
kill -INT "$job"
wait "$job"
status=$?
check "Ctrl-C exits with 130" status_is 130
check "Ctrl-C prints the summary" has err " frames in "
# Minimal containers have no pseudo-terminals.
if script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    script -qec "$(quoted "$petri") run --frames 30 --realtime plain.fl" /dev/null >out 2>&1 </dev/null
    check "there is a progress line on a terminal" has out "/30 frames, "
    check "the progress line is erased" has out "$(printf '\r\033[K')petri: 30 frames in "
    script -qec "$(quoted "$petri") run --frames 30 --quiet plain.fl" /dev/null >out 2>&1 </dev/null
    check "--quiet has no progress line" empty out
    script -qec "stty cols 60 rows 20; $(quoted "$petri") help view" /dev/null 2>&1 </dev/null | tr -d '\r' >out
    check "help is wrapped at the terminal's width" fits 60
    check "help fills the terminal's width" grep -Eq '.{55}' out
    NO_COLOR=1 script -qec "$(quoted "$petri") run --frames 1 warn.fl" /dev/null >out 2>&1 </dev/null
    check "NO_COLOR disables colours" lacks out "$(printf '\033[3')"
    check "NO_COLOR keeps the message" has out "warning: "
fi
ln -s "$petri" direct-petri # a #! line cannot contain a path with spaces
printf '#!%s\n!n a=1\n' "$work/direct-petri" >direct.fl
chmod +x direct.fl
./direct.fl --frames 1 --print tree >out 2>err
status=$?
check "a script with a #! line can be executed" has out "!n a=1"

# petri knows every command, although it leaves some to other programs, which are missing here
if [ -x "$(dirname "$petri")/petri-pictures" ]; then
    mkdir alone
    cp "$petri" alone/petri
    alone() {
        timeout 100 alone/petri "$@" >out 2>err </dev/null
        status=$?
    }
    alone rendr plain.fl
    check "petri alone suggests a command that it cannot execute" has err "'rendr'; did you mean 'petri render'?"
    check "an unknown command is a usage error" status_is 2
    for words in 'render disc.fl -o x.png' 'check --stats plain.fl' 'sweep --plan p' 'sweep plain.fl --plot=x.svg' --help \
        'run plain.fl --archive x.petri' 'plain.fl --archive=x.petri' 'archive info x' 'run #q1abcdefgh' '#q1abcdefgh' 'view http://a/#q1abcdefgh'; do
        alone $words
        check "'petri $words' needs petri-pictures" one_message "cannot start petri-pictures: No such file or directory"
    done
    alone view --send socket 1
    check "'petri view --send' needs no other program" has err "cannot reach a view at socket"
    for words in 'run plain.fl --frames 1 --print state' 'plain.fl --frames 1' 'check plain.fl' 'fmt --check plain.fl' \
        'diff plain.fl plain.fl --frames 2' 'sweep plain.fl -D SIZE=1;2 --frames 1 --metric n=SIZE' --version; do
        alone $words
        check "'petri $words' needs no other program" status_is 0
    done
fi
