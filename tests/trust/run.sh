#!/bin/sh
# run.sh: tests of `petri trust` and `petri sweep --trust` as users run them. cases.py tests the numbers.
# usage: tests/trust/run.sh PATH-OF-PETRI
# shellcheck disable=SC2016 # dollars are for petri
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
scratch
unset NO_COLOR

trust() {
    timeout 100 "$petri" trust "$@" >out 2>err </dev/null
    status=$?
}
# same_after COMMAND...: the output of the command is that of the last one.
same_after() {
    mv out before
    "$@"
    cmp before out
}

cat >spring.fl <<'END'
let K=K or 10 -- 1..1e6 strength
!physics state=:s dimensions=1
    !anchor id=:wall
    !particle id=:ball position=2.5
    !distance from=:wall to=:ball fixed=2 strength=K
END

# --- values and verdicts

trust spring.fl
check "the energy is the default" eval 'status_is 0 && has out "energy: " && ! has out "(:s"'
trust spring.fl '$(:s;:ball)' '2+2' energy --frames 100 --every 30 --json
check "there is an object for each expression and frame" [ "$(grep -c '^  {"frame": [0-9]*, "expression": ' out)" -eq 15 ]
check "a constant has all digits" [ "$(grep -c '"2+2", "value": 4, "error": 0, .*"digits": 15, .*"verdict": "converged: 15 digits"' out)" -eq 5 ]
if command -v python3 >/dev/null; then
    check "the output is JSON" python3 -c 'import json; json.load(open("out"))'
fi
check "the value is that of a run" eval '"$petri" run spring.fl --frames 100 --print state >run && grep -qF \
    "$(sed -n "s/.*\"frame\": 99, \"expression\": \"..:s;:ball.\", \"value\": \([-0-9.e]*\).*/\1/p" out)" run'
trust spring.fl 'null' "'text'" '1;2;3' '$(:s;:ball);1e300'
check "values that are not numbers have no digits" [ "$(grep -c '  -  *-  *-  *-\|: not a number' out)" -ge 2 ]
check "vectors are compared" has out "1;2;3: converged: 15 digits"
trust spring.fl '$(:s;:ball)' -D K=1e6
check "an unstable force is named with its line" eval 'status_is 1 && has out "unstable since frame 1 because of the force in line 5"'
check "the diagnostic of the first run is shown once" [ "$(grep -c 'unstable-force\|is unstable: with' err)" -eq 1 ]
sed 's/resolution=[^ ]*//; s/dimensions=1/dimensions=1 resolution=1\/480/' spring.fl >fine.fl
trust fine.fl '$(:s;:ball)'
check "shorter steps give a shorter error" eval 'status_is 0 && has out "0.0"'

# --- several processes and the cache

trust spring.fl '$(:s;:ball)' --frames 200 --cache results
check "results are stored" has err "1 runs computed, 0 from the cache"
check "and found again" same_after trust spring.fl '$(:s;:ball)' --frames 200 --cache results
check "without another run" has err "0 runs computed, 1 from the cache"
check "threads do not matter" same_after trust spring.fl '$(:s;:ball)' --frames 200 --threads 2
trust spring.fl '$(:s;:ball)' --frames 200 --cache results -D K=11
check "a definition is another result" has err "1 runs computed, 0 from the cache"

# --- sweeps

sweep() {
    timeout 100 "$petri" sweep "$@" >out 2>err </dev/null
    status=$?
}
sweep spring.fl -D 'K=1;10;1e6' --frames 100 --metric 'x=$(:s;:ball)' --metric energy --trust
check "each metric has a column" has out "run,K,frame,x,x_digits,energy,energy_digits,error"
check "an unstable run is marked" eval 'status_is 1 && [ "$(grep -c "1e6,.*this !distance" out)" -eq 1 ]'
sweep spring.fl -D 'K=1;10' --frames 100 --metric 'x=$(:s;:ball)'
cut -d, -f1-4 out >plain
sweep spring.fl -D 'K=1;10' --frames 100 --metric 'x=$(:s;:ball)' --trust --cache results
cut -d, -f1-4 out >trusted
check "values are those without --trust" cmp plain trusted
check "and also those of the cache" same_after sweep spring.fl -D 'K=1;10' --frames 100 --metric 'x=$(:s;:ball)' --trust --cache results
sweep spring.fl -D 'K=1;10' --until 'frame > 3' --metric 'x=$(:s;:ball)' --trust
check "runs of unknown length are rejected" eval 'status_is 2 && has err "use --frames instead of --until"'
sweep spring.fl -D K=1 --metric x=1 --metric x_digits=2 --trust
check "the name of a column is not used twice" eval 'status_is 2 && has err "x_digits: the table already has"'

# --- means

cat >dish.fl <<'END'
let SEED=SEED or 1
!physics state=:t dimensions=1 run=SEED
    !anchor id=:wall
    !particle id=:bead position=5 radius=1
    !distance from=:wall to=:bead fixed=5
    !random strength=20
    !drag strength=2
