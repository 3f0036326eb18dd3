# recordings.sh: tests of several recordings of one archive at the same time, which need locks of files. Part of run.sh.

cat >film.fl <<'END'
%pragma fps 25
!counter state=:size rate=2
END

if petri run film.fl --frames 3 --archive film.petri && status_is 0; then
    "$petri" run film.fl --realtime --frames 60 --archive busy.petri >first 2>&1 &
    pid=$!
    while [ ! -s busy.petri ] && kill -0 $pid; do
        sleep 0.05
    done
    petri run film.fl --frames 3 --archive busy.petri
    check "a second recording says who holds the archive" eval \
        'status_is 1 && has err "in use by another petri process" && { [ "$(uname)" != Linux ] || has err "($pid)"; }'
    wait $pid
    check "the first recording succeeds" [ $? -eq 0 ]
    petri archive verify busy.petri
    check "the first recording is complete" eval 'status_is 0 && has out "verified: 60 of 60 frames"'
    for round in new old; do
        for i in 1 2 3 4 5 6; do
            ("$petri" run film.fl --frames "$((100 * i))" --archive race.petri >/dev/null 2>&1 && echo "$((100 * i))" >>won) &
        done
        wait
        petri archive verify race.petri
        # Their lines in `won` can be in another order than their archives.
        check "of six recordings of a $round archive, one that is not refused is left, and is complete" eval \
            'status_is 0 && grep -qx "$(sed -n "s/^verified: \([0-9]*\) of \1 frames.*/\1/p" out)" won'
    done
fi
