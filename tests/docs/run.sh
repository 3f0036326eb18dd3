#!/bin/sh
# run.sh PETRI ROOT: runs the examples of the documents below ROOT that are listed here, and of src/manual/.
#
# Fenced blocks:
#   ```flitter-eval       lines `EXPRESSION => RESULT`; RESULT is the printed value, or `error` if it must be rejected
#   ```flitter            a script, followed by one of the next two blocks
#   ```tree [FRAME]       the printed tree of the frame (default: 0), or `error` if the script must be rejected
#   ```state FRAME        the state after the frame: lines KEY = VALUE of `petri run --print state`, or KEY = null for a
#                         missing key; other keys are not compared; warnings are not allowed
#   ```flitter NAME.fl    a file of that name, which other examples import or include
#   ```flitter NAME.png   an excerpt of a script, which nodes.sh checks
# A failure is a line with the position in the document. Too few examples are also a failure, because a broken extraction
# would find none.
set -u
LC_ALL=C.UTF-8
export LC_ALL

documents="grammar/README.md README.md lib/physics/README.md lib/canvas/README.md lib/gl/README.md lib/scene3d/SCENE.md"
min_examples=100
if [ $# -ne 2 ]; then
    echo "usage: run.sh PETRI ROOT" >&2
    exit 2
fi
petri=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
root=$2
documents="$documents $(cd "$root" && echo src/manual/*.md)"
if [ ! -x "$petri" ]; then
    echo "run.sh: no program $1" >&2
    exit 2
fi
work=$(mktemp -d "${TMPDIR:-/tmp}/petri-docs.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM HUP

# Splits a document. Each example becomes $work/N.fl, $work/N.want and a line `N POSITION FRAME KIND` in $work/cases.
# Each error in the document becomes a line in $work/faults.
extract() { # FILE NAME FIRST
    awk -v name="$2" -v work="$work" -v count="$3" '
        function fault(line, text) { print name ":" line ": " text >> (work "/faults") }
        function add(line, script, want, frame, kind,    base) {
            base = work "/" ++count
            printf "%s", script > (base ".fl"); close(base ".fl")
            printf "%s", want > (base ".want"); close(base ".want")
            print count, name ":" line, frame, kind >> (work "/cases")
        }
        function add_line(line, text,    at, next_at, want) {
            at = 0
            while ((next_at = index(substr(text, at + 1), " => ")) > 0)
                at += next_at
            if (at == 0) {
                if (text !~ /^[ \t]*$/)
                    fault(line, "no => in this line")
                return
            }
            want = substr(text, at + 4)
            if (want != "error")
                want = want == "null" ? "!value" : "!value is=" want
            # The closing parenthesis is on the next line, because the expression may end with a comment.
            add(line, "!value is=(" substr(text, 1, at - 1) "\n)\n", want "\n", 0, "tree")
        }
        function unpaired() {
            if (pending)
                fault(pending, "this script has no ```tree or ```state block after it")
            pending = 0
        }
        fence == "" && /^```/ {
            fence = $1
            opened = NR
            file = $2
            body = ""
            result = fence == "```tree" || fence == "```state"
            if (result && !pending)
                fault(NR, "no script before this " substr(fence, 4))
            else if (!result)
                unpaired()
            next
        }
        /^```[ \t]*$/ {
            if (fence == "```flitter" && file != "") {
                printf "%s", body > (work "/" file); close(work "/" file)
            } else if (fence == "```flitter") {
                pending = opened
                script = body
            } else if (result && pending) {
                add(pending, script, body, file == "" ? 0 : file, substr(fence, 4))
                pending = 0
            }
            fence = ""
            next
        }
        fence == "```flitter-eval" { add_line(NR, $0) }
        fence != "" { body = body $0 "\n" }
        fence == "" && !/^[ \t]*$/ { unpaired() }
        END {
            unpaired()
            if (fence != "")
                fault(opened, "this block is not closed")
        }' "$1"
}

# Runs a script to a frame and writes the output of that frame to $work/last.
play() { # N FRAME KIND
    "$petri" run --print "$3" --frames $(($2 + 1)) --every $(($2 > 0 ? $2 : 1)) "$work/$1.fl" >"$work/out" 2>"$work/err"
    status=$?
    awk '/^@/ { text = ""; next } { text = text $0 "\n" } END { printf "%s", text }' "$work/out" >"$work/last"
    return $status
}

# Prints the state of each expected key, and the first warning.
run_state() { # N FRAME
    play "$1" "$2" state || echo "exit status $?"
    grep -m 1 -E ': (warning|error): ' "$work/err"
    awk 'function key(line) { return substr(line, 1, index(line, " = ") - 1) }
         FILENAME == ARGV[1] { state[key($0)] = $0; next }
         { print key($0) in state ? state[key($0)] : key($0) " = null" }' "$work/last" "$work/$1.want"
}

# Prints the tree of the last frame, or `error` if the script was rejected with a diagnostic.
run_tree() { # N FRAME
    play "$1" "$2" tree
    status=$?
    if [ $status -eq 0 ]; then
        cat "$work/last"
    elif [ $status -eq 1 ] && grep -q ': error: ' "$work/err"; then
        echo error
    else
        echo "exit status $status: $(head -n 1 "$work/err")"
    fi
}

# Prints the first difference between two files.
explain() { # WANT GOT
    awk 'FILENAME == ARGV[1] { want[FNR] = $0; wants = FNR; next }
         { got[FNR] = $0; gots = FNR }
         END {
             for (i = 1; i <= wants || i <= gots; i++)
                 if (i > wants || i > gots || want[i] != got[i])
                     break
             expected = i <= wants ? want[i] : "nothing"
             actual = i <= gots ? got[i] : "nothing"
             print "line " i ": expected " expected ", got " actual
         }' "$1" "$2"
}

: >"$work/cases"
: >"$work/faults"
for document in $documents; do
    extract "$root/$document" "$document" "$(awk 'END { print NR }' "$work/cases")"
done

cat "$work/faults"
passed=0
failed=$(awk 'END { print NR }' "$work/faults")
while read -r number place frame kind; do
    "run_$kind" "$number" "$frame" >"$work/got" </dev/null
    if cmp -s "$work/$number.want" "$work/got"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "$place: $(explain "$work/$number.want" "$work/got")"
    fi
done <"$work/cases"

if [ $((passed + failed)) -lt $min_examples ]; then
    echo "found $((passed + failed)) examples, expected at least $min_examples; has the form of the blocks changed?"
    failed=$((failed + 1))
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
