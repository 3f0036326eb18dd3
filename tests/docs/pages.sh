#!/bin/sh
# pages.sh PETRI ROOT [--update]: runs the commands that README.md, src/manual/ and the pages below show, and checks the
# links of all pages.
#
# Each page is read from top to bottom in a separate folder. For a page of samples/ it contains the samples; for other
# pages it contains samples, lib and build, as the project's root does.
#   ```flitter NAME.fl          writes a script of that name; `petri check --werror` and a run of three frames must print
#                               no diagnostics
#   ```flitter NAME.fl warns    writes a script that has warnings and is not checked
#   ```c NAME.c                 writes a file of that name
#   ```console                  runs lines `$ COMMAND`; the following lines are the expected output, in which a line
#                               `...` matches any number of lines
#   ```session ARGUMENTS        gives the inputs of a session to `petri repl ARGUMENTS`; the block is its expected output
#   ![…](PATH/NAME.png)         if an earlier command made NAME.png, it must have the size in pixels of the stored picture
#                               and about its file size; --update stores the new picture
#   [text](PATH#HEADING)        the file and the heading must exist
# A failure is a line with the position in the page. Too few examples are also a failure.
#
# Complete videos would take nine tenths of the test's time. Therefore they have only 13 frames, and only their image
# size is compared. PAGES=whole makes complete videos, as in CI.
set -u
LC_ALL=C.UTF-8
export LC_ALL

pages='README.md CONTRIBUTING.md src/README.md samples/README.md samples/TUTORIAL.md samples/RECIPES.md
    samples/TROUBLESHOOTING.md tests/README.md tests/bench/README.md tests/bench/PEERS.md src/web/README.md'
min_examples=600

[ $# -ge 2 ] || { echo "usage: pages.sh PETRI ROOT [--update]" >&2 && exit 2; }
petri=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
root=$(cd "$2" && pwd)
pages="$pages $(cd "$root" && echo src/manual/*.md)"
linked="CHANGELOG.md .github/SECURITY.md .github/CODE_OF_CONDUCT.md src/python/TUTORIAL.md
    src/editors/vscode/README.md src/web/engine/README.md
    $(cd "$root" && echo grammar/README.md lib/*/*.md)"
update=${3:-}
whole=${update:+yes}
[ "${PAGES:-}" != whole ] || whole=yes
work=$(mktemp -d "${TMPDIR:-/tmp}/petri-pages.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP
mkdir "$work/bin"
ln -s "$petri" "$work/bin/petri"
PATH=$work/bin:$PATH
export PATH
# For pages that commit scripts.
GIT_AUTHOR_NAME=reader GIT_AUTHOR_EMAIL=reader@example.org
GIT_COMMITTER_NAME=$GIT_AUTHOR_NAME GIT_COMMITTER_EMAIL=$GIT_AUTHOR_EMAIL
export GIT_AUTHOR_NAME GIT_AUTHOR_EMAIL GIT_COMMITTER_NAME GIT_COMMITTER_EMAIL

can_draw=yes
printf '!window size=1;1\n    !canvas\n' >"$work/empty.fl"
petri render "$work/empty.fl" --frames 1 -o "$work/empty.png" >"$work/out" 2>&1 || can_draw=
can_film=yes
command -v ffmpeg >/dev/null || can_film=

# With sanitizers, linking a library needs options that the pages do not show.
build=$(dirname "$(dirname "$(readlink -f "$petri")")")
can_link=
if ! nm "$build/lib/session/libpetri.a" 2>/dev/null | grep -q -e __asan -e __ubsan; then
    can_link=yes
fi

passed=0
failed=0
good() { passed=$((passed + 1)); }
bad() { # POSITION TEXT
    failed=$((failed + 1))
    echo "$1: $2"
}

# Splits a page into steps, written in order as lines `LINE KIND N WORDS…`. N.text contains a script; N.command and
# N.want contain a command and its expected output.
split() { # PAGE FOLDER
    awk -v folder="$2" '
        function step(kind, words) { print NR, kind, ++count, words > (folder "/steps") }
        function finish() { if (wanted) close(wanted); wanted = "" }
        fence == "" && /^```/ {
            fence = $1
            opened = NR
            if (($1 == "```flitter" || $1 == "```c") && $2 != "") {
                step($1 == "```c" ? "file" : "script", $2 " " $3)
                text = folder "/" count ".text"
                printf "" > text
            }
            if ($1 == "```session") {
                sub(/^```session */, "")
                step("command")
                print "petri repl " $0 " <" folder "/" count ".in 2>&1" > (folder "/" count ".command")
                close(folder "/" count ".command")
                wanted = folder "/" count ".want"
                inputs = folder "/" count ".in"
            }
            next
        }
        fence != "" && /^```[ \t]*$/ {
            if (text) close(text)
            if (inputs) close(inputs)
            text = inputs = fence = ""
            finish()
            next
        }
        text { print > text }
        inputs {
            print > wanted
            if (match($0, /^(petri|@[0-9]+)> ?/) || match($0, /^\.\.\.( |$)/))
                print substr($0, RLENGTH + 1) > inputs
        }
        fence == "```console" && /^\$ / {
            finish()
            step("command")
            print substr($0, 3) > (folder "/" count ".command")
            close(folder "/" count ".command")
            wanted = folder "/" count ".want"
            printf "" > wanted
            next
        }
        fence == "```console" && !wanted { step("fault", "output without a command") }
        fence == "```console" { print > wanted }
        fence == "" {
            rest = $0
            while (match(rest, /!\[[^]]*\]\([^)]*\)/)) {
                link = substr(rest, RSTART, RLENGTH)
                rest = substr(rest, RSTART + RLENGTH)
                sub(/^.*\(/, "", link)
                sub(/\)$/, "", link)
                step("picture", link)
            }
            rest = $0
            while (match(rest, /\]\([^)]+/)) {
                link = substr(rest, RSTART, RLENGTH)
                rest = substr(rest, RSTART + RLENGTH)
                if (link !~ /^..https?:/)
                    step("link", substr(link, 3))
            }
        }
        END { if (fence != "") step("fault", "the block of line " opened " is not closed") }' "$1"
}

