# packages.sh: installation of the Debian packages that dev needs. Sourced by dev after progress.sh, with `root` set.

# Requirements: lines of a test command, a colon, and the packages to install if the test fails.
# To compile petri and to show pictures in a terminal:
RUN_NEEDS='
command -v gcc            : gcc libc6-dev
command -v meson          : meson
command -v ninja          : ninja-build
command -v pkg-config     : pkg-config
bison --version | grep -Eq " (3[.]([89]|[1-9][0-9])|[4-9])" : bison
command -v re2c           : re2c
pkg-config --exists libxxhash : libxxhash-dev
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
# For windows, video, plans of petri sweep, links, HDF5 files and archives:
BUILD_NEEDS="$RUN_NEEDS
pkg-config --exists sdl2  : libsdl2-dev
command -v ffmpeg         : ffmpeg
pkg-config --exists yaml-0.1: libyaml-dev
pkg-config --exists zlib  : zlib1g-dev
pkg-config --exists hdf5  : libhdf5-dev
pkg-config --exists sqlite3 : libsqlite3-dev
"
# For the Python module:
PYTHON_NEEDS="
has_module build           : python3-build
has_module cffi            : python3-cffi
has_module numpy           : python3-numpy
has_module pygments        : python3-pygments
has_module setuptools      : python3-setuptools
has_module wheel           : python3-wheel
command -v python3-config : python3-dev
"
# For the tests; tests without their tool are skipped:
TEST_NEEDS="$BUILD_NEEDS
$PYTHON_NEEDS
pkg-config --exists cmocka: libcmocka-dev
command -v tmux           : tmux
command -v pgrep          : procps
command -v gappa          : gappa
command -v strace         : strace
command -v sqlite3        : sqlite3
command -v Xvfb           : xvfb
command -v xdotool        : xdotool
command -v xprop          : x11-utils
command -v compare        : imagemagick
command -v openbox        : openbox
command -v cmake          : cmake make
command -v c++            : g++
command -v mandoc         : mandoc
command -v abidiff        : abigail-tools
command -v zsh            : zsh
command -v fish           : fish
command -v desktop-file-validate : desktop-file-utils
command -v appstreamcli   : appstream
pkg-config --exists x11   : libx11-dev
pkg-config --exists ompi-c: libopenmpi-dev openmpi-bin
pkg-config --exists mpfr  : libmpfr-dev
has_module h5py            : python3-h5py
has_module xxhash          : python3-xxhash
has_module yaml            : python3-yaml
test -f /usr/share/fonts/truetype/dejavu/DejaVuSans-Oblique.ttf : fonts-dejavu-extra
test -d /usr/share/fonts/truetype/liberation : fonts-liberation
"
# To execute the notebooks of samples/ as Jupyter does; otherwise the tests execute their cells in order:
NOTEBOOK_NEEDS="has_module ipykernel nbconvert: python3-ipykernel python3-nbconvert"
CLANG_NEEDS='command -v clang: clang'
# The memory sanitizer of clang 14, Debian's default, does not support fstat of Debian's glibc.
MEMORY_NEEDS='command -v clang-16: clang-16 libclang-rt-16-dev'
EDITOR_NEEDS='
command -v nvim: neovim
command -v npm : npm
pkg-config --exists tree-sitter : libtree-sitter-dev
'
COVERAGE_NEEDS='command -v llvm-cov: llvm'
# Meson uses ccache if it is there; several builds of .ci/run compile the same files.
CACHE_NEEDS='command -v ccache: ccache'
FORMAT_NEEDS='command -v clang-format: clang-format'
TIDY_NEEDS='command -v run-clang-tidy: clang-tidy'
CROSS_NEEDS='
command -v aarch64-linux-gnu-gcc: gcc-aarch64-linux-gnu libc6-dev-arm64-cross
command -v riscv64-linux-gnu-gcc: gcc-riscv64-linux-gnu libc6-dev-riscv64-cross
command -v powerpc64le-linux-gnu-gcc: gcc-powerpc64le-linux-gnu libc6-dev-ppc64el-cross
command -v s390x-linux-gnu-gcc: gcc-s390x-linux-gnu libc6-dev-s390x-cross
command -v arm-linux-gnueabihf-gcc: gcc-arm-linux-gnueabihf libc6-dev-armhf-cross
command -v qemu-aarch64  : qemu-user
command -v musl-gcc      : musl-tools
'
WEB_NEEDS='
command -v meson : meson
command -v ninja : ninja-build
bison --version | grep -Eq " (3[.]([89]|[1-9][0-9])|[4-9])" : bison
command -v re2c  : re2c
command -v pkg-config : pkg-config
pkg-config --exists libxxhash : libxxhash-dev
command -v emcc  : emscripten
command -v node  : nodejs
'
# The page also needs npm, but WEB_NEEDS leaves it out, because Debian's npm depends on 400 packages. If npm is missing,
# only the engine is built.
WEB_TEST_NEEDS="$WEB_NEEDS
command -v chromium : chromium
command -v firefox-esr : firefox-esr
"
PEER_NEEDS='
command -v lmp   : lammps
command -v mpirun: openmpi-bin
'
PACKAGE_NEEDS='
dpkg-query --show build-essential : build-essential
pkg-config --exists ompi-c  : libopenmpi-dev
command -v dpkg-buildpackage: dpkg-dev
command -v dh               : debhelper
command -v dh_python3       : dh-python
command -v xz               : xz-utils
command -v lintian          : lintian
'
DIST_NEEDS='
command -v git    : git
command -v python3: python3
command -v xz     : xz-utils
'
STATIC_NEEDS='command -v musl-gcc: musl-tools'
# Options of a build that needs only the C library.
WITHOUT='-Dauto_features=disabled -Dtests=false -Ddefault_library=static'
CLEAN_INSTALL_NEEDS='command -v debootstrap: debootstrap'
# Libraries that meson uses if they are installed. If this set changes, build folders are configured again.
OPTIONAL_LIBRARIES='cairo pangocairo libjpeg libpng chafa libedit sdl2 epoxy yaml-0.1 zlib hdf5 sqlite3 cmocka x11 ompi-c mpfr python3 tree-sitter'

