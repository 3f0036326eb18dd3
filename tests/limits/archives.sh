#!/bin/sh
# archives.sh PETRI: reads archives that are made to be hard to read (forge_archive.py). Each command must end within 15 s
# of processor time and 3 GiB of address space, with status 0 to 2, and must change no file but its own output.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
here=$(cd "$(dirname "$0")" && pwd)
scratch
limit=3145728
# The address sanitizer reserves terabytes of address space.
(ulimit -v $limit && "$petri" --version) >/dev/null 2>&1 || limit=unlimited
printf 'let N=N or 3\n!physics dimensions=2 state=:p\n    for i in ..N\n        !particle id=i position=i;0 velocity=1;0\n' >a.fl
if ! "$petri" run a.fl --frames 30 --archive base.petri 2>err || ! python3 -c 'import sqlite3' 2>/dev/null; then
    echo "skipped: petri was built without SQLite, or python3 is missing"
    exit 77
fi
cp base.petri whole.petri
python3 - <<'END'
import sqlite3
database = sqlite3.connect("base.petri")
database.execute("INSERT INTO input VALUES (NULL, 3, 'pointer', '0')")
database.execute("INSERT INTO note VALUES (NULL, 3, 'a note')")
database.commit()
END

# petri ARGUMENTS...: runs petri within the limits and sets `status`. The output is in the files out and err.
petri() {
    (ulimit -v $limit && ulimit -t 15 && exec timeout -s KILL 100 "$petri" "$@") >out 2>err </dev/null
    status=$?
}
# state: prints names, times and contents of the files with archives.
state() { (cd files && ls -lA --time-style=full-iso && sha256sum ./*) 2>&1; }
# forge KIND ARGUMENTS...: makes the archive files/it.petri.
forge() {
    rm -rf files
    mkdir files
    kind=$1
    shift
    python3 "$here/forge_archive.py" "$kind" $source files/it.petri "$@" || exit 1
    state >before
}
# each NAME WANTED: runs some commands that read archives. WANTED is a pattern of statuses. all NAME WANTED: runs all.
each() { commands "$@" 'archive info IT' 'archive unpack IT out.dir' 'run IT --print state --from 20'; }
all() {
    commands "$@" 'archive info IT' 'archive verify IT' 'archive cite IT' 'archive unpack IT out.dir' 'check IT' 'diff base.petri IT' 'run IT --from 20' 'repl IT' \
        'render IT --frame 1 -o picture.png' "sweep IT -D N=1;2 --frames 2 --metric x=time"
}
commands() {
    name=$1 wanted=$2
    shift 2
    for command; do
        rm -rf out.dir
        # shellcheck disable=SC2046,SC2086
        petri $(echo $command | sed 's|IT|files/it.petri|')
        check "$name: petri $command" eval "case \$status in $wanted) ;; *) false ;; esac"
    done
    state >after
    check "$name: no command changes the archive or its journal" cmp -s before after
}

source=base.petri
for table in sqlite_schema meta parameter file input input_frame digest keyframe note; do
    forge branches $table
    each "a tree of $table that shares pages" '0 | 1 | 2'
    petri archive verify files/it.petri
    check "verify finds the shared pages of $table" eval 'status_is 2 && [ -s err ]'
done
for column in 'meta 1' 'parameter 1' 'file 2' 'file 3' 'file 4' 'input 2' 'input 3' 'digest 1' 'keyframe 2' 'keyframe 3' \
    'keyframe 4' 'note 2'; do
    # shellcheck disable=SC2086
    forge chain $column
    each "a chain of pages in $column" '0 | 1 | 2'
    petri archive verify files/it.petri
    check "verify finds the chain in $column" eval 'status_is 2 && [ -s err ]'
done
for table in digest input keyframe file; do
    forge distant $table
    each "a distant row in $table" '0 | 1 | 2'
    petri archive verify files/it.petri
    check "verify finds the distant row in $table" eval 'status_is 2 && [ -s err ]'
done
forge wal
all "a write-ahead log" '1 | 2'
echo 'my thesis' >victim
forge journal victim
all "a journal of several databases" '1 | 2'
check "the super-journal is kept" grep -q 'my thesis' victim
echo '!counter state=:other rate=1' >b.fl
check "a forged journal names no script" eval '! has err b.fl'

# A recording that was killed while it wrote pages.
source=whole.petri
forge killed
all "a killed recording" 0
"$petri" archive info whole.petri >expected
petri archive info files/it.petri
check "the archive of a killed recording has its committed frames" cmp -s expected out
petri archive verify files/it.petri
check "the archive of a killed recording is verified" has out 'verified: 30 of 30 frames'
cp files/it.petri torn.petri
petri archive verify torn.petri
check "without its journal, it is damaged" status_is 2
petri run a.fl --frames 3 --archive files/it.petri
check "a killed recording can be replaced" eval 'status_is 0 && [ ! -e files/it.petri-journal ]'

# An archive is read while it is recorded.
"$petri" run a.fl --realtime --frames 240 --archive live.petri 2>live.err &
pid=$!
reads=0
while kill -0 $pid 2>/dev/null; do
    for command in 'archive info' 'archive verify' 'run --frames 9'; do
        # shellcheck disable=SC2086
        [ ! -s live.petri ] || petri $command live.petri
        reads=$((reads + 1))
        [ "${status:-0}" -eq 0 ] || grep -q 'being recorded\|has no frames\|not an archive' err || cat err >>odd
    done
done
wait $pid
check "a recording is not disturbed by $reads readers" [ $? -eq 0 ]
check "readers read a recording, or say that it is being recorded" [ ! -s odd ]
petri archive verify live.petri
check "the recording is complete" has out 'verified: 240 of 240 frames'
finish
