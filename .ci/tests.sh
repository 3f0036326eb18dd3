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

# Lists the folders of scripts that tests can name.
script_folders() {
    for folder in tests/golden tests/conformance samples; do
        [ ! -d "$root/$folder" ] || echo $folder
    done
}

# unlikely_names NAME...: prints those names that no test, suite or folder of scripts can have, because meson.build does not
# contain their parts. Meson need not be installed.
unlikely_names() {
    {
        script_folders | sed 's|.*/||'
        find "$root/tests" -name meson.build -exec sed -e '/^ *#/d' {} +
    } | tr -cs 'A-Za-z0-9' '\n' | awk -- '
        BEGIN {
            for (i = 1; i < ARGC; i++)
                name[i] = ARGV[i]
            count = ARGC
            ARGC = 1 # reads standard input
        }
        { parts[$0] }
        END {
            for (i = 1; i < count; i++) {
                bad = name[i] == ""
                n = split(name[i], word, "[-_+]")
                for (j = 1; j <= n; j++)
                    bad = bad || (word[j] != "" && !(word[j] in parts))
                if (bad)
                    print name[i]
            }
        }' "$@"
}

# reject_names SUBCOMMAND NAMES: if there are lines in NAMES, reports the first as unknown, and exits.
reject_names() {
    [ -z "$2" ] || reject "$1" "no such test or suite: '$(echo "$2" | head -n 1)'; tests/README.md lists the suites"
}

# choose_tests SUBCOMMAND FOLDER [--all | NAME...]: sets `chosen` to the tests of a build folder and, if there are
# names, `targets` to what they need. Exits if a NAME is unknown.
choose_tests() {
    subcommand=$1
    shift
    facts=$(python3 "$root/.ci/tests.py" "$@")
    reject_names "$subcommand" "$(echo "$facts" | sed -n 's/^unknown //p')"
    chosen=$(echo "$facts" | sed -n 's/^test //p')
    targets=$(echo "$facts" | sed -n 's/^target //p')
}

# Prints the tests that were skipped, each with its reason.
skipped_tests() {
    awk '/^=+ [0-9]+\/[0-9]+ =+$/ { name = "" }
        /^test: / && name == "" { name = $NF; reason = 0 }
        /^result: .*exit status 77$/ { all[name] = 1 }
        sub(/^skipped: /, "") { print "skipped: " name ": " $0; delete all[name] }
        END { for (name in all) print "skipped: " name ": no reason given" }' "$1"
}

# run_tests [--all | NAME...]: builds what the tests need, runs them and prints the results.
run_tests() {
    all_folders=$(script_folders)
    case ${1:-} in
    '' | --all)
        omitted='--no-suite scripts'
        [ $# -gt 0 ] || omitted="$omitted --no-suite thorough"
        folders=$all_folders
        prepare "$TEST_NEEDS"
        choose_tests test "$root/build" "$@"
        targets=all names=''
        ;;
    *)
        reject_names test "$(unlikely_names "$@")"
        omitted='' folders='' other=''
        for name; do
            found=$(echo "$all_folders" | grep -E "(^|/)$name\$") || other="$other $name"
            folders="$folders $found"
        done
        targets='' chosen=''
        if [ -n "$other" ]; then
            prepare "$TEST_NEEDS"
            # Meson's lists must be those of the sources.
            make_targets "$root/build" build.ninja
            # shellcheck disable=SC2086 # names are words
            choose_tests test "$root/build" $other
        else
            prepare "$RUN_NEEDS"
        fi
        [ -z "$(echo "$folders" | xargs)" ] || targets="$targets src/petri"
        targets=$(echo "$targets" | xargs)
        names=$chosen
        ;;
    esac
    [ -z "$targets" ] || make_targets "$root/build" "$targets" # some tests need only the sources
    cd "$root"
    log=build/tests.log scripts=build/scripts.log
    code=0 good=0 bad=0 failed=''
    : >"$log"
    if [ -n "$chosen" ]; then
        # Runs more tests in parallel than there are processors, because some tests mostly wait.
        # shellcheck disable=SC2086 # options and names are words
        following $log follow_tests meson test -C build --no-rebuild $omitted --print-errorlogs \
            --num-processes "$(($(nproc) + 2))" $names || code=1
        # Removes the lines of passed tests, also within a failed program. Keeps a test case that did not end.
        sed -e '/^\[ *RUN *\]/{' -e N -e '/\n\[ *OK *\]/d' -e '}' "$log" |
            grep -v -e '^ninja: ' -e ' OK  ' -e '^Full log' -e '^$' -e ':  *0 *$' -e '^ok ' || true
        [ ! -f build/meson-logs/testlog.txt ] || skipped_tests build/meson-logs/testlog.txt
        good=$(counts Ok "$log")
        bad=$(($(counts Fail "$log") + $(counts Timeout "$log") + $(counts 'Unexpected Pass' "$log")))
        failed=$(sed -nE 's#^ *[0-9]+/[0-9]+ [^/]* / ([^ ]+) +(FAIL|TIMEOUT|ERROR|UNEXPECTEDPASS|INTERRUPT) .*#\1#p' "$log" | sort -u)
        sed -nE 's#^ *[0-9]+/[0-9]+ [^/]* / ([^ ]+) +TIMEOUT +([^ ]+).*#timed out after \2, perhaps because the machine was busy: \1; to repeat: ./dev test \1#p' "$log"
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
        *' passed, '*' failed'*)
            good=$((good + ${summary%% passed*}))
            summary=${summary#* passed, }
            summary=${summary%% failed*}
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
