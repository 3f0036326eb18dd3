# golden_causes.sh: tests of what `petri test` says about output that differs. Part of run.sh.

# whole differences
mkdir -p long
printf 'for i in ..60\n    !n i=i a=(i*A)\n' >long/many.fl
petri test --new long/many.fl --frames 1 --print tree -D A=2
sed -i '1s/A=2/A=3/' long/many.golden
petri test long/many.fl
check "a long difference is shortened" [ "$(grep -c '^    [-+]!n' out)" -eq 38 ]
check "the number of lines that are left out is exact" has out "    ... 80 more lines differ"
printf 'let N=3\nfor i in ..N\n    !n a=i\n' >long/grow.fl
petri test --new long/grow.fl --frames 2 --print tree
sed -i 's/N=3/N=4/' long/grow.fl
petri test long/grow.fl
check "a line that is only in the output is shown in its place" [ "$(sed -n '5,$p' out | sed 's/^    //' | head -n 10)" = \
    "@@ -3,7 +3,9 @@ frame 0
 !n a=0
 !n a=1
 !n a=2
+!n a=3
 @1 time=0.016666666666666666 beat=0.03333333333333333
 !n a=0
 !n a=1
 !n a=2
+!n a=3" ]
petri test long/grow.fl --color always
check "--color always colours the difference" has out "$(printf '\033[32m+!n a=3\033[0m')"
petri test long/grow.fl --color never
check "--color never does not" lacks out "$(printf '\033')"
sed -i '1s/--frames 2/--frames 3/' long/grow.golden
petri test long/grow.fl
check "a frame that is not in the golden is in the difference" has out "    +@2 time="
# The unified difference of a golden, applied by patch, gives what --update writes.
if command -v patch >/dev/null; then
    cp long/grow.golden patched
    sed -n 's/^    \([-+@ ].*\)/\1/p' out >difference
    patch -s patched <difference
    petri test --update long/grow.fl
    check "a shown difference can be applied as a patch" cmp -s patched long/grow.golden
fi

# The cause: the script is compared with the one in git.
command -v git >/dev/null || { echo "skipped: no git"; return 0; }
commit() { git -C history -c user.name=n -c user.email=e commit -q -m "$1"; }
mkdir -p history/below
git -C history init -q
cat >history/below/fall.fl <<'END'
import G from "weight.fl"
!physics state=:fall dimensions=1
    !particle id=:ball position=100
    !constant acceleration=-G
END
echo 'let G=10' >history/below/weight.fl
cp history/below/fall.fl history/below/hash.fl
petri test --new history/below/fall.fl --frames 21 --every 10 --print state
petri test --new history/below/hash.fl --frames 21 --every 10 --print hash -D unused=1
git -C history add .
commit first
sed -i 's/position=100/position=100\n    !particle id=:other position=0/' history/below/fall.fl
petri test history/below/fall.fl
check "a particle that was added is found" has out "    first: \$(:fall;:other)"
git -C history checkout -q .
sed -i 's/=-G/=-2*G/' history/below/fall.fl
petri test history/below/fall.fl
check "the cause is named with force and line" has out "    force on :fall;:ball, step 1 of 1: constant
    - -10  fall.fl:4
    + -20  fall.fl:4"
check "the cause is found in the first frame that differs, although the golden does not have it" has out \
    "    frame 1, time 0.016666666666666666: "
check "a failure says how to accept the output" has out "    to accept: $petri test --update history/below/fall.golden"
git -C history add .
commit "changed without its golden"
petri test history/below/fall.fl
revision=$(git -C history log -1 --format=%h -- below/fall.golden)
check "if the script was committed, its revision with the golden is used" has out "    --- $revision:fall.fl"
check "the cause is found in older revisions" has out "    + -20  fall.fl:4"
echo 'let G=11' >history/below/weight.fl
petri test history/below/hash.fl
check "a golden of hashes has a cause, also in a module" has out "    - -10  hash.fl:4
    + -11  hash.fl:4"
petri diff HEAD:history/below/hash.fl history/below/hash.fl --frames 3 -D unused=1
check "diff reads a script and its modules from git" status_is 1
check "diff shows the revision" has out "--- HEAD:history/below/hash.fl"
petri diff HEAD:history/below/none.fl history/below/hash.fl
check "a script that git does not have is an error" status_is 2
check "the reason of git is shown" has err "cannot read HEAD:history/below/none.fl from git: "
petri diff -- -p:history/below/hash.fl history/below/hash.fl
check "a revision is never an option of git" status_is 2
mv history/below/hash.fl 'history/below/a:b $(x).fl'
mv history/below/hash.golden 'history/below/a:b $(x).golden'
git -C history add .
commit "strange name"
sed -i 's/=-G/=-3*G/' 'history/below/a:b $(x).fl'
petri test 'history/below/a:b $(x).fl'
check "names are never read by a shell" has out "    + -33  a:b \$(x).fl:4"

# a stranger's repository: a signed commit and an object that is missing, and programs for both in the configuration
printf '#!/bin/sh\ntouch "%s/started"\n' "$PWD" >starter
chmod +x starter
git -C history cat-file commit HEAD | awk 'NF == 0 && !done {
    print "gpgsig -----BEGIN PGP SIGNATURE-----\n \n x\n -----END PGP SIGNATURE-----"
    done = 1
}
{ print }' >signed
git -C history update-ref HEAD "$(git -C history hash-object -t commit -w "$PWD/signed")"
missing=$(git -C history rev-parse HEAD:below/fall.fl)
rm -f "history/.git/objects/$(printf '%.2s' "$missing")/${missing#??}"
for line in 'log.showSignature true' "gpg.program $PWD/starter" 'core.repositoryformatversion 1' 'extensions.partialClone far' \
    'remote.far.promisor true' "remote.far.url $PWD/history" "remote.far.uploadpack $PWD/starter"; do
    git -C history config "${line%% *}" "${line#* }"
done
echo >>history/below/fall.golden
petri test history/below/fall.fl
petri diff HEAD:history/below/fall.fl history/below/fall.fl
check "what git lacks is an error" has err "cannot read HEAD:history/below/fall.fl from git: "
check "git starts no program that the configuration of a repository names" [ ! -e started ]
git -C history cat-file blob "$missing" >out 2>&1
check "git alone would start it" [ -e started ]
rm -rf history/.git
petri test history/below/fall.fl
check "without git, a failure has no cause but is shown whole" has out "+\$(:fall;:ball) = "
check "without git, there is no message about git" lacks out "git"
