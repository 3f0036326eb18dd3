# archive.sh: tests of archives: `petri run --archive`, `petri archive verify` and `petri archive info`. Part of run.sh.

# reseal ARCHIVE: computes the SHA-256 sums of an archive again.
reseal() { python3 "$root/tests/support/reseal.py" "$1"; }

cat >dish.fl <<'END'
let N=N or 5 -- 1..9 number of drops
import mass from 'mass.fl'
!physics state=:p dimensions=2 time=time
    for i in ..N
        !particle id=i position=i;i*0.5 radius=1 mass=mass
    !collision
    !random strength=1
END
echo 'let mass=2' >mass.fl

if petri run dish.fl --frames 1 --archive run.petri && status_is 0; then
    petri run "$work/dish.fl" -D N=7 --frames 45 --keyframe-every 10 --archive run.petri
    check "run writes an archive without output" status_is 0
    check "the archive has the run's tables" [ "$(head -c 15 run.petri)" = "SQLite format 3" ]
    petri archive info run.petri
    check "info prints the script, its parameters, files and frames" eval \
        'status_is 0 && has out "script      dish.fl" && has out "parameter   N=7" && has out "file        mass.fl: 11 bytes" &&
        has out "frames      0 to 44" && has out "keyframes   6" && has out "digests     45"'
    check "info shows no absolute paths" eval '! has out "$work" && has out "command     petri run dish.fl -D N=7"'
    check "the archive contains no absolute paths" eval '! grep -q "$work" run.petri'
    digest=$(sed -n 's/^digest      //p' out)
    if command -v sqlite3 >/dev/null 2>&1; then
        reseal run.petri
        check "the digest of the run is the one that the README defines" [ "$(sqlite3 run.petri 'SELECT sha256 FROM keyframe ORDER BY frame DESC LIMIT 1')" = "$digest" ]
    fi
    rm mass.fl dish.fl
    for threads in 1 2; do
        petri archive verify run.petri --threads "$threads"
        check "verify succeeds without the files, with $threads threads" eval \
            'status_is 0 && has out "verified: 45 of 45 frames, 5 of 5 segments" && has out "digest $digest" && empty err'
    done
    # The commands of petri 0.2 still work.
    for action in verify info cite 'unpack run.petri old'; do
        set -- $action run.petri
        rm -rf old
        petri archive "$1" "${2:-run.petri}" ${3:+old}
        cp out expected
        rm -rf old
        petri "$1" "${2:-run.petri}" ${3:+old}
        check "the old command $1 does the same" eval 'status_is 0 && cmp -s out expected && empty err'
    done
    check "the old command unpack writes the files" [ "$(cd old && ls | tr '\n' ' ')" = "dish.fl mass.fl " ]
    rm -r old
    petri archive verify run.petri --sample 2
    check "verify checks a sample" eval 'status_is 0 && has out "of 45 frames, 2 of 5 segments"'


    printf 'import mass from "mass.fl"\n!counter state=:a rate=mass\n' >dish.fl
    echo 'let mass=3' >mass.fl
    petri run dish.fl --frames 25 --keyframe-every 10 --archive first.petri
    if command -v sqlite3 >/dev/null 2>&1; then
        cp first.petri strange.petri
        sqlite3 strange.petri "UPDATE meta SET value = 'a' || char(27, 10, 155) || 'b' WHERE key = 'command';
            UPDATE file SET name = 'c' || char(27) || 'd' WHERE name = 'mass.fl'"
        petri archive info strange.petri
        check "info prints no control characters" eval 'has out "command     a???b" && has out "file        c?d: 11 bytes"'
        petri archive unpack strange.petri strange
        check "unpack writes no names with control characters" eval 'has err "c?d" && [ "$(ls strange)" = dish.fl ]'
        cp first.petri forged.petri
        sqlite3 forged.petri "UPDATE digest SET digest = zeroblob(16) WHERE frame = 13"
        petri archive verify forged.petri
        check "verify reports damage with the table and row" eval \
            'status_is 2 && has err "damaged: table keyframe: row 19 has another SHA-256"'
    fi
    head -c 3000 first.petri >cut.petri
    petri archive verify cut.petri
    check "verify reports a truncated archive" eval 'status_is 2 && has err "the archive is damaged"'
    petri archive info dish.fl
    check "info rejects other files" eval 'status_is 2 && has err "it is not an archive"'
    petri archive verify missing.petri
    check "verify rejects missing files" eval \
        'status_is 2 && has err "No such file or directory"'
    petri run dish.fl --frames 1 --archive mass.fl
    check "run does not overwrite other files" eval \
        'status_is 1 && has err "exists and is not an archive" && has mass.fl "let mass=3"'
    petri run dish.fl --frames 3 --archive first.petri
    check "run replaces an archive" status_is 0
    petri archive info first.petri
    check "the replaced archive has the new run" has out "frames      0 to 2"
    petri run dish.fl --frames 10 --digest-every 4 --archive sparse.petri
    petri archive info sparse.petri
    check "run keeps fewer digests" has out "digests     3"
    petri archive verify sparse.petri
    check "verify needs no digest of each frame" has out "verified: 10 of 10 frames"
    petri run dish.fl --frames 5 --state saved.txt
    petri run dish.fl --frames 5 --state saved.txt --archive later.petri
    petri archive info later.petri
    check "an archive can begin with a saved state" has out "frames      5 to 9"
    petri archive verify later.petri
    check "verify starts at the saved state" has out "verified: 5 of 5 frames"

    # Archives instead of scripts
    cat >film.fl <<'END'
