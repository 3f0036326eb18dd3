# golden_review.sh: tests of `petri test --review` and `--watch`. Part of run.sh.

mkdir -p rev
for name in a b c d; do
    printf 'import A from "mod.fl"\n!n a=A+frame\n' >rev/$name.fl
done
echo 'let A=1' >rev/mod.fl
for name in a b c d; do
    petri test --new rev/$name.fl --frames 1
done
echo 'let A=2' >rev/mod.fl
review() { # ANSWERS: reviews the folder
    printf "$1" >answers
    timeout 100 "$petri" test --review rev <answers >out 2>err
    status=$?
}
review 'c\nnonsense\na\nr\ns\na\n'
check "a review accepts, rejects and leaves" has out "2 accepted, 1 rejected, 1 left"
check "a review counts accepted tests as passed" last_line_is out "2 passed, 2 failed, 1 script without a test"
check "a review in which something is left fails" status_is 1
check "an answer that is not known gets help" has out "q: end the review"
check "a cause that git does not know is reported" has out "no cause found"
check "the first difference was accepted" has rev/a.golden "!n a=2"
check "a rejected golden is as before" has rev/b.golden "!n a=1"
check "a skipped golden is as before" has rev/c.golden "!n a=1"
check "the fourth difference was accepted" has rev/d.golden "!n a=2"
review 'q\n'
check "after q, the review asks no more" count_is out "[a/r/s/c/p/q]" 1
check "after q, other differences are still shown" count_is out "FAIL rev/" 2
review 'p\n'
check "at the end of the input, the review ends" has out "0 accepted, 0 rejected, 2 left"
check "a golden without pictures says so" has out "this test has no pictures"
review 'a\na\n'
check "a review that accepts everything succeeds" status_is 0
review ''
check "a review without differences asks nothing" lacks out "[a/r"
# On a terminal, keys answer without Enter, which is ignored.
cp -R rev keys
for name in a b c; do
    printf 'import A from "mod.fl"\n!n a=A+frame+7\n' >keys/$name.fl
done
python3 -c '
import os, pty, sys
replies, seen = [b"x", b"a", b"\r\nr", b"\3"], [b""]
def shown(file):
    data = os.read(file, 1024)
    seen[0] += data
    if seen[0].endswith(b"/q] ") and replies:
        seen[0] = b""
        os.write(file, replies.pop(0))
    return data
pty.spawn(sys.argv[1:], shown, lambda file: b"")
' "$petri" test --review keys >out 2>err </dev/null
check "on a terminal, each key is an answer" has out "1 accepted, 1 rejected, 1 left"
check "an unknown key gets help" has out "q: end the review"
petri test --review --update rev
check "--review and --update exclude each other" status_is 2
petri test --review --format tap rev
check "--review needs text" status_is 2

# --watch: a module, a golden, and a script that gets a new dependency
: >watched
"$petri" test --watch rev >watched 2>err </dev/null &
watching=$!
# awaits TEXT COUNT: waits until the text is in that many lines of the output.
awaits() {
    tries=0
    while [ "$(grep -c -e "$1" watched)" -lt "$2" ] && [ $tries -lt 600 ]; do
        sleep 0.1
        tries=$((tries + 1))
    done
    [ "$(grep -c -e "$1" watched)" -eq "$2" ]
}
check "--watch first runs all tests" awaits "passed, " 1
sleep 0.1
echo '!n a=4' >rev/b.fl
check "--watch runs a test whose script changed" awaits "^FAIL rev/b.fl" 1
check "--watch runs no other tests" awaits "^0 passed, 1 failed" 1
echo 'let A=3' >rev/mod.fl
check "--watch runs the tests that import a changed module" awaits "^0 passed, 3 failed" 1
check "a test that no longer imports the module does not run" awaits "rev/b.fl" 2
printf 'import B from "new.fl"\n!n a=B\n' >rev/b.fl
check "--watch runs a script with a module that is missing" awaits "^FAIL rev/b.fl" 2
echo 'let B=2' >rev/new.fl
printf 'import B from "new.fl"\n!n a=B+0\n' >rev/b.fl
check "--watch sees that a test passes" awaits "^ok rev/b.fl" 2
echo 'let B=5' >rev/new.fl
check "--watch runs a test after a change of a module that is new" awaits "^FAIL rev/b.fl" 3
kill $watching
wait $watching 2>/dev/null
