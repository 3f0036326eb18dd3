# archive.sh: tests of archives: `petri run --archive`, `petri verify` and `petri info`. Part of run.sh.

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
    petri info run.petri
    check "info prints the script, its parameters, files and frames" eval \
        'status_is 0 && has out "script      dish.fl" && has out "parameter   N=7" && has out "file        mass.fl: 11 bytes" &&
        has out "frames      0 to 44" && has out "keyframes   6" && has out "digests     45"'
    check "info shows no absolute paths" eval '! has out "$work" && has out "command     petri run dish.fl -D N=7"'
    check "the archive contains no absolute paths" eval '! grep -q "$work" run.petri'
    digest=$(sed -n 's/^digest      //p' out)
    rm mass.fl dish.fl
    for threads in 1 2; do
        petri verify run.petri --threads "$threads"
        check "verify succeeds without the files, with $threads threads" eval \
            'status_is 0 && has out "verified: 45 of 45 frames, 5 of 5 segments" && has out "digest $digest" && empty err'
    done
    petri verify run.petri --sample 2
    check "verify checks a sample" eval 'status_is 0 && has out "of 45 frames, 2 of 5 segments"'


    printf 'import mass from "mass.fl"\n!counter state=:a rate=mass\n' >dish.fl
    echo 'let mass=3' >mass.fl
    petri run dish.fl --frames 25 --keyframe-every 10 --archive first.petri
    if command -v sqlite3 >/dev/null 2>&1; then
        cp first.petri forged.petri
        sqlite3 forged.petri "UPDATE digest SET digest = zeroblob(16) WHERE frame = 13"
        petri verify forged.petri
        check "verify reports damage with the table and row" eval \
            'status_is 2 && has err "damaged: table keyframe: row 19 has another SHA-256"'
    fi
    head -c 3000 first.petri >cut.petri
    petri verify cut.petri
    check "verify reports a truncated archive" eval 'status_is 2 && has err "the archive is damaged"'
    petri info dish.fl
    check "info rejects other files" eval 'status_is 2 && has err "it is not an archive"'
    petri verify missing.petri
    check "verify rejects missing files" status_is 2
    petri run dish.fl --frames 1 --archive mass.fl
    check "run does not overwrite other files" eval \
        'status_is 1 && has err "exists and is not an archive" && has mass.fl "let mass=3"'
    petri run dish.fl --frames 3 --archive first.petri
    check "run replaces an archive" status_is 0
    petri info first.petri
    check "the replaced archive has the new run" has out "frames      0 to 2"
    petri run dish.fl --frames 10 --digest-every 4 --archive sparse.petri
    petri info sparse.petri
    check "run keeps fewer digests" has out "digests     3"
    petri verify sparse.petri
    check "verify needs no digest of each frame" has out "verified: 10 of 10 frames"
    petri run dish.fl --frames 5 --state saved.txt
    petri run dish.fl --frames 5 --state saved.txt --archive later.petri
    petri info later.petri
    check "an archive can begin with a saved state" has out "frames      5 to 9"
    petri verify later.petri
    check "verify starts at the saved state" has out "verified: 5 of 5 frames"
else
    check "a build without SQLite says what is missing" has err "built without SQLite; on Debian, install libsqlite3-dev"
fi
