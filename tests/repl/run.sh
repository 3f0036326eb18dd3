#!/bin/sh
# run.sh PETRI [--update] [FILE...]: replays recorded sessions of `petri repl` and compares the output.
#
# NAME.session is a transcript. Its first line holds the options, `# repl [VARIABLE=VALUE...] [options] [SCRIPT]`.
# Lines that begin with a prompt (`petri> `, `@12> `, `... `) are input, all others output; the last line is the exit
# status. If the last prompt is empty, it is the end of the input. Times such as `147 us` are not compared.
# `petri test` must reproduce the goldens that a session records.
set -u
here=$(cd "$(dirname "$0")" && pwd)
petri=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
shift
update=no
if [ "${1:-}" = --update ]; then
    update=yes
    shift
fi
[ $# -gt 0 ] || set -- "$here"/*.session
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
unset NO_COLOR
passed=0
failed=0

# typed SESSION: prints the input, which is the text after the prompts.
typed() {
    awk '
        match($0, /^(petri|@[0-9]+)> /) || match($0, /^\.\.\. /) { line[++count] = substr($0, RLENGTH + 1) }
        END {
            last = count - (line[count] == "")
            for (i = 1; i <= last; i++)
                print line[i]
        }' "$1"
}

plain_times() { sed -E 's/^-- [0-9.e+-]+ (s|ms|us|ns)(,|$)/-- TIME\2/' "$1"; }

for session in "$@"; do
    name=$(basename "$session" .session)
    folder=$work/$name
    mkdir "$folder"
    cp -R "$here"/*.fl "$here"/lib "$folder"/
    options=$(sed -n '1s/^# repl *//p' "$session")
    typed "$session" >"$work/in"
    (
        cd "$folder" || exit 1
        # shellcheck disable=SC2086 # options are words
        set -- $options
        variables=
        while [ $# -gt 0 ]; do
            case $1 in
            [A-Z]*=*) variables="$variables $1" && shift ;;
            *) break ;;
            esac
        done
        echo "# repl${options:+ $options}"
        # shellcheck disable=SC2086 # variables are words
        env LC_ALL=C $variables timeout 60 "$petri" repl "$@" <"$work/in" 2>&1
        echo "# exit status $?"
    ) >"$work/out"
    plain_times "$work/out" >"$work/got"
    plain_times "$session" >"$work/want"
    if cmp -s "$work/want" "$work/got"; then
        passed=$((passed + 1))
        echo "ok $name"
    elif [ $update = yes ]; then
        cp "$work/got" "$session"
        echo "updated $name"
    else
        failed=$((failed + 1))
        echo "FAIL $name"
        diff "$work/want" "$work/got"
    fi
    if ls "$folder"/*.golden >/dev/null 2>&1; then
        if "$petri" test "$folder" >"$work/test" 2>&1; then
            passed=$((passed + 1))
            echo "ok $name: petri test reproduces its goldens"
        else
            failed=$((failed + 1))
            echo "FAIL $name: petri test reproduces its goldens"
            cat "$work/test"
        fi
    fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
