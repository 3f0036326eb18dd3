# fmt.sh: the one layout of scripts. Part of run.sh.

# layout GIVEN WANTED WHAT: laid out, the one text becomes the other, which then stays as it is.
layout() {
    printf '%b' "$1" >given.fl
    printf '%b' "$2" >wanted.fl
    "$petri" fmt - <given.fl >out 2>err
    status=$?
    check "fmt: $3" cmp -s out wanted.fl
    "$petri" fmt --check wanted.fl 2>err
    status=$?
    check "… and it stays so" status_is 0
}

layout 'let a = 1\nlet b=2 +3\n' 'let a=1\nlet b=2 + 3\n' "no spaces around the = of a name, some in a sum"
layout 'let x=a  *b+ c*-d - -e\n' 'let x=a*b + c*-d - -e\n' "what binds more stands closer"
layout '!n x=a + b y=a+b*c z=f( a + b ,c )[ i - 1 ]\n' '!n x=a+b y=a + b*c z=f(a+b, c)[i-1]\n' \
    "a sum alone in an attribute or in brackets is close"
layout 'for i in 0 .. n - 1|2 , j in ..3\n  !a\n' 'for i in 0..n-1|2, j in ..3\n    !a\n' "ranges are close"
layout 'if a<b and not(c==d)\n\t!a\nelse\n\t!b\n' 'if a < b and not (c == d)\n    !a\nelse\n    !b\n' \
    "comparisons and words have spaces, levels four, for tabs, too"
layout '!a #t x = ( 1 ; 2 ) <<!b\n' '!a #t x=(1;2) << !b\n' "tags, vectors and appending"
layout 'let f = func (x)(x+1)\n!n a=f (2) b=$ :k c=- -1\n@ f x = 1\n' \
    'let f=func(x) (x+1)\n!n a=f(2) b=$:k c=- -1\n@f x=1\n' "calls, look-ups, signs, templates"
layout '%pragma   fps 20\n\n\n\n\n!a\n  !b\n\n\n  !c\n\n' '%pragma fps 20\n\n\n!a\n    !b\n\n    !c\n' \
    "two empty lines at the most, one in blocks, none at the end"
layout 'let A=1 -- one\n    LONG=22-- two\n-- alone   \n' 'let A=1      -- one\n    LONG=22  -- two\n-- alone\n' \
    "comments behind code stand in one column"
layout 'let A=1    -- one\n    B=2    -- two\n' 'let A=1    -- one\n    B=2    -- two\n' "… and stay in the one they have"
layout '!a\n  -- inside\n  !b\n  -- still inside\n-- outside\n!c\n' \
    '!a\n    -- inside\n    !b\n    -- still inside\n-- outside\n!c\n' "comments go with their block"
layout 'let A=(1;2;\n       3;4)\n  \nlet B = (1;\n 2\n )\n' 'let A=(1;2;\n       3;4)\n\nlet B=(1;\n    2\n)\n' \
    "lines in brackets are indented, unless they are aligned"
layout '!a x=1 \\\n  y=2\n!b\n' '!a x=1 \\\n    y=2\n!b\n' "a backslash goes on with a line"
layout 'let s="""a\n   b  """ t=1\n' 'let s="""a\n   b  """ t=1\n' "strings stay as they are"
layout '#!/usr/bin/env petri\n  !a\n' '#!/usr/bin/env petri\n!a\n' "what begins with #! stays"
layout '\357\273\277let a=1\r\n!n  b=a\r\n' 'let a=1\n!n b=a\n' "line ends become LF, a byte-order mark goes"
layout '' '' "nothing comes to nothing"

printf 'let a = 1\n!n  b=a\n' >loose.fl
printf 'let a=1\n!n b=a\n' >laid.fl
chmod 640 loose.fl
petri fmt --check loose.fl laid.fl
check "--check exits with 1 if something is to be laid out" status_is 1
check "… says what" has err "petri: loose.fl is not formatted"
check "… and what not" lacks err "laid.fl"
check "… and writes nothing" has loose.fl "let a = 1"
petri fmt loose.fl laid.fl
check "fmt lays files out" status_is 0
check "… which are then as they should be" cmp -s loose.fl laid.fl
check "… keeps their permissions" [ "$(stat -c %a loose.fl)" = 640 ]
check "… and counts them" last_line_is err "petri: 2 files: 1 formatted, 1 unchanged"
printf '!a x=  \n' >wrong.fl
cp wrong.fl before.fl
petri fmt wrong.fl
check "a script with an error is not laid out" one_error
check "… and left as it is" cmp -s wrong.fl before.fl
"$petri" fmt - <wrong.fl >out 2>err
status=$?
check "… of standard input it writes what it was given" cmp -s out before.fl
check "… with exit status 1" status_is 1
petri fmt gone.fl
check "a file that is not there is told" has err "cannot read gone.fl"
check "… with exit status 1" status_is 1
petri fmt --check "$root/samples"
check "all samples have the layout" status_is 0
grep -v '^#' "$root/tests/layouts.txt" | sed "s|^\\([^ ]*\\) .*|$root/\\1|" >listed
tr '\n' '\0' <listed | xargs -0 "$petri" fmt --check 2>&1 >/dev/null |
    sed -n 's/^petri: \(.*\) is not formatted$/\1/p; s/^\(.*\.fl\):[0-9:]* error: .*/\1/p' >unlike
check "what tests/layouts.txt lists has another (./dev format looks at the rest)" cmp -s listed unlike

# Every seventh script of the corpora, or all of them, indented by two, with more spaces.
mkdir corpus
find "$root/tests/golden" "$root/tests/conformance" -name '*.fl' | sort | awk -v step="${FMT_STEP:-7}" 'NR % step == 0' |
    while read -r script; do
        [ -e "${script%.fl}.err" ] ||
            sed -e 's/    /  /g' -e "/[\"']/!{s/ /  /g; s/[;,]/ & /g}" "$script" >"corpus/$(basename "$script")"
    done
petri fmt corpus
check "scripts of the corpora are laid out" grep -Eq 'petri: [0-9]{3,} files: [0-9]{2,} formatted' err
check "… each with the same code" lacks err "its compiled code would change"
petri fmt --check corpus
check "… and laid out again they stay as they are" grep -Eq ': 0 to format' err
