#!/bin/sh
# ranks.sh: measures the speed-up by MPI ranks and their communication. `./dev bench --ranks` runs it.
# usage: ranks.sh PATH-OF-PETRI [ROUNDS [SIDE]]
#   ROUNDS: rounds of the timing (default: 3); SIDE: discs along an edge (default: 1000)
#
# 1. Timing: two ranks with one thread and one rank with two threads take turns. Figures are medians over the rounds. The
#    first three frames of a run are not included.
# 2. Communication of soft discs: three sizes on four ranks, and one size on up to 16 ranks (more ranks than processors).
# 3. A model of both, for N particles on R ranks. A step takes N c / R for computing, where c is STEP_NS. For communication,
#    it takes 2 log2 R latencies per reduction, one latency per message, and the time to send the bytes of the halo. A
#    frame also takes N f for work that each rank does for all particles, where f is FRAME_NS, and the time to send 36 N
#    bytes. STEP_NS and FRAME_NS are nanoseconds per particle; they are measured if not given. LATENCY (microseconds) and
#    BANDWIDTH (GB/s) are lists with one number for each modelled network (default: two networks).
set -eu
petri=$1 rounds=${2:-3} side=${3:-1000}
workloads=$(cd "$(dirname "$0")" && pwd)/workloads
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_plm=isolated
export OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM OMPI_MCA_rmaps_base_oversubscribe OMPI_MCA_plm

discs() { # SIDE
    sed "s/SIDE=1000/SIDE=$1/" "$workloads/soft2d_n1000000.fl" >"$work/soft$1.fl"
    echo "$work/soft$1.fl"
}

# milliseconds COMMAND...: prints the milliseconds per frame, without the time for writing output.
milliseconds() {
    "$@" --stats 2>&1 | awk '/^  (evaluation|physics) /{ sum += $2 } END { print sum }'
}

median() {
    sort -n | awk '{ v[NR] = $1 } END { print (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'
}

# steady FRAMES COMMAND...: prints the mean milliseconds per frame of FRAMES frames. They follow the first three frames,
# which are slower and not included.
steady() {
    frames=$1
    shift
    start=$(milliseconds "$@" --frames 3)
    milliseconds "$@" --frames "$((frames + 3))" |
        awk -v start="$start" -v n="$frames" '{ print ($1 * (n + 3) - start * 3) / n }'
}

# compare NAME FRAMES SCRIPT OPTIONS...: times two threads and two ranks and prints a row.
compare() {
    name=$1 frames=$2
    shift 2
    : >"$work/one"
    : >"$work/two"
    for _ in $(seq "$rounds"); do
        steady "$frames" "$petri" run "$@" --threads 2 >>"$work/one"
        steady "$frames" mpirun -n 2 "$petri" run "$@" --threads 1 >>"$work/two"
    done
    one=$(median <"$work/one") two=$(median <"$work/two")
    awk -v name="$name" -v one="$one" -v two="$two" \
        'BEGIN { printf "%-32s %10.2f %10.2f %8.2f\n", name, one, two, one / two }'
}

echo "milliseconds per frame            2 threads    2 ranks    ratio"
soft=$(discs "$side")
compare "soft discs $((side * side)) x10" 20 "$soft" --fps 5
compare "gravity 4000" 120 "$workloads/gravity_n4000.fl"

# traffic SIDE RANKS: prints owned particles, halo particles, bytes and messages per step, reductions per step, and bytes
# per frame; each is the maximum over the ranks.
traffic() {
    PETRI_NO_SHARED_MEMORY=1 mpirun -n "$2" "$petri" run "$(discs "$1")" --fps 5 --frames 4 --stats 2>&1 | tr -d , | awk '
        $1 == "particles" { own = $4; halo = $11 }
        $1 == "sent" { bytes = $7; messages = $10; frame = $14 }
        $1 == "reductions" { reductions = $2 }
        END { print own, halo, bytes, messages, reductions, frame }'
}

