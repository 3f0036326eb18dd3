# golden.sh: tests of `petri test`. Part of run.sh.

mkdir -p g/below
# case_is NAME <GOLDEN: creates a script that prints two frames, and its golden from standard input.
case_is() {
    printf '!n a=frame/3 b=1;2;3 c="it" d=:sym\ndebug(1)\ndebug(2)\n' >"g/$1.fl"
    cat >"g/$1.golden"
}
# verdict NAME: tests one script.
verdict() { petri test "g/$1.fl"; }
passes() { status_is 0 && last_line_is out "1 passed, 0 failed"; }
fails() { status_is 1 && last_line_is out "0 passed, 1 failed" && has out "FAIL "; }

case_is same <<'END'
# run --frames 2 --print tree,log
@0 time=0 beat=0
!n a=0 b=1;2;3 c='it' d=:sym
> 1
> 2
@1 time=0.016666666666666666 beat=0.03333333333333333
!n a=0.3333333333333333 b=1;2;3 c='it' d=:sym
> 1
> 2
END
verdict same
check "the same output passes" passes
check "a script that passes gives one line" has out "ok g/same.fl"
case_is loose <<'END'
# run --frames 2 --print tree,log
# a comment that is ignored
@0 time=0 beat=0
!n a=-0 b=1.0;2e0;3 c="\x69\u0074" d=:sym
> 2
> 1
@1 time=0.016666666666666666 beat=0.03333333333333333
!n   a=0.3333333333333333 b=1;2;3 c="it" d=:sym
> 1
> 2
END
verdict loose
check "numbers and strings are compared by value, logs in any order" passes
sed 's/3333333333333333 b/3333333333333334 b/' g/same.golden >digit
case_is digit <digit
verdict digit
check "a different last digit fails" fails
check "a failure shows frame, line, expected and got" \
    has out "g/digit.golden:7: error: frame 1: expected !n a=0.3333333333333334 b=1;2;3 c='it' d=:sym, got !n a=0.3333333333333333 b"
sed 's/^# run.*/&\n# tolerance 1e-9/' digit >tolerance
case_is tolerance <tolerance
verdict tolerance
check "a difference within the tolerance passes" passes
sed 's/0.3333333333333334/0.33334/' tolerance | case_is beyond
verdict beyond
check "a difference beyond the tolerance fails" fails
sed 's/0.3333333333333334/0.33334/; s/^# tol.*/&\n# horizon 1 strict 0/' tolerance | case_is strict
verdict strict
check "after the frame of strict, numbers are compared loosely" passes
sed 's/^!n a=0.3333333333333334.*/!m/; s/^# tol.*/&\n# horizon 0/' tolerance | case_is horizon
verdict horizon
check "after the horizon, only frame headers are compared" passes
sed 's/^@1.*/@2/; s/^# tol.*/&\n# horizon 0/' tolerance | case_is header
verdict header
check "after the horizon, a different frame header fails" fails
sed 's/^# run.*/&\n# horizon 0/' digit | case_is exact
verdict exact
check "a horizon without a tolerance has no effect" fails
sed '$d' g/same.golden | case_is extra
verdict extra
check "a log line that is not in the golden fails" fails
sed 's/^> 2/> 3/' g/same.golden | case_is log
verdict log
check "a different log line fails" fails
sed 's/=:sym/=:other/' g/same.golden | case_is symbol
verdict symbol
check "a different symbol fails" fails
sed 's/^!n/    !n/' g/same.golden | case_is indent
verdict indent
check "a node at a different depth fails" fails
sed '/^@1/,$d' g/same.golden | case_is short
verdict short
check "a frame that is not in the golden fails" fails
{ cat g/same.golden && echo '@2 time=1 beat=2'; } | case_is more
verdict more
check "a missing frame fails" fails
printf '!n a=nowhere\n' >g/error.fl
printf '# run --frames 1 --print tree,error\n@0 time=0 beat=0\n!n\n' >g/error.golden
verdict error
check "errors of a frame are ignored if the golden has none" passes
echo '? something else' >>g/error.golden
verdict error
check "errors of a frame are compared if the golden has some" fails

