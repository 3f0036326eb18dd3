# cache.sh: tests of `petri sweep --cache`. Part of run.sh.

mkdir cached
cat >cached/gas.fl <<'END'
let DROPS=DROPS or 20 SEED=SEED or 1
import scale from 'scale.fl'
let shift=read('shift.txt') more=read('more.txt')
!physics state=:drops dimensions=2
    for i in ..DROPS
        !particle id=i position=scale*normal(:start;SEED)[2*i;2*i+1]
    !gravity strength=50
    !collision strength=100
END
echo 'let scale=9' >cached/scale.fl
echo 5 >cached/shift.txt
# through ARGS...: runs six runs with a cache.
through() {
    sweep cached/gas.fl -D DROPS='10;20;30' --seeds 2 --frames 50 --every 20 --metric "$far" \
        --metric shift=shift --metric more=more --cache store --jobs 2 "$@"
}
counts() { has err "$1 runs computed, $2 from the cache, $3 verified"; }
through
cp out whole
check "runs that are not in the cache are computed" counts 6 0 0
check "each run is an entry of the cache" [ "$(find store -type f | wc -l)" -eq 6 ]
through
check "runs that are in the cache are not computed" counts 0 6 0
check "results from the cache are the same" same whole out
through --threads 2 --neighbours never --quiet
check "options that do not affect results do not affect keys" same whole out
check "--quiet hides the number of runs in the cache" [ ! -s err ]
sweep cached/gas.fl -D DROPS=20 --seeds 3 --frames 50 --every 20 --metric "$far" --metric shift=shift \
    --metric more=more --cache store
check "another sweep uses the runs that both have" counts 1 2 0
cp -R cached moved
(cd moved && "$petri" sweep gas.fl -D DROPS='10;20;30' --seeds 2 --frames 50 --every 20 --metric "$far" \
    --metric shift=shift --metric more=more --cache ../store >../out 2>../err)
check "a copy of the script in another folder uses the cache" counts 0 6 0
through --until 'frame > 40'
check "--until is part of the key" counts 6 0 0

# Each change must be noticed: changed NAME COMMAND...
changed() {
    check_name=$1
    shift
    "$@"
    through
    cp out before
    check "$check_name" counts 6 0 0
    through --cache other
    check "$check_name: the result is that of a new run" same before out
    rm -r other
    through
    check "$check_name: then the cache has the new result" counts 0 6 0
}
write() { echo "$2" >"cached/$1"; }
changed "a changed data file is noticed" write shift.txt 6
changed "a changed module is noticed" write scale.fl 'let scale=8'
changed "a file that did not exist is noticed" write more.txt 1
changed "a removed file is noticed" rm cached/more.txt
changed "a changed script is noticed" sed -i 's/strength=50/strength=51/' cached/gas.fl

# Damage: a byte is changed in each entry, and entries are truncated or empty.
through
cp out whole
damaged=0
for entry in $(find store -type f); do
    size=$(wc -c <"$entry")
    damaged=$((damaged + 1))
    case $((damaged % 3)) in
    0) : >"$entry" ;;
    1) head -c $((size / 2)) "$entry" >part && cp part "$entry" ;;
    *) { head -c $((size / 2)) "$entry" && printf '\001' && tail -c +$((size / 2 + 2)) "$entry"; } >part && cp part "$entry" ;;
    esac
done
through
check "damaged entries are computed again" counts 6 0 0
check "damaged entries are reported once" count_is err "the cache has a damaged result, which is computed again" 1
check "damaged entries do not change the table" same whole out
through
check "damaged entries are replaced" counts 0 6 0