# Prints the first difference between the output of a command and the page, or nothing if they agree.
difference() { # WANT GOT
    awk 'FILENAME == ARGV[1] { want[++wants] = $0; next }
         { sub(/[ \t]+$/, ""); got[++gots] = $0 }
         END {
             for (i = j = 1; i <= wants; i++) {
                 if (want[i] == "...") {
                     if (i == wants)
                         exit
                     while (j <= gots && got[j] != want[i + 1])
                         j++
                 } else if (j > gots) {
                     print "expected " want[i] ", got nothing"
                     exit
                 } else if (got[j] != want[i]) {
                     print "expected " want[i] ", got " got[j]
                     exit
                 } else {
                     j++
                 }
             }
             if (j <= gots)
                 print "expected nothing more, got " got[j]
         }' "$1" "$2"
}

run_script() { # POSITION TEXT NAME WARNS
    cp "$2" "$3"
    [ -z "${4:-}" ] || return 0
    if ! petri check --werror "$3" >out 2>&1 </dev/null; then
        bad "$1" "petri check: $(head -n 1 out)"
    elif ! timeout 60 petri run --frames 3 --print error "$3" >out 2>&1 </dev/null || grep -q ': warning: ' out; then
        bad "$1" "petri run: $(grep -m 1 warning out || head -n 1 out)"
    else
        good
    fi
}

run_command() { # POSITION COMMAND WANT
    case $(cat "$2") in
    *render*.gif* | *render*.mp4* | *ffmpeg*) [ -n "$can_draw" ] && [ -n "$can_film" ] || return 0 ;;
    *render*) [ -n "$can_draw" ] || return 0 ;;
    *libpetri.a* | ./*) [ -n "$can_link" ] || return 0 ;;
    esac
    if [ "$whole" ]; then
        cp "$2" command
    else
        sed 's/petri render .*\(%05d\|\.gif\|\.mp4\).*/& --frames 13/' "$2" >command
    fi
    timeout 120 sh ./command >out 2>&1 </dev/null
    [ $? -ne 124 ] || bad "$1" "did not finish within 120 s"
    fault=$(difference "$3" out)
    if [ -n "$fault" ]; then bad "$1" "$fault"; else good; fi
}