# hashes of the state
printf '!counter state=:c\n' >g/hash.fl
hash=$(printf '$:c = 0\n$(:c;:time) = 0\n' | sha256sum | cut -d ' ' -f 1)
printf '# run --frames 1 --print hash\n@0 time=0 beat=0\n= %s\n' "$hash" >g/hash.golden
verdict hash
check "a hash is the SHA-256 of the state's text" passes
sed -i 's/= ./= x/' g/hash.golden
verdict hash
check "a different hash fails" fails
printf '!counter state=:c initial=1 rate=1\n' >g/hash.fl
printf '# run --frames 2 --print hash\n' >g/hash.golden
petri test --update g/hash.fl
verdict hash
check "--update records hashes" passes
# The second hash begins like a number: 869da8...
sed -i 's/^= 869da8/= 869.0da8/' g/hash.golden
check "the golden contains a changed hash" has g/hash.golden 869.0
verdict hash
check "digits of a hash are not compared as a number" fails
sed -i 's/^= 869.0da8/= 868da8/; s/^# run.*/&\n# tolerance 10/' g/hash.golden
verdict hash
check "a tolerance does not apply to hashes" fails
printf '!n\n' >g/oops.fl
for first in '# run --frames 1 --no-such-option' '# run "--frames 1' 'run' ''; do
    printf '%s\n@0 time=0 beat=0\n' "$first" >g/oops.golden
    verdict oops
    check "a golden that starts with '$first' fails" fails
done
printf '# run --frames 1 --print tree -D "a=:x;4" -D '"'b=1;2'"'\n@0 time=0 beat=0\n!n a=:x;4 b=1;2\n' >g/quotes.golden
printf '!n a=a b=b\n' >g/quotes.fl
verdict quotes
check "options in quotes are split as a shell does" passes
printf '!n a=read("beside.txt")\n' >g/beside.fl
printf 'text' >g/beside.txt
printf '# run --frames 1 --print tree\n@0 time=0 beat=0\n!n a="text"\n' >g/beside.golden
verdict beside
check "a script runs in its folder" passes
echo '!n (' >g/broken.fl
printf '# run --frames 1\n' >g/broken.golden
verdict broken
check "a script that cannot be loaded fails" fails
check "a failure shows the error" has out "ended with status 1: broken.fl:1:"

printf '!n a=frame\n' >g/endless.fl
printf '# run --frames 1000000000000\n' >g/endless.golden
petri_limited() { (ulimit -t 1 && timeout 100 "$petri" "$@" >out 2>err </dev/null); status=$?; }
petri_limited test g/endless.fl g/same.fl
check "a script that is killed fails" has out "g/endless.fl:1: error: was killed by signal"
check "a script that is killed does not stop the others" last_line_is out "1 passed, 1 failed"

# rejections
printf '!n a=1\n!n b=*\n' >g/wrong.fl
echo 'line 2' >g/wrong.err
verdict wrong
check "a rejected script passes" passes
echo 'line *' >g/wrong.err
verdict wrong
check "'line *' accepts any line" passes
echo 'line 1' >g/wrong.err
verdict wrong
check "a rejection in another line fails" fails
check "a rejection in another line is reported" has out "expected an error in line 1, got one in line 2"
echo 'row 2' >g/wrong.err
verdict wrong
check "an unreadable .err fails" fails
echo 'line 2' >g/wrong.err
echo '!n' >g/accepted.fl
echo 'line 1' >g/accepted.err
verdict accepted
check "a script that should be rejected and is not fails" fails