END
trust dish.fl '$(:t;:bead)' --seeds 8 --frames 300 --json
check "means have intervals" grep -q '"mean": [45]\.[0-9]*, "half_width": [0-9.]*, "step": [0-9.e-]*, "runs": 8,' out
check "the number of jobs does not matter" same_after trust dish.fl '$(:t;:bead)' --seeds 8 --frames 300 --json --jobs 1
trust dish.fl '$(:t;:bead)' --within 3% --frames 600 --cache runs
check "runs are added until the interval is narrow" eval 'status_is 0 && grep -q "within [12][.0-9]* %" out'
count=$(sed -n 's/^petri: \([0-9]*\) runs computed, 0 from the cache.*/\1/p' err | head -n 1)
check "more than the first runs are needed" [ "$count" -gt 20 ]
check "the runs with halves of the steps are the same" [ "$(grep -c "$count runs computed" err)" -eq 2 ]
check "and are said to be those" has err "with halves of the steps: $count runs computed"
trust dish.fl '$(:t;:bead)' --within 3% --frames 600 --cache runs
check "an interrupted search resumes from the cache" has err "0 runs computed, $count from the cache"
trust dish.fl '$(:t;:bead)' --within 0.01% --seeds 10 --frames 600
check "a limit says how many runs are needed" eval 'has out "misses 0.01 %: within " && has out "runs would give 0.01 %"'
check "a missed width is a failure" status_is 1
trust dish.fl '$(:t;:bead)' 1 --seeds 10 --frames 600 --json
check "a width that nobody wants is none" eval 'status_is 0 && has out "\"verdict\": \"within "'
trust dish.fl '0*$(:t;:bead)' --seeds 10 --frames 600 --within 1%
check "the mean 0 of equal values has an interval" eval 'status_is 0 && has out "within 0 %"'
trust dish.fl '$(:t;:bead)+frame*0.006' --seeds 8 --frames 600
check "a drift leaves no interval" eval 'has out "still drifts, by " && has out " from the third to the fourth quarter; use more frames" && has out "  -  "'
trust dish.fl '$(:t;:bead)+frame*0.006' --within 5% --frames 600 --cache drift
check "a clear drift ends the search" eval 'status_is 1 && has err "petri: 20 runs computed"'
trust dish.fl '$(:t;:bead)+(1 if frame < 300 else 0)' --seeds 8 --frames 600
check "a drift of the first half does not matter" has out "within "
sed 's/dimensions=1/& resolution=RES/; s/^let /let RES=RES or 0.002 /' dish.fl >steps.fl
trust steps.fl '$(:t;:bead;:velocity)**2' --seeds 10 --frames 600 --fps 2 -D RES=0.5
check "an error of the step that is not noise asks for a smaller resolution" eval 'has out "the step adds up to " && has out ": use a smaller resolution"'
trust steps.fl '$(:t;:bead;:velocity)**2' --seeds 10 --frames 600
check "an error of the step that is small is not mentioned" eval '! has out "the step"'
trust spring.fl '$(:s;:ball)' --seeds 4
check "runs that do not differ have no interval" eval 'has out "the runs are alike" && has out "  -  "'
trust dish.fl 1 --seeds 4 --frames 10
check "a constant is its mean" grep -q "^1 *1 *0 *0 *4 " out
trust dish.fl 1 --within 0
check "a width of 0 is rejected" eval 'status_is 2 && has err "a percentage above 0"'

trust spring.fl energy -D 'K=10;20' --frames 10
check "values as for a sweep get a hint" eval 'has err "K=10;20 is a vector, but the default 10 is one number" && has err "petri sweep --trust varies it"'
trust spring.fl energy -D K=20 --frames 10
check "one value gets none" eval 'status_is 0 && ! has err vector'
cat >late.fl <<'END'
let here=$(:s;0)
func now()
    $(:s;0)
!physics state=:s dimensions=1
    !particle id=0 position=0 velocity=1
END
trust late.fl here --frames 10
check "a let that reads the state gets a hint" has err "'here' is a 'let' that reads the state, so it is one frame late"
trust late.fl 'now()' --frames 10
check "a function gets none" eval 'status_is 0 && ! has err "one frame"'
trust dish.fl energy --seeds 4 --every 10
check "rows of means are rejected" eval 'status_is 2 && has err "'"'--every'"'"'

# --- errors

trust
check "a script is needed" eval 'status_is 2 && has err "no script given"'
trust missing.fl
check "a missing script is reported" eval 'status_is 1 && has err missing.fl'
trust spring.fl 'nope+1'
check "an unbound name is an error" eval 'status_is 2 && has err "unbound name" && has err "expression: '"'nope+1'"'" && ! has err metric'
trust spring.fl '1+'
check "a syntax error is an error" eval 'status_is 2 && has err "cannot evaluate"'
trust - '1'
check "standard input is rejected" eval 'status_is 2 && has err "standard input"'
trust spring.fl --frames 0
check "a frame is needed" status_is 2
trust spring.fl --work 5
check "a run that fails is reported" eval 'status_is 1 && has err "work"'
finish