# present_modules NAME...: prints those of the modules that the system's Python has. Does not import them, which would take
# long. -I prevents Python from finding the folder `build` as the module `build`.
present_modules() {
    /usr/bin/python3 -I -c 'import importlib.util, sys
for name in sys.argv[1:]:
    if importlib.util.find_spec(name):
        print(name)' "$@" 2>/dev/null || true
}

# has_module NAME...: returns whether the system's Python has these modules.
has_module() { [ "$(present_modules "$@" | wc -l)" -eq $# ]; }

# note_installation: makes the build folders be configured again, because Meson looks for more than pkg-config knows.
note_installation() { date +%s >"$root/build/packages-time"; }

# missing NEEDS: prints the packages whose test commands fail.
missing() {
    echo "$1" | while IFS=: read -r probe packages; do
        if [ -n "$probe" ] && ! eval "$probe" >/dev/null 2>&1; then
            echo "$packages"
        fi
    done | xargs
}

# Names of packages on other systems: Debian's name, and those of Homebrew, Fedora (dnf) and Arch Linux (pacman). "-": the
# system has it, or it is not needed there. Other packages have the same name as in Debian.
OTHER_NAMES='
bison                bison        bison                bison
fonts-dejavu-core    -            dejavu-sans-fonts    ttf-dejavu
fonts-dejavu-extra   -            dejavu-sans-fonts    ttf-dejavu
fonts-liberation     -            liberation-fonts     ttf-liberation
gcc                  -            gcc                  gcc
libc6-dev            -            glibc-devel          -
libcairo2-dev        cairo        cairo-devel          cairo
libchafa-dev         chafa        chafa-devel          chafa
libcmocka-dev        cmocka       libcmocka-devel      cmocka
libedit-dev          -            libedit-devel        libedit
libegl-dev           -            libglvnd-devel       libglvnd
libegl1              -            libglvnd-egl         -
libepoxy-dev         libepoxy     libepoxy-devel       libepoxy
libgl1-mesa-dri      -            mesa-dri-drivers     mesa
libgles2             -            libglvnd-gles        -
libhdf5-dev          hdf5         hdf5-devel           hdf5
libjpeg-dev          jpeg-turbo   libjpeg-turbo-devel  libjpeg-turbo
libpango1.0-dev      pango        pango-devel          pango
libpng-dev           libpng       libpng-devel         libpng
libsdl2-dev          sdl2         SDL2-devel           sdl2
libsqlite3-dev       sqlite       sqlite-devel         sqlite
libtree-sitter-dev   tree-sitter  libtree-sitter-devel tree-sitter
libxxhash-dev        xxhash       xxhash-devel         xxhash
libyaml-dev          libyaml      libyaml-devel        libyaml
ninja-build          ninja        ninja-build          ninja
pkg-config           pkgconf      pkgconf-pkg-config   pkgconf
zlib1g-dev           zlib         zlib-devel           zlib
'

# Homebrew's bison is not in PATH, because macOS has an older one.
! command -v brew >/dev/null || PATH=$(brew --prefix)/opt/bison/bin:$PATH

# names_elsewhere COLUMN PACKAGES: prints the names of these Debian packages in a column of the table.
names_elsewhere() {
    echo "$2" | tr ' ' '\n' | awk -v table="$OTHER_NAMES" -v column="$1" '
        BEGIN { count = split(table, word); for (i = 1; i < count; i += 4) name[word[i]] = word[i + column] }
        { found = $1 in name ? name[$1] : $1; if (found != "-" && !done[found]++) print found }' | xargs
}

# need_elsewhere PACKAGES: on a system without apt-get, installs packages with brew, or stops with the command that
# installs them. Returns if the system has all.
need_elsewhere() {
    if command -v brew >/dev/null; then
        names=$(names_elsewhere 1 "$1")
        [ -n "$names" ] || return 0
        say "packages: brew install $names"
        mkdir -p "$root/build"
        # shellcheck disable=SC2086 # packages are words
        quietly "$root/build/packages.log" brew install $names
        note_installation
        return
    fi
    if command -v dnf >/dev/null; then
        command="sudo dnf install" names=$(names_elsewhere 2 "$1")
    elif command -v pacman >/dev/null; then
        command="sudo pacman -S --needed" names=$(names_elsewhere 3 "$1")
    else
        die "no apt-get on this system; please install the equivalents of these Debian packages: $1"
    fi
    [ -z "$names" ] || die "petri needs packages; to install them, run: $command $names"
}

print_command() { echo "apt-get install --no-install-recommends $*"; }

# plan_sizes PLAN: reads the output of `apt-get --print-uris install`. Prints a line with the number of packages, the
# megabytes to download and the megabytes of disk space, or nothing.
plan_sizes() {
    awk 'function megabytes(number, unit) {
            sub(",", ".", number)
            return number * (unit ~ /^G/ ? 1000 : unit ~ /^M/ ? 1 : unit ~ /^k/ ? 0.001 : 0.000001)
        }
        / newly installed/ { found = 1; count = $1; for (i = 2; i < NF; i++) if ($(i + 1) == "newly") count += $i }
        /^Need to get / { download = megabytes($4, $5) }
        /^After this operation, .* will be used/ { disk = megabytes($4, $5) }
        END { if (found) printf "%d %.0f %.0f\n", count, download, disk }' "$1"
}

# sizes PACKAGES: prints the numbers of plan_sizes from the machine's package lists, which does not need root. If the
# lists are empty or too old, prints an estimate from figures of a minimal Debian 12, followed by "about".
sizes() {
    # shellcheck disable=SC2086 # packages are words
    LC_ALL=C apt-get -qy -o Debug::NoLocking=true --no-install-recommends --print-uris install $1 \
        >"$root/build/packages-sizes.log" 2>&1 </dev/null && plan_sizes "$root/build/packages-sizes.log" | grep . && return
    echo "$1" | awk -v run="$(named "$RUN_NEEDS")" -v all="$(named "$TEST_NEEDS")" '
        function part(first, rest) { return NF <= run ? NF / run * first : first + (NF - run) / (all - run) * rest }
        { printf "%.0f %.0f %.0f about\n", part(204, 327), part(155, 196), part(600, 720) }'
}

# named NEEDS: prints the number of packages in the list.
named() { echo "$1" | sed -n 's/.*: *//p' | wc -w; }

# packages_of N [WORD]: prints "1 WORD package" or "N WORD packages".
packages_of() { if [ "$1" -eq 1 ]; then echo "1 ${2:-}package"; else echo "$1 ${2:-}packages"; fi; }

# confirm PACKAGES: asks whether to install the packages, once per checkout and only on a terminal outside CI.
confirm() {
    agreed=$root/build/packages-agreed
    if [ ! -t 0 ] || [ "${CI:-}" = true ] || [ -e "$agreed" ]; then
        return 0
    fi
    mkdir -p "$root/build"
    say "packages are missing; reading their sizes"
    later=$(echo " $(missing "$TEST_NEEDS") " | tr ' ' '\n' | grep -vxF "$(echo "$1" | tr ' ' '\n')" | xargs)
    {
        read -r count download disk about
        read -r all_count all_download _ all_about
    } <<END
$(sizes "$1")
$(sizes "$1 $later")
END
    # Estimate for Debian's servers and an ordinary disk: 2 MB and 4 packages per second.
    minutes=$(((download / 2 + count / 4) / 60 + 1))
    number=$(echo "$1" | wc -w)
    {
        echo "petri needs $(packages_of "$number" "Debian ") (${about:+about }$count with dependencies, $download MB to download," \
            "$disk MB of disk space, about $minutes minute$([ $minutes -eq 1 ] || echo s)): $1"
        echo "Later commands install what they need without asking again$(
            [ -z "$later" ] || echo "; the tests need $(echo "$later" | wc -w) more" \
                "(${all_about:+about }$((all_count - count)) with dependencies, $((all_download - download)) MB to download)")."
    } | fold -s -w "$((columns > 20 ? columns : 80))" >&2
    printf 'Install %s now? [Y/n] ' "$(if [ "$number" -eq 1 ]; then echo it; else echo "the $number packages"; fi)" >&2
    read -r answer || answer=no
    case $answer in
    '' | y* | Y*) ;;
    *) die "nothing was installed; to install the packages yourself, run: $(print_command "$1")" ;;
    esac
    : >"$agreed"
}

