# manual.sh: tests of the manual pages, completions and desktop files in `prefix`. Tests whose tool is missing are
# reported as skipped. Sourced by run.sh.
# shellcheck shell=sh disable=SC2154 # check.sh and run.sh set them
share=$prefix/share
without() { echo "skipped: $1: no $2"; }

pages="man1/petri.1 man5/petri.5 man3/petri.h.3 man3/petri-draw.h.3 man3/petri-edit.h.3 man3/petri-inspect.h.3 man3/petri-live.h.3 man3/petri-ranks.h.3"
for name in $("$prefix/bin/petri" help | sed -n 's/^  \([a-z]*\) .*/\1/p'); do
    pages="$pages man1/petri-$name.1"
done
check "each command has a page" [ "$(echo "$pages" | wc -w)" -ge 12 ]
# quiet_pages COMMAND...: succeeds if COMMAND prints no warning for any page, except that the date is missing.
quiet_pages() {
    for page in $pages; do
        "$@" "$share/man/$page" 2>&1 >/dev/null | grep -v -e 'missing date' || true
        [ -s "$share/man/$page" ] || echo "$page is missing"
    done >out
    empty out
}
lint() { mandoc -T lint -W warning "$1" >&2; }
formatted() { man --warnings -E UTF-8 -l -Tutf8 "$1"; }
if command -v mandoc >/dev/null; then
    check "mandoc reports nothing" quiet_pages lint
    # shows PAGE TEXT: succeeds if the formatted page contains TEXT.
    shows() { mandoc -T utf8 -O width=200 "$share/man/$1" | sed 's/.\x08//g' >out && has out "$2"; }
    check "the page of a command has its options" shows man1/petri-run.1 "--trajectory FILE"
    check "the page of a command has the help of options" shows man1/petri-run.1 "print and record every K-th frame"
    check "the page of a command has examples" shows man1/petri-run.1 "petri run dish.fl -D DROPS=50 --frames 100"
    check "the page of the prompt has its commands" shows man1/petri-repl.1 ".until EXPR"
    check "the page of the language has words" shows man5/petri.5 "%pragma tempo N"
    check "the page of the language has functions" shows man5/petri.5 "uniform(value=null)"
    check "the page of the language has nodes" shows man5/petri.5 "!electrostatic"
    check "the page of the language has attributes" shows man5/petri.5 "max_distance"
    for name in $(sed -n 's/^\(.*[ *]\)\{0,1\}\(petri_[a-z_]*\)(.*/\2/p' "$prefix/include/petri.h"); do
        grep -q "$(echo "$name" | sed 's/-/\\\\-/g')(" "$share/man/man3/petri.h.3" || echo "$name"
    done >out
    check "the page of the header has all functions" empty out
    check "the page of the header has its comments" shows man3/petri.h.3 "Only one thread at a time may use a session"
else
    without "the pages" mandoc
fi
if command -v man >/dev/null && command -v groff >/dev/null; then
    check "man gives no warning" quiet_pages formatted
else
    without "the pages with man" "man or groff"
fi

