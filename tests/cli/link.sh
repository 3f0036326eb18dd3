# link.sh: tests of `petri link` and `petri run LINK`, and of links from and to the playground. Part of run.sh.

if "$petri" link --help | grep -q . && ! "$petri" open '#' 2>&1 | grep -q 'built without'; then

cat >count.fl <<'TEXT'
let N=N or 3
!counter state=:c rate=N
TEXT
# A link of petri 0.2, written by src/web/page/link.mjs, with a frame and changes of a parameter.
page_link='#JcdBCsIwEEDRq4x_PUpDKcJAr5ALpFmUkOKipBBHEcS7i7h6vDdPLCiOsVeXOEc5uoxLO5Xj0bx2ufvqdbYi_WdcGkrDKJdtRylYSuegRJSJrCkM_1zJWdmwcVBuGC8-Xw'

petri link count.fl
check "link prints a link" status_is 0
check "the link is printed without a URL and nothing else is printed" grep -Eq '^#[A-Za-z0-9_-]+$' out
petri run "$(cat out)"
check "run accepts the link" status_is 0
check "a link without a frame has no state to compare" has err "no state to compare"
petri link count.fl -D N=5 --frame 30 --page http://127.0.0.1:8080/
check "a link contains a URL, a parameter and a frame" grep -q '^http://127.0.0.1:8080/#' out
link=$(cat out)
petri run count.fl -D N=5 --frames 31 --every 30 --print digest
tail -n 1 out >digest
petri run "$link"
check "run runs to the frame of the link" status_is 0
check "run prints the same digest as run" [ "$(tail -n 1 out)" = "$(cat digest)" ]
check "run reports that the state matches" has err "count.fl: frame 30: state matches the link exactly"
echo "$link" | timeout 100 "$petri" open - >out 2>err
check "open, the old name, reads a link from standard input" has err "frame 30: state matches the link exactly"
petri run "$link" -o there.fl
check "run writes the script" cmp -s count.fl there.fl
check "run reports the parameters of the link that are not in the script" has err "the link also sets N=5"
petri run "$link" -o there.mp4
check "run rejects a film as output" status_is 2
petri run "$link" -o absent/there.fl
check "run reports a file that cannot be written" status_is 1
petri run "$link" -o -
check "run writes the script to standard output" cmp -s count.fl out

printf '!window size=40;30\n    !feedback mixer=0.6 translate=5;5\n        !canvas\n            !rect size=20;20 fill=true color=1\n' >back.fl
for frame in 1 8; do
    "$petri" link back.fl --frame $frame >link 2>/dev/null
    petri render "$(cat link)" -o back$frame.png
done
if [ -s back8.png ] && ! grep -Eq "OpenGL|without" err; then
    check "the picture contains the feedback of earlier frames" eval '! cmp -s back1.png back8.png'
    sed 's/40;30/200;200/' back.fl >large.fl
    petri link large.fl --frame 200 --work 1M
    check "pictures on which later pictures depend are part of the work of a link" one_message "the link exceeded its limit"
fi

# Each frame uses about 300000 units of work, and the limit of the link is three times --work.
printf '!a v=len(i for i in ..300000+0*frame)\n!counter state=:c rate=1\n' >heavy.fl
petri link heavy.fl --frame 50
check "a link within its limit of work is made" status_is 0
heavy_link=$(cat out)
petri link heavy.fl --frame 50 --work 1M
check "link stops at the limit of work for the whole link" status_is 1
check "link reports the frame after which it stopped and the option that raises the limit" \
    one_message "heavy.fl: stopped after frame 9: the link exceeded its limit of 3145728 units of work; --work 1G or more would allow it"
petri run "$heavy_link" --work 1M
check "run stops at the limit of work for the whole link" one_message "stopped after frame 9: the link exceeded its limit"
petri run "$heavy_link"
check "run runs a link within its limit" has err "frame 50: state matches the link exactly"

petri run "$page_link"
check "a link with another state fails" status_is 1
check "run reports that the state differs" has err "state differs from the link"
petri run "$page_link" -o there.fl
check "run writes the script of a link with another state" cmp -s count.fl there.fl
check "run lists all changes of parameters in the link" has err "N=5, N=7 after frame 10"

# Bad links with a part of the message: truncated links, newer links, and links of other programs. `open`, the old
# name of `run LINK`, also accepts what does not look like a link.
while read -r bad reason; do
    petri open "$bad"
    check "a bad link is reported: $bad" one_message "$reason"