echo
echo "maximum per rank               particles       halo    bytes/step  of halo  messages reductions    bytes/frame"
for size in "$((side / 10)) 4" "$((side * 10 / 32)) 4" "$side 4" "$((side * 10 / 32)) 2" "$((side * 10 / 32)) 8" "$((side * 10 / 32)) 16"; do
    # shellcheck disable=SC2086 # two numbers
    traffic $size >"$work/row"
    # shellcheck disable=SC2086
    set -- $size
    awk -v n="$(($1 * $1))" -v ranks="$2" '{
        printf "soft discs %7d, %2d ranks %12.0f %10.0f %13.0f %8.2f %9.1f %10.2f %14.0f\n",
            n, ranks, $1, $2, $3, ($2 > 0 ? $3 / (16 * $2) : 0), $4, $5, $6 }' "$work/row"
done
# The last row has 16 ranks, the first number at which some ranks have neighbours on all sides.
read -r own _ bytes messages reductions _ <"$work/row"

if [ -z "${STEP_NS:-}" ]; then
    each=$(steady 20 mpirun -n 2 "$petri" run "$soft" --fps 5 --threads 1)
    frame=$(steady 60 mpirun -n 2 "$petri" run "$soft" --fps 25 --threads 1)
    # A frame has ten steps at 5 fps, and two at 25 fps.
    STEP_NS=$(echo "$each $frame $side" | awk '{ print ($1 - $2) / 8 / $3 / $3 * 2e6 }')
    FRAME_NS=$(echo "$each $frame $side" | awk '{ f = (10 * $2 - 2 * $1) / 8 / $3 / $3 * 1e6; print (f > 0 ? f : 0) }')
fi
echo
awk -v c="$STEP_NS" -v f="${FRAME_NS:-0}" -v own="$own" -v bytes="$bytes" -v messages="$messages" -v reductions="$reductions" \
    -v latency="${LATENCY:-2 25}" -v bandwidth="${BANDWIDTH:-10 1}" '
    # Returns the nanoseconds of a step on `ranks` ranks, including a share of the work per frame.
    function step(n, ranks, steps, us, gb,   log2) {
        if (ranks == 1) return n * c + n * f / steps
        log2 = log(ranks) / log(2)
        return n * c / ranks + (messages + 2 * reductions * log2) * us * 1000 + sent * sqrt(n / ranks) / gb \
            + (n * f + 36 * n / gb + 2 * log2 * us * 1000) / steps
    }
    # Doubles the number of ranks as long as each doubling makes a step at least 1.4 times as fast. Returns this number
    # and the speed-up over one rank.
    function gain(n, steps, us, gb,   ranks) {
        for (ranks = 1; ranks < 65536 && step(n, 2 * ranks, steps, us, gb) * 1.4 <= step(n, ranks, steps, us, gb); )
            ranks *= 2
        return sprintf("%d: %.0f times", ranks, step(n, 1, steps, us, gb) / step(n, ranks, steps, us, gb))
    }
    BEGIN {
        sent = bytes / sqrt(own)
        printf "A particle takes %.1f ns per step and %.1f ns per frame; a rank of n particles sends %.0f sqrt(n) bytes.\n\n", c, f, sent
        networks = split(latency, us, " ")
        split(bandwidth, gb, " ")
        head = "| discs | steps per frame |"
        rule = "|---|---|"
        for (k = 1; k <= networks; k++) {
            head = head " ranks and gain at " us[k] " µs, " gb[k] " GB/s |"
            rule = rule "---|"
        }
        print head "\n" rule
        for (n = 1e5; n < 2e7; n *= 10)
            for (steps = 10; steps <= 1000; steps *= 10) {
                row = sprintf("| %d | %d |", n, steps)
                for (k = 1; k <= networks; k++)
                    row = row " " gain(n, steps, us[k], gb[k]) " |"
                print row
            }
    }'