# Verification. seal FILE: makes the checksum of an entry valid.
seal() {
    sed '$d' "$1" >part
    { cat part && echo "sha256 $(sha256sum <part | cut -d' ' -f1)"; } >"$1"
}
through --verify-cache 100%
check "--verify-cache computes runs again" counts 0 0 6
check "equal results are no failure" status_is 0
through --verify-cache 0
check "--verify-cache 0 computes nothing again" counts 0 6 0
rm -r store
through
# give_rows FROM TO: replaces the rows of an entry by those of another one of the same length, without its checksum.
give_rows() {
    rows=$(($(grep -a '^rows ' "$2" | cut -c 6-) + 1))
    { head -c $(($(wc -c <"$2") - rows - 72)) "$2" && tail -c $((rows + 72)) "$1"; } >part && cp part "$2"
}
entry=$(find store -type f | sort | sed -n 1p)
give_rows "$(find store -type f | sort | sed -n 2p)" "$entry"
seal "$entry"
through
check "an entry with a valid checksum is believed" counts 0 6 0
stored=$(diff whole out | sed -n '/^>/{s/^> //p;q}' | cut -d, -f5)
computed=$(diff whole out | sed -n '/^</{s/^< //p;q}' | cut -d, -f5)
through --verify-cache 100%
check "a wrong result is found" status_is 1
check "a wrong result is counted" has err "1 of 6 verified runs differ from their results in the cache"
check "the report names frame and metric" has err ": metric far"
check "the report has both values" eval 'has err "- $stored" && has err "+ $computed"'
check "the report has the command that finds the cause" has err 'petri diff cached/gas.fl -D DROPS='
check "the table has the computed result" same whole out
sed -i "s/^digest ./digest x/" "$entry"
seal "$entry"
through
check "an entry that is not well-formed is damaged" has err "the cache has a damaged result"
for byte in 1 10 19; do # the kinds of the frame and of two metrics
    rm -r store
    through
    entry=$(find store -type f | sort | sed -n 1p)
    rows=$(($(grep -a '^rows ' "$entry" | cut -c 6-) + 1))
    { head -c $(($(wc -c <"$entry") - rows - 73 + byte)) "$entry" && printf '\011' && tail -c $((rows + 72 + 1 - byte - 1)) "$entry"; } >part
    cp part "$entry"
    seal "$entry"
    through
    check "an entry whose rows are no cells is damaged: byte $byte" has err "the cache has a damaged result"
done

rm -r store
through
entry=$(find store -type f | sort | sed -n 1p)
grep -a -B 99 '^rows ' "$entry" | sed 's/^rows .*/rows 18446744073709551615\nsha256/' >part # there are no rows
cp part "$entry"
seal "$entry"
through
check "an entry with fewer rows than it says is damaged" has err "the cache has a damaged result"

# Runs without stored results.
cat >fails.fl <<'END'
let N=N or 1 BIG=sum(i*i for i in ..100000*N+0*frame)
END
sweep fails.fl -D 'N=1;100' --frames 2 --metric x=N --work 5M --cache failing
sweep fails.fl -D 'N=1;100' --frames 2 --metric x=N --work 5M --cache failing
check "failed runs are computed again" counts 1 1 0
echo "!counter state=:c rate=len(glob('*.fl')) time=time" >globs.fl
sweep globs.fl --frames 3 --metric 'x=$:c' --cache globbing
sweep globs.fl --frames 3 --metric 'x=$:c' --cache globbing
check "runs that search folders are computed again" counts 1 0 0

# Several processes.
rm -r store
for process in 1 2 3 4; do
    "$petri" sweep cached/gas.fl -D DROPS='10;20;30' --seeds 2 --frames 50 --every 20 --metric "$far" \
        --metric shift=shift --metric more=more --cache store --jobs 2 >out$process 2>err$process &
    eval "child$process=\$!"
done
# shellcheck disable=SC2154 # eval sets the variables
wait "$child1" "$child2" "$child3" "$child4"
check "processes that use the cache at the same time have the same tables" eval \
    'same whole out1 && same whole out2 && same whole out3 && same whole out4'
through
check "processes that use the cache at the same time leave valid entries" counts 0 6 0
check "no other files remain in the cache" [ "$(find store -type f | wc -l)" -eq 6 ]

: >file
sweep sum.fl -D A=1 --frames 1 --metric a=A --cache file
check "a cache that is a file fails" status_is 1
check "a cache that is a file is reported" has err "cannot use the cache 'file': it is not a folder"
refused "--verify-cache needs a cache" "needs a cache; add --cache DIR" sum.fl -D A=1 --metric a=A --verify-cache 1%
refused "an invalid percentage is rejected" "expects a percentage such as 1%" sum.fl -D A=1 --metric a=A --cache store --verify-cache 101%
refused "a percentage without a number is rejected" "expects a percentage such as 1%" sum.fl -D A=1 --metric a=A --cache store --verify-cache %