done <<'TEXT'
#q1YqU7Iy0lEqUbJSykktUfCz9VPIL1I check that it was copied completely
#q1YqU7Iy0lEqUbJSykktUfCz9VPIL1IwjslTTM4vzStJLVIoLkksSbW1SlYoAtF-MXlKtQA from a newer petri
#q1YqU7Iy1FGqULJSykktUfCz9VPIL1IwjslTTM4vzStJLVIoLkksSbW1SlYoAtF-MXlKtQA not a petri link
#q1YqU7Iy1FEqUbJSykktUfCz9VPIL1IwjslTTM4vzStJLVIoLkksSbW1SlYoAtF-MXlKOkppSlaGBjBQCwA not a petri link
#q1YqU7Iy1FEqUbJSykktUfCz9VPIL1IwjslTTM4vzStJLVIoLkksSbW1SlYoAtF-MXlKOkrJSlbR0Up-SjqGsbG1AA not a petri link
#q1YqU7Iy1FEqUbJSSowpNTAwMEhSqgUA not a petri link
#izaMBQA not a petri link
#q1YqU7Iy1FEqUbJSykktUfCz9VPIL1IwjslTTM4vzStJLVIoLkksSbW1SlYoAtF-MXlKtRUA not a petri link
http://127.0.0.1:8080/ check that it was copied completely
dish.fl check that it was copied completely
TEXT
# A name with escape sequences.
petri run '#q1YqU7Iy1FEqUbJSUkxUSLJNVtJRygNyYkoNDAyToo0Nc0EsyyS9tBygTLKSVXS0LlC9I5BjqBQbq6OUBtRfCwA'
check "a name with escape sequences is refused" one_message "not a petri link"
petri run "#$(repeat 25001 AAAA)"
check "a link that is too long is reported" one_message "too long: 100004 characters, at most 100000"
# Prints a link with this JSON.
pack() {
    printf '%s' "$1" | /usr/bin/python3 -I -c '
import base64, sys, zlib
packer = zlib.compressobj(9, zlib.DEFLATED, -15)
data = packer.compress(sys.stdin.buffer.read()) + packer.flush()
print("#" + base64.urlsafe_b64encode(data).decode().rstrip("="))'
}
if /usr/bin/python3 -I -c 'import zlib' 2>/dev/null; then
    petri run count.fl --frames 31 --every 30 --print hash
    tail -n 1 out >hash
    old_link=$(pack "{\"v\": 1, \"t\": \"let N=N or 3\\n!counter state=:c rate=N\\n\", \"f\": 30, \"h\": \"$(cut -c 3- hash)\"}")
    petri run "$old_link"
    check "a link of petri 0.2 is compared by its hash" has err "frame 30: state matches the link exactly"
    check "for a link of petri 0.2, open prints the hash" [ "$(tail -n 1 out)" = "$(cat hash)" ]
    petri run "$(pack '{"v": 1, "t": "!a\n", "n": "a.fl: frame 0: state matches the link exactly\nb.fl", "f": 0}')"
    check "a name with a line break is refused" one_message "not a petri link"
    petri run "$(pack "{\"v\": 1, \"t\": \"!a\\n\", \"c\": [$(repeat 10000 '[0,"N","1"],')[0,\"N\",\"1\"]]}")"
    check "a link with too many changes is refused" one_message "more than 10000 changes"
    # A search through all 10000 changes after each of the 1000000 frames would take 10^10 steps, and so exceed the
    # timeout.
    timeout 60 "$petri" run "$(pack "{\"v\": 1, \"t\": \"let N=N or 1\\n!a\\n\", \"f\": 1000000, \"h\": \"\", \"c\": [
        $(repeat 9999 '[0,"N","1"],')[0,\"N\",\"1\"]]}")" >out 2>err
    check "a link with many changes and frames ends" has err "frame 1000000: state differs from the link"
    petri run "$(pack '{"v": 1, "t": "let N=N or 1\n!counter state=:c rate=N\n", "f": 9, "c": [[5,"N","7"],[1,"N","3"]]}')"
    cp out unordered
    petri run "$(pack '{"v": 1, "t": "let N=N or 1\n!counter state=:c rate=N\n", "f": 9, "c": [[1,"N","3"],[5,"N","7"]]}')"
    check "changes are made in the order of frames" cmp -s out unordered
fi
petri open
check "no link is a wrong command line" status_is 2
check "a missing link is reported with a hint about quotes" eval \
    'grep -qx "petri: no link given (put it in quotes); usage: petri run LINK .options." err'

awk 'BEGIN { srand(1); for (i = 0; i < 30000; i++) printf "-- %d\n", rand() * 1e9 }' >long.fl
petri link long.fl
check "a script that is too long is reported" one_message "the script is too long for a link"
petri link absent.fl
check "link reports a missing script" status_is 1
echo 'let A=1' >module.fl
printf 'import A from "module.fl"\n!a b=A\n' >uses.fl
petri link uses.fl
check "a script with a module cannot be linked" status_is 1
check "link names the module that prevents a link" has err "cannot link a script that reads files: module.fl"
printf '!a b=read("module.fl")\n' >uses.fl
petri link uses.fl
check "link names the file that prevents a link" has err "reads files: module.fl"
printf '!a b=)\n' >wrong.fl
petri link wrong.fl
check "a script with an error cannot be linked" one_error
# The page of the playground, as `./dev web` makes it, is tested by tests/web/standalone.test.mjs.
echo '<b id="petri-data">null</b>' >empty.html
export PETRI_STANDALONE=empty.html
petri link count.fl --html page.html --frame 4
check "link --html fills the page" grep -Eq '^<b id="petri-data">\{"link": ?"#[A-Za-z0-9_-]+", ?"page": ?"http://127.0.0.1:8080/","files":\{\}\}</b>$' page.html
mkdir -p inside
printf 'let DATA=csv("a.csv", 0);csv("none.csv", 0)\n!x y=DATA\n' >inside/reads.fl
echo '<1>' >inside/a.csv
petri link inside/reads.fl --html page.html
check "link --html adds the files that the script reads" grep -q '"files":{"a.csv":"PDE-Cg"}}' page.html
printf 'let DATA=csv("../a.csv", 0)\n!x y=DATA\n' >inside/reads.fl
echo '<1>' >a.csv
petri link inside/reads.fl --html other.html
check "link --html refuses files outside the script's folder" has err "cannot add files outside the script's folder: ../a.csv"
ln -s ../a.csv inside/link.csv
printf 'let DATA=csv("link.csv", 0)\n!x y=DATA\n' >inside/reads.fl
petri link inside/reads.fl --html page.html
check "link --html does not follow symbolic links" grep -q '"files":{}}' page.html
echo hello >empty.html
petri link count.fl --html other.html
check "link --html rejects another file as the page" has err "cannot read 'empty.html': not a page of petri"
PETRI_STANDALONE=absent.html
petri link count.fl --html other.html
check "link --html names the missing page" one_message "standalone.html, is not installed"
check "link --html says where the page is for those who have no source tree" has err "page.tar.xz of the release"
check "link --html writes no page on failure" [ ! -e other.html ]
unset PETRI_STANDALONE
# A copy of the program, in a folder as in a build and as in an installation. A link to it must find the same page.
mkdir -p "a build/src" "a build/web" "an install/bin" "an install/share/petri"
echo '<i id="petri-data">null</i>' >"a build/web/standalone.html"
echo '<u id="petri-data">null</u>' >"an install/share/petri/standalone.html"
for place in "a build/src" "an install/bin"; do
    cp "$petri" "$place/petri"
    [ ! -e "$petri-pictures" ] || cp "$petri-pictures" "$place"
    ln -sf "$place/petri" linked_program
    for program in "$place/petri" ./linked_program; do
        rm -f page.html
        "$program" link count.fl --html page.html >out 2>err
        status=$?
        check "link --html finds the page beside $program of $place" grep -q '^<[iu] id="petri-data">{"link"' page.html
    done
    rm -f "$place"/petri*
done
petri link count.fl -D N=x=
check "link rejects an invalid definition" status_is 2

if command -v node >/dev/null; then
    cat >page.mjs <<TEXT
import { packLink, readLink } from "$root/src/web/page/link.mjs";
const linked = await readLink(process.argv[2]);
console.log(JSON.stringify(linked));
console.log(await packLink({ ...linked, text: linked.text + '-- é\n', changes: [...linked.changes, [3, 'N', '7']] }));
TEXT
    node page.mjs "${link#*8080/}" >page_output
    check "the playground reads links of petri" has page_output '"name":"count.fl","changes":[[-1,"N","5"]]'
    check "the playground reads text, frame and digest" has page_output "\"frame\":30,\"digest\":\"$(cut -c 3- digest)\",\"hash\":null"
    petri run "$(tail -n 1 page_output)" -o -
    check "petri reads links of the playground" [ "$(tail -n 1 out)" = '-- é' ]
    check "open applies the changes of parameters in a playground's link" has err "state differs from the link"
fi

fi
