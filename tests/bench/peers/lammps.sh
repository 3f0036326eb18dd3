#!/bin/sh
# lammps.sh: runs soft.lmp once with LAMMPS and prints its speed.
# usage: lammps.sh DIMENSIONS SIDE STEPS STYLE RANKS
#   STYLE: harmonic or hooke, see soft.lmp; table is used instead of harmonic if this LAMMPS has no harmonic/cut
# Prints: STYLE-USED PARTICLE-STEPS-PER-SECOND CPU-SHARE-OF-A-RANK-IN-PERCENT STEPS-PER-LIST. The time is what LAMMPS
# reports for its second run, without set-up and the first hundred steps.
# usage: lammps.sh version: prints the version of LAMMPS; without LAMMPS, prints a message and exits with 1.
set -eu
here=$(cd "$(dirname "$0")" && pwd)

fail() {
    echo "bench: $*" >&2
    exit 1
}

for command in lmp mpirun; do
    command -v $command >/dev/null || fail "LAMMPS is not installed ($command is missing; Debian packages lammps and" \
        "openmpi-bin); to install it, run: ./dev bench --peers"
done
if [ "${1:-}" = version ]; then
    lmp -h | awk '/Massively Parallel Simulator/ { sub(/.*Simulator *-? */, ""); print; exit }'
    exit 0
fi
[ $# -eq 5 ] || fail "usage: lammps.sh DIMENSIONS SIDE STEPS STYLE RANKS"
style=$4

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
cd "$work"

if [ "$style" = harmonic ] && ! lmp -h | tr -s ' \t' '\n' | grep -qx harmonic/cut; then
    style=table
    awk 'BEGIN {
        rows = 4000; low = 0.1; high = 1
        printf "SOFT\nN %d R %g %g\n\n", rows, low, high
        for (i = 0; i < rows; i++) {
            r = low + (high - low) * i / (rows - 1)
            printf "%d %.15g %.15g %.15g\n", i + 1, r, 500 * (1 - r) ^ 2, 1000 * (1 - r)
        }
    }' >soft.table
fi

# mpirun is needed only for several processes. Its options permit root, and more processes than processors.
run=lmp
[ "$5" -eq 1 ] || run="mpirun --oversubscribe -np $5 lmp"
export OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# shellcheck disable=SC2086 # the command is split into words
if ! $run -in "$here/soft.lmp" -log none -var dim "$1" -var side "$2" -var steps "$3" -var style "$style" >out 2>&1 \
    </dev/null; then
    tail -n 5 out >&2
    fail "LAMMPS failed"
fi
awk -v style="$style" '
    /^Loop time of/ { seconds = $4; steps = $9; particles = $12; loops++ }
    /% CPU use/ { share = $1 + 0 }
    /^Neighbor list builds/ { lists = $5 }
    END {
        if (loops != 2 || seconds <= 0) exit 1
        every = lists > 0 ? steps / lists : steps
        printf "%s %.6g %g %.3g\n", style, particles * steps / seconds, share, every
    }' out || {
    tail -n 5 out >&2
    fail "cannot read the time in LAMMPS' output"
}
