#!/bin/sh
# limits.sh PETRI: short scripts that need too much work or memory. Each must end within 3 GiB of address space with a
# diagnostic that has a position and with status 1, or must succeed. To save time, the limits are a quarter of the default
# ones; LIMITS=whole uses the defaults, as .ci/deep does.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
scratch
cp "$here"/*.fl .
# The address sanitizer reserves terabytes of address space.
limit=3145728
(ulimit -v $limit && "$petri" --version) >/dev/null 2>&1 || limit=unlimited

# runs KIBIBYTES ARGUMENTS...: runs petri and sets `status`. The output is in the files out and err. The timeout allows
# for a busy machine.
runs() {
    max=$1
    shift
    (ulimit -v "$max" && exec timeout -s KILL 100 "$petri" "$@") >out 2>err </dev/null
    status=$?
}
quarter() {
    case ${LIMITS:-} in
    whole) ;;
    *) [ "$1" = work-limit ] && echo "--work 256M" || echo "--memory 512M" ;;
    esac
}
# refused SCRIPT CODE ARGUMENTS...: checks that the run fails with the diagnostic CODE and a position.
refused() {
    script=$1
    code=$2
    shift 2
    # shellcheck disable=SC2046 # an option and its value, or none
    runs $limit "$@" $(quarter "$code")
    check "$script is aborted" status_is 1
    check "$script: the diagnostic has a position" grep -Eq "^$script\.fl:[0-9]+:[0-9]+: error: .*\[$code\]" err
}
# fits KIBIBYTES SCRIPT ARGUMENTS...: checks that the run succeeds.
fits() {
    max=$1
    script=$2
    shift 2
    [ $limit = unlimited ] && max=unlimited
    runs "$max" "$@"
    check "$script succeeds" status_is 0
}

for script in in_quadratic group_dag steps gravity noise octnoise random collide; do
    refused $script work-limit run --frames 2 $script.fl
done
for script in state_memory concat counters particles systems sorts debug_dag; do
    refused $script memory-limit run --frames 2 $script.fl
done
refused gradient work-limit render --frame 0 gradient.fl -o picture.png
refused canvas_dag memory-limit render --frame 0 canvas_dag.fl -o picture.png
refused sdf_function work-limit render --frame 0 sdf_function.fl -o picture.png
refused sdf_memory memory-limit render --frame 0 sdf_memory.fl -o picture.png
check "an aborted drawing writes no file" [ ! -e picture.png ]
refused print_dag memory-limit run --frames 1 --print tree print_dag.fl
if [ "$("$petri" help run | grep -c -- --archive)" -gt 0 ] && "$petri" run --frames 1 --archive first.petri eq_dag.fl 2>err; then
    # The search for the files that drawing reads.
    fits $limit archive_dag run --frames 1 --archive dag.petri archive_dag.fl
    "$petri" archive info dag.petri >out
    check "the archive has the file of a shared node" grep -q 'archive_dag.fl: .* bytes' out
    refused archive_wide work-limit run --frames 1 --archive wide.petri archive_wide.fl
    check "the archive ends with the search" grep -q "the archive 'wide.petri' ends here: limit exceeded" err
fi
fits $limit eq_dag run --frames 1 eq_dag.fl
fits $limit seed_dag run --frames 1 seed_dag.fl
fits 1000000 system_leak run --frames 20000 system_leak.fl

# A chain of imports has a maximum length.
i=0
while [ $i -lt 3000 ]; do
    echo "import a from 'm$((i + 1)).fl'" >m$i.fl
    i=$((i + 1))
done
fits $limit imports run --frames 2 m0.fl
check "too deeply nested imports are reported" has err "imports nested too deeply"

# Options set the limits.
echo '!a x=len(i for i in ..(1000+frame))' >loop.fl
runs $limit run --frames 1 --work 500 loop.fl
check "--work lowers the limit" has err "the frame exceeded its limit of 500 work units"
check "the message names --work and a larger limit" has err "stopped in frame 0; to allow four times as much, use --work 4M"
runs $limit run --frames 1 --work 1G in_quadratic.fl
check "--work raises the limit" has err "its limit of 1073741824 work units"
echo '!a x=len((..2e7)+frame)' >power.fl
runs $limit run --frames 1 --memory 100M power.fl
check "--memory lowers the limit" has err "the frame exceeded its memory limit of 100 MiB"
check "the message names --memory and a larger limit" has err "stopped in frame 0; to allow four times as much, use --memory 400M"
runs $limit run --frames 1 --memory 400M power.fl
check "the larger memory limit suffices" status_is 0
runs $limit run --frames 1 --memory none loop.fl
check "--memory none is rejected" status_is 2
finish