%pragma fps 25
let R=R or 4
!window size=40;30
    !canvas
        !path
            !circle point=20;15 radius=R+$:size
            !fill
!counter state=:size rate=2
END
    petri run film.fl -D R=6 --frames 40 --keyframe-every 7 --archive film.petri
    petri run film.fl -D R=6 --frames 40 --print state,digest --every 3
    cp out expected
    petri run film.petri --print state,digest --every 3
    check "run replays an archive with its recorded frames" eval 'status_is 0 && cmp -s out expected'
    petri run film.fl -D R=6 --frames 34 --print digest --every 33
    tail -n 2 out >expected
    petri run film.petri --from 33 --frames 1 --print digest
    check "--from starts at any frame" eval 'status_is 0 && cmp -s out expected'
    petri run film.petri --from 38 --frames 10 --print digest
    check "the run continues after the recorded frames" [ "$(grep -c = out)" -ge 10 ]
    petri run film.petri -D R=5
    check "-D cannot change an archive" eval 'status_is 2 && has err "with an archive"'
    petri run film.fl --from 3
    check "--from needs an archive" eval 'status_is 2 && has err "needs an archive"'
    if petri render film.fl -D R=6 --frame 30 -o script.png && status_is 0; then
        rm -f replay.png
        petri render film.petri --frame 30 -o replay.png
        check "render draws a frame of an archive" eval 'status_is 0 && cmp -s script.png replay.png'
    fi
    echo '$:size' | timeout 60 "$petri" repl film.petri --from 10 >out 2>err
    check "the prompt continues an archive" grep -q '^@9> 0.72$\|0.72' out
    printf '%s\n' '.step 3' '.archive prompt.petri' '.step' 'let k=2' '!counter state=:q rate=k' '.step 20' '.set R 3' \
        '.step 4' '.tempo 90' '.step 3' | timeout 60 "$petri" repl film.fl >out 2>err
    check "the prompt writes an archive" has out "all later frames are written to prompt.petri"
    petri archive verify prompt.petri
    check "the frames of the prompt with their changes are verified" eval \
        'status_is 0 && has out "verified: 28 of 28 frames"'
    petri run prompt.petri --from 30 --frames 1 --print state
    check "the replay has the statements of the prompt" has out '$:q = '
    printf '%s\n' '.archive back.petri' '.step 30' '.back 12' '.step 5' | timeout 60 "$petri" repl film.fl >out 2>err
    petri archive info back.petri
    check "frames that were undone are not in the archive" has out "frames      0 to 22"
    petri archive verify back.petri
    check "verify counts states that were given" eval 'status_is 0 && has out "states that were given, not computed: 1"'

    # A picture that only drawing reads
    printf '!window size=20;20\n    !canvas\n        !image filename="dot.png" point=0;0 size=20;20\n!counter state=:a rate=1\n' >image.fl
    if petri render film.fl --frame 3 --size 20x20 -o dot.png && status_is 0; then
        petri run image.fl --frames 3 --archive image.petri
        petri render image.fl --frame 2 -o script.png
        rm dot.png
        petri render image.petri --frame 2 -o replay.png
        check "an archive has images that only drawing reads" eval 'status_is 0 && cmp -s script.png replay.png && empty err'
    fi
    petri check film.petri film.fl
    check "check accepts an archive" eval 'status_is 0 && has err "2 files checked: 0 errors"'
    if command -v sqlite3 >/dev/null 2>&1; then
        # A forged archive, whose digests and seals fit a script that is not its own.
        mkdir other
        sed 's/rate=2/rate=3/' film.fl >other/film.fl
        petri run other/film.fl -D R=6 --frames 40 --keyframe-every 7 --archive forged.petri
        sqlite3 forged.petri "ATTACH 'film.petri' AS own; UPDATE file SET bytes = (SELECT bytes FROM own.file), sha256 = (SELECT sha256 FROM own.file)"
        reseal forged.petri
        petri archive verify forged.petri
        check "verify finds the first frame of a forged archive, and what differs" eval \
            'status_is 1 && has out "frame 1 differs" && has out "- digest" && has out "--- archive" && has out "first: \$:size"'
        check "verify says how to compare the forces" has out "'petri diff forged.petri --with PROGRAM'"
    fi
    petri diff film.petri film.fl
    check "diff compares an archive with a script" eval 'status_is 0 && empty out'
    petri run film.fl --frames 20 --archive other.petri
    sed 's/rate=2/rate=3/' film.fl >changed.fl
    petri diff film.petri changed.fl
    check "diff finds the first frame that differs from an archive" eval 'status_is 1 && has out "frame 1, time 0.04"'
    # The petri that wrote an archive, which computes a force that differs by one ulp.
    printf '!physics state=:p dimensions=2 time=time\n    for i in ..5\n        !particle id=i position=i;i*0.5 velocity=0.3;0.7 radius=1\n    !collision\n    !drag strength=1.5\n' >moving.fl
    sed 's/1\.5$/1.5000000000000002/' moving.fl >author.fl
    petri run moving.fl --frames 9 --archive moving.petri
    # shellcheck disable=SC2016
    printf '#!/bin/sh\nfor word; do\n    shift\n    [ "$word" = moving.petri ] && word=author.fl\n    set -- "$@" "$word"\ndone\nexec "%s" "$@"\n' "$petri" >author
    chmod +x author
    petri diff moving.petri --with ./author
    check "diff names the force that differs from that of the program that wrote an archive" eval \
        'status_is 1 && grep -q "^force on :p;.*: drag$" out && has out "  moving.fl:5" && has out "  author.fl:5"'
    petri archive cite film.petri
    check "cite prints the digest, BibTeX and CITATION.cff" eval \
        'status_is 0 && has out "digest: " && has out "@misc{petri-" && has out "cff-version: 1.2.0"'
    petri archive unpack first.petri unpacked
    check "unpack writes the files" eval 'status_is 0 && cmp -s mass.fl unpacked/mass.fl && cmp -s dish.fl unpacked/dish.fl'
    petri archive unpack first.petri unpacked
    check "unpack does not overwrite files" eval 'status_is 1 && has err "File exists"'
    if command -v sqlite3 >/dev/null 2>&1; then
        for name in /tmp/evil.fl ../evil.fl a/../../evil.fl link/evil.fl; do
            cp first.petri evil.petri
            rm -rf evil
            mkdir evil outside 2>/dev/null
            ln -sfn ../outside evil/link
            sqlite3 evil.petri "UPDATE file SET name = '$name' WHERE name = 'mass.fl'"
            petri archive unpack evil.petri evil
            check "unpack writes nothing outside its folder: $name" eval '[ ! -e evil.fl ] && [ ! -e outside/evil.fl ] && [ ! -e /tmp/evil.fl ]'
        done
    fi

    # Names that are not those of new files or of archives
    mkdir names
    mkfifo names/pipe
    ln -s ../film.petri names/link
    ln -s missing.petri names/dangling
    echo text >names/mine.petri-journal
    echo text >names/other.petri-wal
    find names | sort >before
    for name in '' - : :memory: names/ names names/pipe names/link names/dangling names/mine.petri names/other.petri; do
        cp film.petri kept
        timeout -s KILL 60 "$petri" run film.fl --frames 3 --archive "$name" >out 2>err
        status=$?
        check "no archive is written to '$name'" eval 'status_is 1 && has err "cannot write the archive" && empty out'
    done
    find names | sort >after
    check "refused archives write no files" eval 'cmp -s before after && cmp -s film.petri kept && [ ! -e - ] && [ ! -e :memory: ]'
    # shellcheck disable=SC2016
    device='mount -t tmpfs none names && mknod names/null c 1 3 && "$1" run film.fl --frames 3 --archive names/null; [ -c names/null ]'
    if unshare -m true 2>/dev/null; then
        unshare -m sh -c "$device" - "$petri" >out 2>err
        status=$?
        check "devices are not removed" eval 'status_is 0 && has err "not a regular file"'
    fi
    : >empty.petri
    chmod 600 empty.petri
    petri run film.fl --frames 3 --archive empty.petri
    check "an empty file becomes an archive with its permissions" eval 'status_is 0 && ls -l empty.petri | grep -q ^-rw-------'
    ln film.petri hard.petri
    petri run film.fl --frames 3 --archive file:hard.petri
    check "a name with a colon is that of a file" eval 'status_is 0 && [ -e file:hard.petri ]'
    petri run film.fl --frames 3 --archive hard.petri
    check "another name of a replaced archive keeps its contents" eval 'status_is 0 && cmp -s film.petri kept'

    if command -v sqlite3 >/dev/null 2>&1; then
        # hidden names, and names that would forge lines or reverse letters in messages
        for name in "'.bashrc'" "'.git/hooks/x'" "'a/.b/c'" "'x' || char(10) || 'petri: forged' || char(8238) || 'lf.exe'"; do
            cp first.petri evil.petri
            rm -rf evil
            sqlite3 evil.petri "UPDATE file SET name = $name WHERE name = 'mass.fl'"
            petri archive unpack evil.petri evil
            check "unpack skips the name $name" eval 'status_is 0 && lines_are err 1 && has err "skipped " && [ "$(ls -A evil)" = dish.fl ]'
        done
        check "unsafe characters are shown as ?" has err "skipped 'x?petri: forged?lf.exe'"
    fi

    # Killed runs: at most one second of frames is lost.
    for delay in 0.3 0.9 1.4 2.1; do
        rm -f killed.petri
        "$petri" run film.fl --realtime --frames 1000 --print digest --archive killed.petri >out 2>err &
        pid=$!
        sleep "$delay"
        kill -9 $pid
        wait $pid 2>/dev/null
        computed=$(grep -c '^=' out)
        petri archive verify killed.petri
        kept=$(sed -n 's/^verified: \([0-9]*\) of.*/\1/p' out)
        check "after kill -9 at $delay s, at most a second is lost" eval \
            '[ "$computed" -le 27 ] || { status_is 0 && [ $((computed - kept)) -le 26 ]; }'
    done
    # A limit of the file size has the effect of a full disk.
    petri run film.fl --frames 3000 --print digest --every 2999
    cp out expected
    (
        ulimit -f 150
        petri run film.fl --frames 3000 --keyframe-every 100 --print digest --every 2999 --archive full.petri
        exit $status
    )
    status=$?
    check "a full disk ends the archive, not the run" eval \
        'status_is 1 && cmp -s out expected && has err "ends here: "'
    petri archive verify full.petri
    check "the frames before the disk was full can be verified, or none was written" eval \
        'status_is 0 || has err "it has no frames"'
else
    check "a build without SQLite says what is missing" has err "built without SQLite; on Debian, install libsqlite3-dev"
fi
