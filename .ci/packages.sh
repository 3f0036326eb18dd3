# packages.sh: the Debian packages that dev installs, and how. Sourced by dev after progress.sh, with `root` set.

# What has to be there, and the packages that bring it: one line each, the test first.
# To compile petri and to see it in a terminal:
RUN_NEEDS='
command -v gcc            : gcc libc6-dev
command -v meson          : meson
command -v ninja          : ninja-build
command -v pkg-config     : pkg-config
command -v bison          : bison
command -v re2c           : re2c
pkg-config --exists cairo : libcairo2-dev
pkg-config --exists pangocairo : libpango1.0-dev
pkg-config --exists libjpeg : libjpeg-dev
pkg-config --exists libpng  : libpng-dev
pkg-config --exists chafa : libchafa-dev
pkg-config --exists libedit: libedit-dev
pkg-config --exists epoxy egl : libepoxy-dev libegl-dev
ls /usr/lib/*/dri/swrast_dri.so : libgl1-mesa-dri libegl1 libgles2
test -f /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf : fonts-dejavu-core
'
# For windows, films, plans of petri sweep, links, files in HDF5 and editors:
BUILD_NEEDS="$RUN_NEEDS
pkg-config --exists sdl2  : libsdl2-dev
command -v ffmpeg         : ffmpeg
pkg-config --exists yaml-0.1: libyaml-dev
pkg-config --exists json-c: libjson-c-dev
pkg-config --exists zlib  : zlib1g-dev
pkg-config --exists hdf5  : libhdf5-dev
"
# For the module for Python:
PYTHON_NEEDS="
/usr/bin/python3 -I -c 'import build'      : python3-build
/usr/bin/python3 -I -c 'import cffi'       : python3-cffi
/usr/bin/python3 -I -c 'import numpy'      : python3-numpy
/usr/bin/python3 -I -c 'import pygments'   : python3-pygments
/usr/bin/python3 -I -c 'import setuptools' : python3-setuptools
/usr/bin/python3 -I -c 'import wheel'      : python3-wheel
command -v python3-config : python3-dev
"
# For the tests; those that lack a tool are skipped:
TEST_NEEDS="$BUILD_NEEDS
$PYTHON_NEEDS
pkg-config --exists cmocka: libcmocka-dev
command -v tmux           : tmux
command -v pgrep          : procps
command -v strace         : strace
command -v Xvfb           : xvfb
command -v xdotool        : xdotool
command -v xprop          : x11-utils
command -v compare        : imagemagick
command -v openbox        : openbox
command -v cmake          : cmake make
command -v c++            : g++
command -v mandoc         : mandoc
command -v zsh            : zsh
command -v fish           : fish
command -v desktop-file-validate : desktop-file-utils
pkg-config --exists x11   : libx11-dev
pkg-config --exists ompi-c: libopenmpi-dev openmpi-bin
pkg-config --exists mpfr  : libmpfr-dev
/usr/bin/python3 -I -c 'import h5py' : python3-h5py
test -f /usr/share/fonts/truetype/dejavu/DejaVuSans-Oblique.ttf : fonts-dejavu-extra
test -d /usr/share/fonts/truetype/liberation : fonts-liberation
"
CLANG_NEEDS='command -v clang: clang'
# The memory sanitizer of Debian's clang, 14, does not know fstat of today's glibc.
MEMORY_NEEDS='command -v clang-16: clang-16 libclang-rt-16-dev'
EDITOR_NEEDS='
command -v nvim: neovim
command -v npm : npm
'
COVERAGE_NEEDS='command -v llvm-cov: llvm'
FORMAT_NEEDS='command -v clang-format: clang-format'
TIDY_NEEDS='command -v run-clang-tidy: clang-tidy'
CROSS_NEEDS='
command -v aarch64-linux-gnu-gcc: gcc-aarch64-linux-gnu libc6-dev-arm64-cross
command -v qemu-aarch64  : qemu-user
command -v musl-gcc      : musl-tools
'
WEB_NEEDS='
command -v meson : meson
command -v ninja : ninja-build
command -v bison : bison
command -v re2c  : re2c
command -v emcc  : emscripten
command -v node  : nodejs
'
# npm, which the page takes, is not among them: Debian's brings 400 packages along. Without it there is the engine alone.
WEB_TEST_NEEDS="$WEB_NEEDS
command -v chromium : chromium
"
PEER_NEEDS='
command -v lmp   : lammps
command -v mpirun: openmpi-bin
'
PACKAGE_NEEDS='
command -v dpkg-buildpackage: dpkg-dev
command -v dh               : debhelper
command -v dh_python3       : dh-python
command -v xz               : xz-utils
'
STATIC_NEEDS='command -v musl-gcc: musl-tools'
# Options of a build that takes the C library alone.
WITHOUT='-Dcairo=disabled -Dgl=disabled -Dsdl=disabled -Dchafa=disabled -Dlibedit=disabled -Dyaml=disabled
    -Dhdf5=disabled -Djson=disabled -Dzlib=disabled -Dmpi=disabled -Dpython=disabled -Dtests=false -Ddefault_library=static'
FRESH_NEEDS='command -v debootstrap: debootstrap'
# What meson looks for and can do without. A build folder is set up anew when another of these is there.
OPTIONAL_LIBRARIES='cairo pangocairo libjpeg libpng chafa libedit sdl2 epoxy yaml-0.1 zlib hdf5 json-c cmocka x11 ompi-c mpfr python3'

# missing NEEDS: the packages for what is not there.
missing() {
    echo "$1" | while IFS=: read -r probe packages; do
        if [ -n "$probe" ] && ! eval "$probe" >/dev/null 2>&1; then
            echo "$packages"
        fi
    done | xargs
}

by_hand() { echo "apt-get install --no-install-recommends $*"; }

# agree PACKAGES: asks, once for all that will ever be needed, if there is someone to ask.
agree() {
    agreed=$root/build/packages-agreed
    if [ ! -t 0 ] || [ "${CI:-}" = true ] || [ -e "$agreed" ]; then
        return 0
    fi
    say "these Debian packages are missing, and what they need themselves:"
    echo "  $1" | fold -s >&2
    later=$(echo " $(missing "$TEST_NEEDS") " | tr ' ' '\n' | grep -vxF "$(echo "$1" | tr ' ' '\n')" | xargs)
    if [ -n "$later" ]; then
        echo "and, once you build all of it or run the tests:" >&2
        echo "  $later" | fold -s >&2
    fi
    printf 'Install what is needed when it is needed? [Y/n] ' >&2
    read -r answer || answer=no
    case $answer in
    '' | y* | Y*) ;;
    *) die "nothing was installed. By hand it is done by: $(by_hand "$1")" ;;
    esac
    mkdir -p "$root/build"
    : >"$agreed"
}

# become_root PACKAGES: sets `as_root` to what makes a command root's.
become_root() {
    as_root=
    [ "$(id -u)" -ne 0 ] || return 0
    as_root=sudo
    if command -v sudo >/dev/null; then
        # It asks for the password, or says why not, before anything is hidden in a log.
        ! sudo -n true 2>/dev/null || return 0
        if [ -t 0 ] || [ -t 2 ]; then
            ! sudo -v || return 0
        fi
    fi
    die "installing packages needs root, and you are not: there is no sudo, or it does not let you.
An administrator can do it for you, and then the same command works:
  $(by_hand "$1")"
}

get() {
    # shellcheck disable=SC2086 # $as_root may be no word
    $as_root env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get -qy "$@"
}

follow_installation() {
    fetched=0 unpacked=0 ready=0
    while read -r first second rest; do
        case $first in
        Get:*)
            fetched=$((fetched + 1))
            name="fetching $(echo "$rest" | cut -d ' ' -f 3)"
            ;;
        Unpacking)
            unpacked=$((unpacked + 1))
            name="unpacking $second"
            ;;
        Setting)
            ready=$((ready + 1))
            name="setting up ${rest%% *}"
            ;;
        Waiting) name="waiting for another installation to end" ;;
        *) continue ;;
        esac
        counted packages $(((fetched + unpacked + ready) / 3)) "$count" "$name"
    done
}

# give_up LOG PACKAGES: tells why an installation failed.
give_up() {
    erase
    if grep -Eq 'Temporary failure resolving|Could not (resolve|connect)|Unable to connect|Connection (failed|timed out)|Network is unreachable' "$1"; then
        die "cannot fetch packages: no network? (What apt-get said is in $1.)"
    fi
    grep -h '^E: ' "$1" | tail -n 3 >&2
    die "cannot install $2. (What apt-get said is in $1.)"
}

# need NEEDS: installs what is missing of these.
need() {
    packages=$(missing "$1")
    [ -n "$packages" ] || return 0
    command -v apt-get >/dev/null || die "please install what Debian calls: $packages"
    agree "$packages"
    become_root "$packages"
    mkdir -p "$root/build"
    lists=$root/build/packages-lists.log
    plan=$root/build/packages-plan.log
    # The lists of a fresh machine are empty, those of an old one may name files that are gone: both need the update.
    say "packages: reading the lists"
    get update >"$lists" 2>&1 </dev/null || true # with old lists it may do all the same
    # shellcheck disable=SC2086 # packages are words
    get --no-install-recommends --print-uris install $packages >"$plan" 2>&1 </dev/null || {
        cat "$plan" >>"$lists"
        give_up "$lists" "$packages"
    }
    count=$(sed -n 's/.* \([0-9]*\) newly installed.*/\1/p' "$plan")
    size=$(sed -n 's/^Need to get \(.*B\) of archives.*/\1/p' "$plan")
    say "packages: ${count:=1} to install, ${size:-nothing} to download"
    rm -f "$plan"
    # Nothing of the machine's is at stake when power fails in between: no need to wait for the disk after each file.
    # shellcheck disable=SC2086 # packages are words
    following "$root/build/packages.log" follow_installation get --no-install-recommends \
        -o Dpkg::Options::=--force-unsafe-io -o DPkg::Lock::Timeout=600 install $packages ||
        give_up "$root/build/packages.log" "$packages"
    packages=$(missing "$1")
    [ -z "$packages" ] || die "still missing after the installation: $packages"
}