# many at once
rm -rf g
mkdir -p g/below
for name in c a b; do
    printf '!n a=frame\n' >g/$name.fl
    printf '# run --frames 1 --print tree\n@0 time=0 beat=0\n!n a=0\n' >g/$name.golden
done
cp g/a.fl g/lonely.fl
cp g/a.fl g/below/d.fl
printf '# run --frames 1 --print tree\n@0 time=0 beat=0\n!n a=1\n' >g/below/d.golden
petri test --jobs 3 g
sed -i "s|accept: $petri |accept: petri |" out # in Node.js, the program has no path
check "results come in the order of the paths" out_is "ok g/a.fl
ok g/b.fl
FAIL g/below/d.fl
g/below/d.golden:3: error: frame 0: expected !n a=1, got !n a=0
    --- recorded
    +++ now
    @@ -2,2 +2,2 @@ frame 0
     @0 time=0 beat=0
    -!n a=1
    +!n a=0
    to accept: petri test --update g/below/d.golden
ok g/c.fl
3 passed, 1 failed, 1 script without a test"
check "one failure makes the suite fail" status_is 1
petri test g/a.fl g/a.fl g/b.fl
check "a script that is named twice runs once" last_line_is out "2 passed, 0 failed"
petri test --filter below/ g
check "--filter is compared with the path below the folder" last_line_is out "0 passed, 1 failed"
petri test --filter a.fl --nosimplify g
check "--filter selects scripts by name" last_line_is out "1 passed, 0 failed"
petri test --filter nothing-like-that g
check "a filter that no script matches is an error" status_is 1
mkdir empty
petri test empty
check "a folder without goldens is an error" status_is 1
check "a folder without goldens is reported" has err "no script found"
petri test
check "test without a path is a wrong command line" status_is 2
petri test missing g/a.fl
check "a missing path is an error" status_is 1
check "a missing path does not prevent other tests" last_line_is out "1 passed, 0 failed"
petri test --junit results.xml g
check "--junit counts tests and failures" has results.xml '<testsuite name="petri" tests="4" failures="1"'
check "--junit gives the reason of a failure" has results.xml 'message="frame 0: expected !n a=1'
check "--junit has the attributes that readers require" has results.xml ' errors="0" time="'
check "--junit names the folder as class" has results.xml '<testcase classname="g.below" name="d.fl" time="'
mkdir -p lost/here
printf '# run --frames 1\n' | tee lost/old.golden >lost/here/old.golden
printf '!n\n' | tee lost/new.fl >lost/here/old.fl
petri test lost
check "a golden without a script is a failed test" status_is 1
check "a golden without a script is named" out_is "ok lost/here/old.fl
FAIL lost/old.golden
lost/old.golden:1: error: no such script: lost/old.fl; rename the test file like its script, or delete it
1 passed, 1 failed, 1 script without a test"
petri test --junit lost.xml --filter old.golden lost
check "a golden without a script is in the report" has lost.xml '<testcase classname="lost" name="old.golden" time="'
petri check lost
check "other commands ignore goldens" has err "2 files checked"
# goldens from Windows: CR LF and a byte-order mark
mkdir windows
printf '!n a=frame\n' >windows/crlf.fl
printf '# run --frames 3 --print tree\n# a remark\n' >windows/crlf.golden
printf 'let a=\n' >windows/rejected.fl
petri test --update windows
sed -i 's/$/\r/; 1s/^/\xef\xbb\xbf/' windows/crlf.golden
printf '\357\273\277line 1\r\n' >windows/rejected.err
petri test windows
check "goldens can have CR LF and a byte-order mark" last_line_is out "2 passed, 0 failed"
cp windows/crlf.golden before
petri test --update windows/crlf.fl
check "--update leaves a golden with CR LF as it is, if nothing changed" cmp before windows/crlf.golden
petri test --junit nowhere/results.xml g/a.fl
check "--junit to a missing folder fails" status_is 1
timeout 100 "$petri" test g/a.fl >/dev/full 2>err
status=$?
check "results to a full device fail" status_is 1

