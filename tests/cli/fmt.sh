# fmt.sh: tests of `petri fmt`. Part of run.sh.

# layout GIVEN WANTED LABEL: checks that fmt turns GIVEN into WANTED and does not change WANTED.
layout() {
    printf '%b' "$1" >given.fl
    printf '%b' "$2" >wanted.fl
    "$petri" fmt - <given.fl >out 2>err
    status=$?
    check "fmt: $3" cmp -s out wanted.fl
    "$petri" fmt --check wanted.fl 2>err
    status=$?
    check "fmt does not change its own output: $3" status_is 0
}

layout 'let a = 1\nlet b=2 +3\n' 'let a=1\nlet b=2 + 3\n' "a = has no spaces around it, a sum has"
layout 'let x=a  *b+ c*-d - -e\n' 'let x=a*b + c*-d - -e\n' "operators of higher precedence have no spaces"
layout '!n x=a + b y=a+b*c z=f( a + b ,c )[ i - 1 ]\n' '!n x=a+b y=a + b*c z=f(a+b, c)[i-1]\n' \
    "a simple sum in an attribute or in brackets has no spaces"
layout 'for i in 0 .. n - 1|2 , j in ..3\n  !a\n' 'for i in 0..n-1|2, j in ..3\n    !a\n' "ranges have no spaces"
layout 'if a<b and not(c==d)\n\t!a\nelse\n\t!b\n' 'if a < b and not (c == d)\n    !a\nelse\n    !b\n' \
    "comparisons and keywords have spaces, tabs become four spaces"
layout '!a #t x = ( 1 ; 2 ) <<!b\n' '!a #t x=(1;2) << !b\n' "tags and vectors have no spaces, << has"
layout 'let f = func (x)(x+1)\n!n a=f (2) b=$ :k c=- -1\n@ f x = 1\n' \
    'let f=func(x) (x+1)\n!n a=f(2) b=$:k c=- -1\n@f x=1\n' "calls, look-ups, signs and templates have no spaces"
layout '%pragma   fps 20\n\n\n\n\n!a\n  !b\n\n\n  !c\n\n' '%pragma fps 20\n\n\n!a\n    !b\n\n    !c\n' \
    "at most two empty lines, one in blocks, none at the end"
layout 'let A=1 -- one\n    LONG=22-- two\n-- alone   \n' 'let A=1      -- one\n    LONG=22  -- two\n-- alone\n' \
    "comments after code are aligned"
layout 'let A=1    -- one\n    B=2    -- two\n' 'let A=1    -- one\n    B=2    -- two\n' "aligned comments after code keep their column"
layout '!a\n  -- inside\n  !b\n  -- still inside\n-- outside\n!c\n' \
    '!a\n    -- inside\n    !b\n    -- still inside\n-- outside\n!c\n' "comments are indented like their block"
layout 'let A=(1;2;\n       3;4)\n  \nlet B = (1;\n 2\n )\n' 'let A=(1;2;\n       3;4)\n\nlet B=(1;\n    2\n)\n' \
    "lines in brackets are indented, unless they are aligned"
layout '!a x=1 \\\n  y=2\n!b\n' '!a x=1 \\\n    y=2\n!b\n' "a line after a backslash is indented"
layout 'let s="""a\n   b  """ t=1\n' 'let s="""a\n   b  """ t=1\n' "strings do not change"
layout '#!/usr/bin/env petri\n  !a\n' '#!/usr/bin/env petri\n!a\n' "a #! line is kept"
layout '\357\273\277let a=1\r\n!n  b=a\r\n' 'let a=1\n!n b=a\n' "line ends become LF and a byte-order mark is removed"
layout '' '' "an empty script stays empty"

printf 'let a = 1\n!n  b=a\n' >loose.fl
printf 'let a=1\n!n b=a\n' >formatted.fl
chmod 640 loose.fl
petri fmt --check loose.fl formatted.fl
check "--check exits with 1 if a file is not formatted" status_is 1
check "--check names unformatted files" has err "petri: loose.fl is not formatted"
check "--check does not name formatted files" lacks err "formatted.fl"
check "--check does not modify files" has loose.fl "let a = 1"
petri fmt loose.fl formatted.fl
check "fmt formats files" status_is 0
check "fmt writes the standard format to the file" cmp -s loose.fl formatted.fl
check "fmt keeps permissions" [ "$(stat -c %a loose.fl)" = 640 ]
check "fmt counts formatted and unchanged files" last_line_is err "petri: 2 files: 1 formatted, 1 unchanged"
mkdir full
printf '!n  a = 1\n' | tee full/a.fl full/b.fl >full/before
printf '!n a=1\n' >full/c.fl
printf '!n a=(\n' >full/d.fl
(
    trap '' XFSZ
    ulimit -f 0 # files cannot grow, as on a full disk
    timeout 100 "$petri" fmt full 2>&1
    echo "status $?"
) | cat >out
check "fmt counts files that it could not write" has out "petri: 4 files: 0 formatted, 1 unchanged, 3 failed"
check "fmt fails if it could not write" last_line_is out "status 1"
check "a file that could not be written is whole" eval 'cmp -s full/a.fl full/before && cmp -s full/b.fl full/before'
printf '!a x=  \n' >wrong.fl
cp wrong.fl before.fl
petri fmt wrong.fl
check "fmt rejects a script with an error" one_error
check "fmt does not modify a script with an error" cmp -s wrong.fl before.fl
"$petri" fmt - <wrong.fl >out 2>err
status=$?
check "fmt copies standard input unchanged if it has an error" cmp -s out before.fl
check "an error in standard input exits with 1" status_is 1
petri fmt gone.fl
check "fmt reports a missing file" has err "cannot read gone.fl"
check "a missing file exits with 1" status_is 1
petri fmt --check "$root/samples"
check "all samples are formatted" status_is 0
grep -v '^#' "$root/tests/layouts.txt" | sed "s|^\\([^ ]*\\) .*|$root/\\1|" >listed
tr '\n' '\0' <listed | xargs -0 "$petri" fmt --check 2>&1 >/dev/null |
    sed -n 's/^petri: \(.*\) is not formatted$/\1/p; s/^\(.*\.fl\):[0-9:]* error: .*/\1/p' >unformatted
check "exactly the scripts in tests/layouts.txt are unformatted (./dev format checks all others)" cmp -s listed unformatted

# Every seventh script of the corpora (FMT_STEP=1: every script), reformatted with two spaces per level and more spaces
# between tokens.
mkdir corpus
find "$root/tests/golden" "$root/tests/conformance" -name '*.fl' | sort | awk -v step="${FMT_STEP:-7}" 'NR % step == 0' |
    while read -r script; do
        [ -e "${script%.fl}.err" ] ||
            sed -e 's/    /  /g' -e "/[\"']/!{s/ /  /g; s/[;,]/ & /g}" "$script" >"corpus/$(basename "$script")"
    done
petri fmt corpus
check "fmt formats scripts of the corpora" grep -Eq 'petri: [0-9]{3,} files: [0-9]{2,} formatted' err
check "formatted corpora have the same code" lacks err "its compiled code would change"
petri fmt --check corpus
check "formatted corpora need no more changes" grep -Eq ': 0 unformatted' err