# Prints the bytes of a PNG or GIF file that contain its width and height.
size_of() {
    case $1 in
    *.gif) od -An -tu1 -j6 -N4 "$1" ;;
    *) od -An -tu1 -j16 -N8 "$1" ;;
    esac
}

compare_picture() { # POSITION LINK FOLDER-OF-PAGE
    stored=$3/$2
    made=${2##*/}
    if [ ! -e "$made" ]; then
        if [ -e "$stored" ]; then good; else bad "$1" "no such picture: $2; no command makes it"; fi
        return
    fi
    if [ "$update" = --update ]; then
        mkdir -p "$(dirname "$stored")"
        cp "$made" "$stored"
    fi
    new=$(wc -c <"$made")
    old=$(wc -c <"$stored" || echo 0)
    if [ "$(size_of "$made")" != "$(size_of "$stored")" ]; then
        bad "$1" "$made has other dimensions than the stored picture"
    elif [ "${made%.gif}" != "$made" ] && [ ! "$whole" ]; then
        good
    elif [ "$new" -gt $((2 * old)) ] || [ "$old" -gt $((2 * new)) ]; then
        bad "$1" "$made has $new bytes, the stored picture $old"
    elif [ "$old" -gt 1000000 ]; then
        bad "$1" "$made is larger than a megabyte"
    else
        good
    fi
}

# Prints the anchors of a page's headings.
headings() { # PAGE
    sed -n '/^```/,/^```/d; s/^##* //p' "$1" | tr '[:upper:] ' '[:lower:]-' | tr -d '!-,./:-@[-^`{-~'
}

follow_link() { # POSITION PAGE LINK
    target=$(dirname "$2")/${3%%#*}
    [ "${3%%#*}" ] || target=$2
    if [ ! -e "$target" ]; then
        bad "$1" "no such file: $3"
    elif [ "${3#*#}" != "$3" ] && ! headings "$target" | grep -qxF -e "${3#*#}"; then
        bad "$1" "no such heading: $3"
    else
        good
    fi
}

for page in $pages; do
    folder=$work/$page
    mkdir -p "$folder/steps.d" "$folder/at"
    case $page in
    samples/*) cp -R "$root"/samples/*.fl "$root/samples/lib" "$folder/at" ;;
    *)
        ln -s "$root/samples" "$root/lib" "$folder/at"
        ln -s "$build" "$folder/at/build"
        ;;
    esac
    split "$root/$page" "$folder/steps.d"
    [ -e "$folder/steps.d/steps" ] || continue
    cd "$folder/at" || exit 1
    while read -r line kind number words; do
        place=$page:$line
        base=$folder/steps.d/$number
        # shellcheck disable=SC2086 # a name and perhaps `warns`
        case $kind in
        script) run_script "$place" "$base.text" $words ;;
        file) cp "$base.text" $words ;;
        command) run_command "$place" "$base.command" "$base.want" ;;
        picture) compare_picture "$place" "$words" "$root/$(dirname "$page")" ;;
        link) follow_link "$place" "$root/$page" "$words" ;;
        fault) bad "$place" "$words" ;;
        esac
    done <"$folder/steps.d/steps"
done

# Only links are checked here; other tests run the examples of these pages.
for page in $linked; do
    folder=$work/linked/$page
    mkdir -p "$folder"
    split "$root/$page" "$folder"
    [ -e "$folder/steps" ] || continue
    while read -r line kind number words; do
        [ "$kind" != link ] || follow_link "$page:$line" "$root/$page" "$words"
    done <"$folder/steps"
done

if [ $((passed + failed)) -lt $min_examples ]; then
    echo "found $((passed + failed)) examples, expected at least $min_examples; has the form of the blocks changed?"
    [ -z "$can_draw$can_film" ] || failed=$((failed + 1))
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