# refuse_root PACKAGES: reports that the user cannot install packages, and exits.
refuse_root() {
    die "cannot install packages: you are not root and cannot use sudo.
Ask an administrator to run this command, then try again:
  $(print_command "$1")"
}

# ask_sudo PACKAGES: lets sudo ask for the password, if it needs one.
ask_sudo() {
    ! sudo -n true 2>/dev/null || return 0
    if [ -t 0 ] || [ -t 2 ]; then
        ! sudo -v || return 0
    fi
    refuse_root "$1"
}

# check_sudo PACKAGES: exits if the user cannot use sudo. A user who must type a password is asked for it now if the user is
# in none of the groups that usually may use sudo; others are first asked whether to install the packages.
check_sudo() {
    [ "$(id -u)" -ne 0 ] || return 0
    command -v sudo >/dev/null || refuse_root "$1"
    case " $(id -Gn) " in
    *' sudo '* | *' wheel '* | *' admin '*) [ ! -t 0 ] && [ ! -t 2 ] || return 0 ;;
    esac
    ask_sudo "$1"
}

# become_root PACKAGES: sets `as_root` to the prefix that runs a command as root.
become_root() {
    as_root=
    [ "$(id -u)" -ne 0 ] || return 0
    as_root=sudo
    ask_sudo "$1" # now, because later output goes to a log
}