# --update
printf '# run --frames 1 --print tree\n# tolerance 1e-3\n# kept\n@0 time=0 beat=0\n!n a=7\n' >g/below/d.golden
chmod 640 g/below/d.golden
petri test --update g/below
check "--update exits with 0" status_is 0
check "--update reports updated goldens" has out "ok g/below/d.fl (updated)"
check "--update keeps the head and writes the output" [ "$(cat g/below/d.golden)" = "# run --frames 1 --print tree
# tolerance 1e-3
# kept
@0 time=0 beat=0
!n a=0" ]
check "--update keeps the permissions" [ "$(ls -l g/below/d.golden | cut -c 1-10)" = "-rw-r-----" ]
petri test g
check "all scripts pass after --update" last_line_is out "4 passed, 0 failed, 1 script without a test"
petri test --update g
check "--update does not modify goldens that match" lacks out "updated"
check "--update leaves no other files" [ "$(ls g/below | wc -l)" -eq 2 ]
echo '# run --frames 1 --print tree' >g/lonely.golden
petri test --update g/lonely.fl
check "--update fills a golden that has only its first line" [ "$(cat g/lonely.golden)" = "# run --frames 1 --print tree
@0 time=0 beat=0
!n a=0" ]
echo '!n (' >g/lonely.fl
petri test --update g/lonely.fl
check "--update does not record a failure" has g/lonely.golden "!n a=0"

# The state of a frame that differs.
echo '!counter state=:a rate=1
!counter state=:b;1 rate=2' >g/turns.fl
echo '# run --frames 3 --print state --every 2' >g/turns.golden
petri test --update g/turns.fl
sed -i 's/^\(\$(:b;1) = \)0.0666.*/\10.06666666666666668/' g/turns.golden
verdict turns
check "a state that differs fails" fails
sed -n '2,$p' out | sed 's/^    //' >report
cat >expected <<'END'
g/turns.golden:10: error: frame 2: expected $(:b;1) = 0.06666666666666668, got $(:b;1) = 0.06666666666666667
--- recorded
+++ now
@@ -7,5 +7,5 @@ frame 2
 @2 time=0.03333333333333333 beat=0.06666666666666667
 $:a = 0.03333333333333333
 $(:a;:time) = 0.03333333333333333
-$(:b;1) = 0.06666666666666668
+$(:b;1) = 0.06666666666666667
 $(:b;1;:time) = 0.03333333333333333
frame 2: 1 of 4 entries of the state differ
distance of the first one in ulps: 1
END
check "a failure shows the entries of the state that differ" [ "$(head -n 12 report)" = "$(cat expected)" ]
sed -i 's/^# run.*/&\n# tolerance 1e-12/; s/0.0666.*/0.07/' g/turns.golden
verdict turns
check "with a tolerance, a failure does not count entries of the state" lacks out "entries"

# A run whose motion becomes meaningless fails, even if its output is as recorded.
cat >g/explodes.fl <<'END'
!physics state=:s dimensions=1
    !anchor id=:wall
    !particle id=:weight position=10
    !distance from=:wall to=:weight fixed=8 strength=30000
END
echo '# run --frames 20 --print state' >g/explodes.golden
petri test --update g/explodes.fl
check "the first frames of an explosion can be recorded" passes
sed -i 's/20/60/' g/explodes.golden
petri test --update g/explodes.fl
check "an explosion is not recorded" status_is 1
check "the message names frame, particle and force" has out \
    "explodes.fl:4:5: warning: !physics state=:s: the kinetic energy has grown more than a millionfold in ten steps, in frame 30 at particle :weight; the largest force on it is this !distance"
petri run g/explodes.fl --frames 300
check "a run with an explosion ends with status 0" status_is 0
check "an explosion is reported once" count_is err "divergence" 1
check "an unstable force is reported once" count_is err "unstable-force" 1
