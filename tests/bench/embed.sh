#!/bin/sh
# embed.sh PETRI EMBED [PARTICLES FRAMES ROUNDS]: compares a host that reads all velocities after each frame with `petri
# run` of the same script. Prints the seconds of each round and the ratio of the minimum times, which must be below 1.02
# with 1000000 particles and 100 frames.
set -eu
petri=$1 embed=$2 particles=${3:-1000000} frames=${4:-100} rounds=${5:-5}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cat >"$scratch/gas.fl" <<END
%pragma fps 60
!physics state=:gas dimensions=2 time=time resolution=1/60
    for i in ..$particles
        !particle id=i position=i%1000;i//1000 velocity=sin(i);cos(i) radius=0.55
    !collision strength=100
    !drag strength=0.01
END
seconds() {
    from=$(date +%s%N)
    "$@" >"$scratch/out"
    awk "BEGIN { print ($(date +%s%N) - $from) / 1e9 }"
}
round=0
while [ $round -lt "$rounds" ]; do
    run=$(seconds "$petri" run "$scratch/gas.fl" --frames "$frames" --memory 8G --work 100G)
    host=$(seconds "$embed" "$scratch/gas.fl" "$frames")
    grep -q '^[0-9.]*[1-9]' "$scratch/out" || { echo "the host printed no speed" && exit 1; }
    echo "petri run $run s, host $host s"
    round=$((round + 1))
done | tee "$scratch/rounds"
awk '{ run = run == "" || $3 < run ? $3 : run; host = host == "" || $6 < host ? $6 : host }
    END { if (NR == 0) exit 1; printf "ratio %.4f\n", host / run }' "$scratch/rounds"
