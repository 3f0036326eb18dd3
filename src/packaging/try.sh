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
petri new dish
petri run dish.fl --frames 10 --print hash --every 9
petri render dish.fl -o dish.png --frames 1 --quiet
petri run dish.fl --frames 10 --archive dish.petri
petri verify dish.petri | grep -q '^verified: 10 of 10'
head -c 8 dish.png | grep -q PNG
petri help sin | grep -q Sine
[ -s /usr/share/bash-completion/completions/petri ]
echo "petri runs, draws and shows help"
# shellcheck disable=SC2046 # file names without spaces
install $(debs "libpetri[0-9]*") $(debs "libpetri-draw[0-9]*") $(debs "libpetri-archive[0-9]*") $(debs libpetri-dev) gcc libc6-dev pkg-config
sed -n '/^```c where.c$/,/^```$/p' /root/petri/README.md | sed '1d;$d' >where.c
# shellcheck disable=SC2046 # options are words
cc where.c -o where $(pkg-config --cflags --libs petri)
mkdir -p samples
cp /usr/share/petri/samples/petri.fl samples
./where | grep -q '^0 is at '
ldd where | grep -q "libpetri.so.[0-9]"
echo "a program that uses libpetri builds and runs"
install "$(debs python3-petri)"
python3 - <<'END'
import petri
session = petri.Session("samples/petri.fl", CELLS=20)
session.step(10)
assert session.systems["cells"].position.shape == (21, 2)
with session.archive("run.petri"):
    session.step(10)
petri.Archive("run.petri").verify()
assert session.picture(20, 20).pixels.shape == (20, 20, 4)
END
echo "python3-petri works"
# shellcheck disable=SC2046 # names without spaces
apt-get -qqy purge petri $(dpkg-query --show --showformat='${Package} ' "libpetri*[0-9]") >install.log 2>&1
[ ! -e /usr/bin/petri ] && [ ! -e /usr/share/petri ]
echo "the packages can be removed"
