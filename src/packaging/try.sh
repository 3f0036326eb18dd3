#!/bin/sh
# try.sh FOLDER: installs the Debian packages in FOLDER on this machine and tests them. It runs on the minimal system
# of ./dev package --test. Exits with 0 if all tests pass.
set -eu
[ "$(id -u)" -eq 0 ] && [ -e /root/petri ] || {
    echo "try.sh must run on the minimal system of ./dev package --test" >&2
    exit 2
}
folder=$(cd "$1" && pwd)
cd /tmp
apt-get -qq update
install() { DEBIAN_FRONTEND=noninteractive apt-get -qqy --no-install-recommends install "$@" >install.log 2>&1 || {
    cat install.log
    exit 1
}; }
debs() { find "$folder" -name "$1_*.deb"; }
# The static program has no dependencies, so it is tested before anything is installed.
find "$folder" -name 'petri-*-static' | while read -r program; do
    echo "!x y=frame" >x.fl
    [ "$("$program" run x.fl --frames 2 --print tree | grep -c '!x y=')" -eq 2 ] || exit 1
    "$program" help sin | grep -q 'Sine' || exit 1
    echo "the static petri runs"
done
install "$(debs petri)"
tests=/root/petri/src/packaging/debian/tests # those of autopkgtest
$tests/command
echo "petri runs, draws and shows help"
install "$(debs petri-mpi)"
$tests/mpi
echo "petri runs on two processes"
# shellcheck disable=SC2046 # file names without spaces
install $(debs "libpetri[0-9]*") $(debs "libpetri-draw[0-9]*") $(debs "libpetri-archive[0-9]*") $(debs libpetri-dev) gcc libc6-dev pkg-config
$tests/library
echo "a program that uses libpetri builds and runs"
install "$(debs python3-petri)"
$tests/python
echo "python3-petri works"
# shellcheck disable=SC2046 # names without spaces
apt-get -qqy purge petri petri-mpi $(dpkg-query --show --showformat='${Package} ' "libpetri*[0-9]") >install.log 2>&1
[ ! -e /usr/bin/petri ] && [ ! -e /usr/share/petri ]
echo "the packages can be removed"