# A cache from someone else. Entries and folders can be links, pipes or endless files; entries can name such files. Nothing
# outside the cache is written, and no sweep waits or reads without bound: a file of 4 TiB cannot be read in the time that
# a test may take.
endless() { truncate -s 4T "$1" 2>/dev/null; }
small() { sweep small.fl -D 'N=1;2' --frames 3 --metric x='$:n' --cache foreign "$@"; }
entries() { find foreign -mindepth 2 "$@"; }
echo 'let N=N or 1 FILE=read("part.txt")
!counter state=:n rate=N' >small.fl
echo whole >part.txt
mkdir elsewhere
small
cp out expected
cp -R foreign original
# foreign NAME MESSAGE [COMPUTED]: runs the sweep, whose results are correct.
foreign() {
    small
    check "$1: the sweep ends" status_is 0
    check "$1: the table is correct" same out expected
    check "$1: the runs are computed" counts "${3:-2}" 0 0
    check "$1: the message gives the reason" has err "$2"
    rm -r foreign
    cp -R original foreign
}
echo 'my thesis' >victim.txt
cp victim.txt thesis.txt
for entry in $(entries -type f); do ln -sf "$PWD/victim.txt" "$entry"; done
foreign "entries that are links" "cannot write to the cache 'foreign': one of its entries is a symbolic link"
check "the target of a link is not written" same victim.txt thesis.txt
for entry in $(entries -type f); do ln -sf "$PWD/elsewhere/new.txt" "$entry"; done
foreign "entries that are dangling links" "one of its entries is a symbolic link"
check "the target of a dangling link is not made" [ -z "$(ls elsewhere)" ]
for folder in foreign/*; do rm -r "$folder" && ln -s "$PWD/elsewhere" "$folder"; done
foreign "folders that are links" "one of its folders is a file or a symbolic link"
for folder in foreign/*; do rm -r "$folder" && ln -s ../elsewhere/new "$folder"; done
foreign "folders that are dangling links" "one of its folders is a file or a symbolic link"
for folder in foreign/*; do rm -r "$folder" && : >"$folder"; done
foreign "folders that are files" "one of its folders is a file or a symbolic link"
check "nothing is written through a linked folder" [ -z "$(ls elsewhere)" ]
for entry in $(entries -type f); do rm "$entry" && mkfifo "$entry"; done
foreign "entries that are pipes" "one of its entries is not a regular file"
for entry in $(entries -type f); do rm "$entry" && mkdir "$entry"; done
foreign "entries that are folders" "one of its entries is not a regular file"
ln -s foreign linked-cache
small --cache linked-cache
check "the folder of the cache itself can be a link" counts 0 2 0
mkfifo pipe.txt
for entry in $(entries -type f); do
    sed -i 's/^file \([0-9a-f]*\) part.txt/file \1 pipe.txt/' "$entry"
    seal "$entry"
done
foreign "entries that name a pipe" "2 runs computed"
if endless huge.txt; then
    for entry in $(entries -type f); do truncate -s 4T "$entry"; done
    foreign "endless entries" "the cache has a damaged result"
    for entry in $(entries -type f); do
        sed -i 's/^file \([0-9a-f]*\) part.txt/file \1 huge.txt/' "$entry"
        seal "$entry"
    done
    foreign "entries that name an endless file" "2 runs computed"
    endless table.csv.part-x && mkfifo table.csv.part-y && ln -s huge.txt table.csv.part-z
    sweep small.fl -D 'N=1;2' --frames 3 --metric x='$:n' -o table.csv
    check "endless files and pipes beside the table are not read" status_is 0
    check "other files beside the table are kept" [ -e table.csv.part-x ]
    # Journals of this sweep that end in an endless file: its own, and that of another shard.
    shard() { sweep small.fl -D 'N=1;2;3' --frames 3 --metric x='$:n' -o cut.csv --shard "$1"; }
    shard 1/2
    endless cut.csv.part-1-of-2
    shard 1/2
    check "a journal with an endless end is resumed" [ "$(wc -c <cut.csv.part-1-of-2)" -lt 1000 ]
    endless cut.csv.part-1-of-2
    shard 2/2
    sweep small.fl -D 'N=1;2;3' --frames 3 --metric x='$:n' -o uncut.csv
    check "results before an endless end are used" same cut.csv uncut.csv
fi
mkfifo blocked.csv.part
sweep small.fl -D 'N=1;2' --frames 3 --metric x='$:n' -o blocked.csv
check "a pipe in the place of the journal fails" status_is 1
check "a pipe in the place of the journal is reported" has err "cannot write blocked.csv.part: it is not a regular file"