install_packages() {
    # shellcheck disable=SC2086 # $as_root may be empty
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
        finished=$(((fetched + unpacked + ready) / 3)) # may exceed $count if the lists have changed
        counted packages $((finished < count ? finished : count)) "$count" "$name"
    done
}

# explain_failure LOG PACKAGES: reports why an installation failed, and exits.
explain_failure() {
    erase
    if grep -Eq 'Temporary failure resolving|Could not (resolve|connect)|Unable to connect|Connection (failed|timed out)|Network is unreachable' "$1"; then
        die "cannot fetch packages: no network? (The output of apt-get is in $1.)"
    fi
    grep -h '^E: ' "$1" | tail -n 3 >&2
    die "cannot install $2. (The output of apt-get is in $1.)"
}

# need NEEDS: installs the missing packages.
need() {
    packages=$(missing "$1")
    [ -n "$packages" ] || return 0
    command -v apt-get >/dev/null || {
        need_elsewhere "$packages"
        return 0
    }
    check_sudo "$packages"
    confirm "$packages"
    become_root "$packages"
    mkdir -p "$root/build"
    lists=$root/build/packages-lists.log
    plan=$root/build/packages-plan.log
    # The package lists of a new machine are empty. Those of an old machine may name deleted files.
    say "packages: reading the lists"
    install_packages update >"$lists" 2>&1 </dev/null || true # the old lists may still work
    # shellcheck disable=SC2086 # packages are words
    install_packages --no-install-recommends --print-uris install $packages >"$plan" 2>&1 </dev/null || {
        cat "$plan" >>"$lists"
        explain_failure "$lists" "$packages"
    }
    read -r count download disk <<END
$(plan_sizes "$plan")
END
    say "packages: ${count:=1} to install, ${download:-0} MB to download, ${disk:-0} MB of disk space"
    rm -f "$plan"
    # Does not sync after each file: a power failure would only affect this installation.
    # shellcheck disable=SC2086 # packages are words
    following "$root/build/packages.log" follow_installation install_packages --no-install-recommends \
        -o Dpkg::Options::=--force-unsafe-io -o DPkg::Lock::Timeout=600 install $packages ||
        explain_failure "$root/build/packages.log" "$packages"
    note_installation
    packages=$(missing "$1")
    [ -z "$packages" ] || die "still missing after the installation: $packages"
}
