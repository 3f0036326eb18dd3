# link.sh: `petri link` and `petri open`, and that the page reads and writes the same links. Part of run.sh.

if "$petri" link --help | grep -q . && ! "$petri" open '#' 2>&1 | grep -q 'built without'; then

cat >count.fl <<'TEXT'
let N=N or 3
!counter state=:c rate=N
TEXT
# what page prints, of src/web/page/link.mjs: a frame and a change after another
page_link='#JcdBCsIwEEDRq4x_PUpDKcJAr5ALpFmUkOKipBBHEcS7i7h6vDdPLCiOsVeXOEc5uoxLO5Xj0bx2ufvqdbYi_WdcGkrDKJdtRylYSuegRJSJrCkM_1zJWdmwcVBuGC8-Xw'

petri link count.fl
check "a link is printed" status_is 0
check "… without an address, and nothing else" grep -Eq '^#[A-Za-z0-9_-]+$' out
petri open "$(cat out)"
check "it opens" status_is 0
check "… and has no frame to compare" has err "no state to compare"
petri link count.fl -D N=5 --frame 30 --page http://127.0.0.1:8080/
check "a link with an address, a parameter and a frame" grep -q '^http://127.0.0.1:8080/#' out
link=$(cat out)
petri run count.fl -D N=5 --frames 31 --every 30 --print hash
tail -n 1 out >hash
petri open "$link"
check "it shows that frame" status_is 0
check "… which has the hash that a run has" [ "$(tail -n 1 out)" = "$(cat hash)" ]
check "… and says that it is the same" has err "count.fl: frame 30: state matches the link exactly"
echo "$link" | timeout 100 "$petri" open - >out 2>err
check "it may come on standard input" has err "frame 30: state matches the link exactly"
petri open "$link" -o there.fl
check "the script is written" cmp -s count.fl there.fl
check "… with what else the link has" has err "the link also sets N=5"
petri open "$link" -o there.mp4
check "a film is no frame" status_is 2
petri open "$link" -o absent/there.fl
check "a file that cannot be written" status_is 1
petri open "$link" -o -
check "the script goes to standard output" cmp -s count.fl out

printf '!window size=40;30\n    !feedback mixer=0.6 translate=5;5\n        !canvas\n            !rect size=20;20 fill=true color=1\n' >back.fl
for frame in 1 8; do
    "$petri" link back.fl --frame $frame >link 2>/dev/null
    petri open "$(cat link)" -o back$frame.png
done
if [ -s back8.png ] && ! grep -Eq "OpenGL|without" err; then
    check "a picture has in it what frames before have left" eval '! cmp -s back1.png back8.png'
fi

petri open "$page_link"
check "a link of another state is told" status_is 1
check "… as that" has err "state differs from the link"
petri open "$page_link" -o there.fl
check "its script is there all the same" cmp -s count.fl there.fl
check "… and all changes are told" has err "N=5, N=7 after frame 10"

# Each with what is said of it: cut off, newer, none of petri's.
while read -r bad said; do
    petri open "$bad"
    check "a bad link, $bad" one_message "$said"
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
petri open '#q1YqU7Iy1FEqUbJSUkxUSLJNVtJRygNyYkoNDAyToo0Nc0EsyyS9tBygTLKSVXS0LlC9I5BjqBQbq6OUBtRfCwA'
check "nothing of a link is an order to the terminal" eval '! grep -q "[[:cntrl:]]" err && has err "?[31m?.fl:1:6"'
petri open "#$(repeat 25001 AAAA)"
check "a link that is too long" one_message "too long: 100004 characters, at most 100000"
petri open
check "no link is a wrong command line" status_is 2
check "… which tells of quotes" has err "needs quotes"

awk 'BEGIN { srand(1); for (i = 0; i < 30000; i++) printf "-- %d\n", rand() * 1e9 }' >long.fl
petri link long.fl
check "a script that is too long" one_message "the script is too long for a link"
petri link absent.fl
check "a script that is not there" status_is 1
echo 'let A=1' >module.fl
printf 'import A from "module.fl"\n!a b=A\n' >uses.fl
petri link uses.fl
check "a script with a module has no link" status_is 1
check "… and is told why" has err "cannot link a script that reads files: module.fl"
printf '!a b=read("module.fl")\n' >uses.fl
petri link uses.fl
check "nor has one that reads a file" has err "reads files: module.fl"
printf '!a b=)\n' >wrong.fl
petri link wrong.fl
check "a script that cannot be loaded has none" one_error
petri link count.fl -D N=x=
check "a definition that cannot be read" status_is 2

if command -v node >/dev/null; then
    cat >page.mjs <<TEXT
import { packLink, readLink } from "$root/src/web/page/link.mjs";
const linked = await readLink(process.argv[2]);
console.log(JSON.stringify(linked));
console.log(await packLink({ ...linked, text: linked.text + '-- é\n', changes: [...linked.changes, [3, 'N', '7']] }));
TEXT
    node page.mjs "${link#*8080/}" >told
    check "the page reads the link" has told '"name":"count.fl","changes":[[-1,"N","5"]]'
    check "… with text, frame and hash" has told "\"frame\":30,\"hash\":\"$(cut -c 3- hash)\""
    petri open "$(tail -n 1 told)" -o -
    check "petri reads that of the page" [ "$(tail -n 1 out)" = '-- é' ]
    check "… and makes its changes" has err "state differs from the link"
fi

fi