PATH="$prefix/bin:$PATH" # the completions call petri
bash_completion=$share/bash-completion/completions/petri
# completes WORD...: prints the completions of bash for the last word, on one line. As in bash, "=" is a word.
completes() {
    bash -c 'compopt() { :; }; . "$0" && COMP_WORDS=("$@") && COMP_CWORD=$(($# - 1)) COMP_LINE="$*" &&
        COMP_LINE=${COMP_LINE// = /=} && COMP_POINT=${#COMP_LINE} && _petri && echo "${COMPREPLY[*]}"' "$bash_completion" "$@"
}
echo 'let DROPS=DROPS or 5    -- 1..9: how many' >one.fl
cp one.fl 'a dish.fl'
touch two.txt three.petri
mkdir -p folder
if command -v bash >/dev/null; then
    check "bash completes commands" [ "$(completes petri re)" = "render repl" ]
    check "bash completes options" [ "$(completes petri run --traj)" = --trajectory ]
    check "bash completes only options of the command" [ -z "$(completes petri check --traj)" ]
    check "bash completes options of run after a script" [ "$(completes petri one.fl --traj)" = --trajectory ]
    check "bash completes option values" [ "$(completes petri run --neighbours n)" = never ]
    check "bash completes lists of values" [ "$(completes petri run --print tree,h)" = tree,hash ]
    check "bash completes values after an equals sign" [ "$(completes petri run --color = al)" = always ]
    check "bash completes values after an equals sign and a short word" [ "$(completes petri run --color = '')" = "auto always never" ]
    check "bash completes parameters of the script" [ "$(completes petri run one.fl -D DR)" = DROPS= ]
    check "bash completes nothing for the value of a parameter" [ -z "$(completes petri run one.fl -D DROPS = '')" ]
    check "bash completes folders" [ "$(completes petri run --allow-read fol)" = folder ]
    check "bash completes folders after an equals sign" [ "$(completes petri run --allow-read = fol)" = folder ]
    check "bash completes only folders where these are needed" [ -z "$(completes petri run --allow-read tw)" ]
    check "bash completes all files after options that take files" [ "$(completes petri run --state tw)" = two.txt ]
    check "bash completes scripts" [ "$(completes petri run on)" = one.fl ]
    check "bash completes archives" [ "$(completes petri archive verify th)" = three.petri ]
    check "bash completes names with blanks" [ "$(completes petri run 'a\ d')" = "a dish.fl" ]
    check "bash completes parameters of a script whose name has a blank" [ "$(completes petri run 'a\ dish.fl' -D DR)" = DROPS= ]
    check "bash completes no other files as scripts" [ -z "$(completes petri run tw)" ]
    check "bash completes topics of help" [ "$(completes petri help electro)" = electrostatic ]
else
    without "its completion" bash
fi
fish_completion=$share/fish/vendor_completions.d/petri.fish
complete_fish() { HOME=$work fish --no-config -c "source '$fish_completion'; complete -C '$1'" 2>&1; }
offers() { complete_fish "$1" | cut -f 1 | xargs; }
if command -v fish >/dev/null; then
    check "fish completes commands" [ "$(offers 'petri re')" = "render repl" ]
    check "fish completes options" [ "$(offers 'petri run --traj')" = --trajectory ]
    check "fish completes only options of the command" [ -z "$(offers 'petri check --traj')" ]
    check "fish completes option values" [ "$(offers 'petri run --neighbours n')" = never ]
    check "fish completes lists of values" [ "$(offers 'petri run --print tree,h')" = tree,hash ]
    check "fish completes values after an equals sign" [ "$(offers 'petri run --color=al')" = --color=always ]
    check "fish completes parameters of the script" [ "$(offers 'petri run one.fl -D DR')" = DROPS= ]
    check "fish completes scripts" [ "$(offers 'petri run on')" = one.fl ]
    check "fish completes folders" [ "$(offers 'petri run --allow-read=fol')" = --allow-read=folder/ ]
    check "fish completes files" [ "$(offers 'petri run --state tw')" = two.txt ]
    check "fish shows descriptions" [ "$(complete_fish 'petri re' | cut -f 2 | tail -n 1)" = "step through a script interactively" ]
    check "fish completes topics of help" [ "$(offers 'petri help electro')" = electrostatic ]
else
    without "its completion" fish
fi
if command -v zsh >/dev/null; then
    # Presses Tab in zsh on a pseudo-terminal, and prints the resulting lines.
    zsh -f "$here/complete.zsh" "$share/zsh/site-functions" >out 2>&1
    check "zsh completes" [ "$(xargs <out)" = \
        "petri render petri run --trajectory petri run --neighbours=never petri one.fl --trajectory petri help electrostatic petri run --print tree,hash petri run one.fl -D DROPS= petri run one.fl petri run --allow-read=folder/ petri run --state two.txt" ]
else
    without "its completion" zsh
fi

if command -v desktop-file-validate >/dev/null; then
    desktop-file-validate "$share/applications/petri.desktop" >out 2>&1
    check "the desktop file is valid" [ $? -eq 0 ]
else
    without "the desktop file" desktop-file-validate
fi
if command -v update-mime-database >/dev/null; then
    cp -r "$share/mime" mime
    update-mime-database mime >out 2>&1
    check "the type of scripts is known" has mime/globs text/x-flitter:*.fl
else
    without "the type of scripts" update-mime-database
fi
