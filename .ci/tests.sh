# tests.sh: implements `./dev test`. Sourced by dev after progress.sh and packages.sh, with `root` and `build` defined.

# counts NAME LOG: prints the number that meson's summary in LOG gives for NAME.
counts() { awk -F: -v name="$1" '$1 == name { n = $2 } END { print n + 0 }' "$2"; }

# Shows how many tests are finished, and the name of the first unfinished test in meson's list. Tests start in the order
# of this list, so that test has been running the longest.
follow_tests() {
    waiting=$chosen
    counted tests 0 "$(echo "$waiting" | wc -l)" "$(echo "$waiting" | head -n 1)"
    while read -r number _ rest; do
        case $number in
        [0-9]*/[0-9]*)
            name=${rest#*/ }
            waiting=$(echo "$waiting" | grep -vxF "${name%% *}") || true
            counted tests "${number%/*}" "${number#*/}" "$(echo "$waiting" | head -n 1)"
            ;;
        esac
    done
}

# choose_tests [--all | NAME...]: sets `chosen` to the tests and `folders` to the folders of scripts with these names or in
# these suites; without names, to all that are not in the suite `thorough`; with --all, to all. Sets `omitted` to the suites
# that do not run.
choose_tests() {
    folders=
    for folder in tests/golden tests/conformance samples; do
        [ ! -d $folder ] || folders="$folders $folder"
    done
    omitted='--no-suite scripts'
    [ $# -gt 0 ] || omitted="$omitted --no-suite thorough"
    # shellcheck disable=SC2086 # options are words
    list=$(meson test -C build --no-rebuild $omitted --list 2>/dev/null | sed -n 's|^\([^ ]*\) / |\1 |p')
    chosen=$(echo "$list" | sed 's/.* //')
    [ $# -gt 0 ] && [ "$1" != --all ] || return 0
    present=$folders
    chosen='' folders=''
    for name; do
        found=$(echo "$list" | awk -v name="$name" '$NF == name || (":" $1 "+") ~ ("[:+]" name "[+]") { print $NF }')
        for folder in $present; do
            [ "${folder##*/}" != "$name" ] || folders="$folders $folder" found="$found "
        done
        [ -n "$found" ] || die "no such test or suite: '$name'; for a list, run: meson test -C build --list"
        chosen="$chosen $found"
    done
    chosen=$(echo "$chosen" | tr -s ' ' '\n' | awk 'NF && !seen[$0]++')
}

# Prints the tests that were skipped, each with its reason.
skipped_tests() {
    awk '/^=+ [0-9]+\/[0-9]+ =+$/ { name = "" }
        /^test: / && name == "" { name = $NF; reason = 0 }
        /^result: .*exit status 77$/ { all[name] = 1 }
        sub(/^skipped: /, "") { print "skipped: " name ": " $0; delete all[name] }
        END { for (name in all) print "skipped: " name ": no reason given" }' "$1"
}

# run_tests [--all | NAME...]: builds, runs the tests and prints the results.
run_tests() {
    build "$TEST_NEEDS" ''
    cd "$root"
    log=build/tests.log scripts=build/scripts.log
    code=0 good=0 bad=0 failed=''
    : >"$log"
    choose_tests "$@"
    if [ $# -eq 0 ] || [ -n "$chosen" ]; then
        # Runs more tests in parallel than there are processors, because some tests mostly wait.
        [ "${1:-}" != --all ] || shift
        # shellcheck disable=SC2086 # options and names are words
        following $log follow_tests meson test -C build --no-rebuild $omitted --print-errorlogs \
            --num-processes "$(($(nproc) + 2))" ${1:+$chosen} || code=1
        # Removes the lines of passed tests, also within a failed program. Keeps a test case that did not end.
        sed -e '/^\[ *RUN *\]/{' -e N -e '/\n\[ *OK *\]/d' -e '}' "$log" |
            grep -v -e '^ninja: ' -e ' OK  ' -e '^Full log' -e '^$' -e ':  *0 *$' -e '^ok ' || true
        [ ! -f build/meson-logs/testlog.txt ] || skipped_tests build/meson-logs/testlog.txt
        good=$(counts Ok "$log")
        bad=$(($(counts Fail "$log") + $(counts Timeout "$log") + $(counts 'Unexpected Pass' "$log")))
        failed=$(sed -nE 's#^ *[0-9]+/[0-9]+ [^/]* / ([^ ]+) +(FAIL|TIMEOUT|ERROR|UNEXPECTEDPASS|INTERRUPT) .*#\1#p' "$log" | sort -u)
        # Meson may fail without a failed test; count that as a failure.
        [ "$code" -eq 0 ] || [ "$bad" -gt 0 ] || bad=1
    fi
    for folder in $folders; do
        code=0
        .ci/clean-env build/petri test "$folder" >"$scripts" 2>&1 </dev/null || code=1
        cat "$scripts" >>"$log"
        grep -v "^ok " "$scripts" | sed '$d' || true
        summary=$(tail -n 1 "$scripts")
        echo "scripts in $folder: $summary"
        case $summary in
        *' passed, '*' failed')
            good=$((good + ${summary%% passed*}))
            summary=${summary#* passed, }
            summary=${summary% failed}
            ;;
        *) summary=1 ;;
        esac
        [ "$code" -eq 0 ] || [ "$summary" -gt 0 ] || summary=1
        bad=$((bad + summary))
        [ "$summary" -eq 0 ] || failed="$failed ${folder##*/}"
    done
    [ "$bad" -eq 0 ] || echo "log: build/tests.log; to repeat: ./dev test$(printf ' %s' $failed)"
    echo "$good passed, $bad failed"
    [ "$bad" -eq 0 ]
}
