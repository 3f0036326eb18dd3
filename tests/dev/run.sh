#!/bin/sh
# run.sh: tests of ./dev on a simulated minimal machine: packages, questions, root, network, compiler, tests. Nothing is
# installed or compiled: PATH contains fake tools that record their calls and print what the real ones would.
# shellcheck disable=SC2016 # dollars are for the fake tools
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
scratch
project="$work/Anna's Übung x" # the path of a checkout may look like this
print_details() {
    for file in out err calls; do
        sed "s/^/  $file: /" $file | tail -n 15
    done
}
python=$(python3 -c 'import sys; print(sys.executable)')
lines_at_most() { [ "$(wc -l <"$1")" -le "$2" ]; }

# fake_tool NAME: creates a program in $work from the shell script on standard input. The program records its calls.
fake_tool() {
    rm -f "$work/$1" # the file may be a link to the real tool
    { echo '#!/bin/sh' && echo "echo \"${1##*/} \$*\" >>'$work/calls'" && cat; } >"$work/$1"
    chmod +x "$work/$1"
}

# machine: creates a new machine with the project and basic tools. The user is root, and there is a network.
machine() {
    rm -rf "$work/bin" "$work/later" "$project" "$work/fonts" "$work/lists" "$work/mesa"
    mkdir -p "$work/bin" "$work/later" "$project/.ci" "$project/tests" "$work/fonts/truetype/dejavu" "$work/mesa/dri"
    for tool in awk cat chmod cksum cp cut date dirname echo env find fold grep head ln ls mkdir mktemp mv nproc rm rmdir sed sh sleep sort stty tail tee touch \
        tr true wc xargs; do
        ln -s "$(PATH=/usr/bin:/bin env which $tool)" "$work/bin/$tool"
    done
    cp "$root/dev" "$project"
    cp "$root"/.ci/* "$project/.ci"
    sed -i "s|/usr/share/fonts|$work/fonts|; s|/usr/lib/\*|$work/mesa|;
            s|:/usr/sbin:/sbin||; s|/usr/bin/python3|$work/bin/python3|" "$project/dev" "$project/.ci"/*
    echo "tests = {'quick': 'base', 'slow': 'view', 'other': 'base', 'whole': 'lint', 'prose': 'text'}" >"$project/tests/meson.build"
    : >"$work/calls"
    uid=0 groups=users network=yes breaks=
    fake_tool bin/id <<'END'
case $1 in -un) echo somebody ;; -Gn) echo "$FAKE_GROUPS" ;; *) echo "$FAKE_UID" ;; esac
END
    echo '[ -e "$WORK/bin/$2" ]' | fake_tool bin/dpkg-query
    fake_tool bin/apt-get <<'END'
case " $* " in
*' --print-uris '*) ;;
*) [ "$FAKE_UID" = 0 ] || { echo 'E: are you root?'; exit 100; } ;;
esac
unreachable() { echo "$1: Failed to fetch http://archive.example/x  Temporary failure resolving 'archive.example'"; }
case " $* " in
*' update '*)
    [ "$NETWORK" = yes ] || { unreachable W; exit 0; }
    touch "$WORK/lists"
    ;;
*' install '*)
    [ -e "$WORK/lists" ] || { echo 'E: Unable to locate package gcc'; echo 'E: Unable to locate package meson'; exit 100; }
    case " $* " in
    *' --print-uris '*)
        echo '0 upgraded, 3 newly installed, 0 to remove and 0 not upgraded.'
        echo 'Need to get 61.2 MB/70.0 MB of archives.'
        echo 'After this operation, 212 MB of additional disk space will be used.'
        exit ;;
    esac
    [ "$NETWORK" = yes ] || { unreachable E; exit 100; }
    [ "$BREAKS" != dpkg ] || { echo 'E: Sub-process dpkg returned an error code (1)'; exit 100; }
    for i in 1 2 3; do echo "Get:$i http://archive.example/debian stable/main amd64 part$i amd64 1.0-$i [20.4 MB]"; done
    for i in 1 2 3; do echo "Unpacking part$i (1.0-$i) ..."; done
    for i in 1 2 3; do echo "Setting up part$i (1.0-$i) ..."; done
    [ "$BREAKS" != count ] || for i in 4 5 6 7; do echo "Setting up part$i (1.0-$i) ..."; done
    for package; do
        case $package in
        ninja-build) package=ninja ;;
        procps) package=pgrep ;;
        xvfb) package=Xvfb ;;
        g++) package=c++ ;;
        x11-utils) package=xprop ;;
        imagemagick) package=compare ;;
        libgl1-mesa-dri) touch "$WORK/mesa/dri/swrast_dri.so" ;;
        desktop-file-utils) package=desktop-file-validate ;;
        appstream) package=appstreamcli ;;
        python3-dev) package=python3-config ;;
        dpkg-dev) package=dpkg-buildpackage ;;
        debhelper) package=dh ;;
        dh-python) package=dh_python3 ;;
        xz-utils) package=xz ;;
        abigail-tools) package=abidiff ;;
        python3-*)
            touch "$WORK/later/$package"
            package=python3
            ;;
        meson) cp "$WORK/later/python3" "$WORK/bin" ;;
        fonts-dejavu-core) touch "$WORK/fonts/truetype/dejavu/DejaVuSans.ttf" ;;
        fonts-liberation) mkdir -p "$WORK/fonts/truetype/liberation" ;;
        fonts-dejavu-extra) touch "$WORK/fonts/truetype/dejavu/DejaVuSans-Oblique.ttf" ;;
        esac
        case $package in
        lib*-dev | zlib1g-dev) touch "$WORK/later/$package" ;;
        -* | install) ;;
        debootstrap) echo '#!/bin/sh' >"$WORK/bin/debootstrap"; chmod +x "$WORK/bin/debootstrap" ;;
        bison) { echo '#!/bin/sh' && echo 'echo bison 3.8.2'; } >"$WORK/bin/bison" && chmod +x "$WORK/bin/bison" ;;
        *) [ -e "$WORK/bin/$package" ] || cp "$WORK/later/$package" "$WORK/bin" 2>/dev/null || {
               echo '#!/bin/sh' >"$WORK/bin/$package"; chmod +x "$WORK/bin/$package"; } ;;
        esac
    done
    ;;
esac
END
    fake_tool later/pkg-config <<'END'
case $2 in
cairo) test -e "$WORK/later/libcairo2-dev" ;;
pangocairo) test -e "$WORK/later/libpango1.0-dev" ;;
libjpeg) test -e "$WORK/later/libjpeg-dev" ;;
libpng) test -e "$WORK/later/libpng-dev" ;;
epoxy) test -e "$WORK/later/libepoxy-dev" && test -e "$WORK/later/libegl-dev" ;;
mpfr) test -e "$WORK/later/libmpfr-dev" ;;
chafa) test -e "$WORK/later/libchafa-dev" ;;
libedit) test -e "$WORK/later/libedit-dev" ;;
sdl2) test -e "$WORK/later/libsdl2-dev" ;;
yaml-0.1) test -e "$WORK/later/libyaml-dev" ;;
zlib) test -e "$WORK/later/zlib1g-dev" ;;
hdf5) test -e "$WORK/later/libhdf5-dev" ;;
ompi-c) test -e "$WORK/later/libopenmpi-dev" ;;
cmocka) test -e "$WORK/later/libcmocka-dev" ;;
x11) test -e "$WORK/later/libx11-dev" ;;
esac
END
    fake_tool later/python3 <<END
[ "\$1" = -I ] || exec "$python" "\$@"
shift 3
for module; do [ ! -e "\$WORK/later/python3-\$module" ] || echo "\$module"; done
END
    fake_tool later/meson <<'END'
case "$*" in
setup*--reconfigure*) ;;
setup*)
    mkdir -p "$2/meson-info"
    touch "$2/build.ninja"
    build=$(cd "$2" && pwd)
    cat >"$2/meson-info/intro-tests.json" <<JSON
[{"name": "quick", "suite": ["petri:base"], "cmd": ["$build/quick"], "depends": ["quick@exe"]},
 {"name": "slow", "suite": ["petri:view"], "cmd": ["slow.sh", "$build/src/petri"], "depends": ["petri@exe"]},
 {"name": "other", "suite": ["petri:base"], "cmd": ["$build/other"], "depends": ["quick@exe", "other@sta"]},
 {"name": "whole", "suite": ["petri:lint", "petri:thorough"], "cmd": ["whole.sh", "$build"], "depends": []},
 {"name": "prose", "suite": ["petri:text", "petri:thorough"], "cmd": ["prose.py"], "depends": []}]
JSON
    cat >"$2/meson-info/intro-targets.json" <<JSON
[{"id": "quick@exe", "name": "quick", "type": "executable", "filename": ["$build/tests/quick"]},
 {"id": "other@sta", "name": "other", "type": "static library", "filename": ["$build/lib/libother.a"]},
 {"id": "petri@exe", "name": "petri", "type": "executable", "filename": ["$build/src/petri"]},
 {"id": "ranks@exe", "name": "petri-ranks", "type": "executable", "filename": ["$build/src/petri-ranks"]}]
JSON
    ;;
install*)
    prefix=$(cat "$WORK/prefix")
    created=
    [ -d "$prefix/share/petri" ] || created=$prefix/share/petri
    mkdir -p "$3/meson-logs" "$prefix/bin" "$prefix/share/petri"
    echo new >"$prefix/bin/petri"
    echo script >"$prefix/share/petri/my dish.fl"
    printf '# made by Meson\n%s\n' "$prefix/bin/petri" "$prefix/share/petri/my dish.fl" "$created" >"$3/meson-logs/install-log.txt"
    ;;
configure*-Dprefix=*)
    prefix=${3#-Dprefix=}
    echo "$prefix" >"$WORK/prefix"
    ;;
test*)
    mkdir -p build/meson-logs
    cat >build/meson-logs/testlog.txt <<'LOG'
==================================== 1/3 =====================================
test:         petri:base / quick
result:       exit status 77
----------------------------------- stdout -----------------------------------
==================================== 2/3 =====================================
test:         petri:base / other
result:       exit status 0
----------------------------------- stdout -----------------------------------
test: of other
skipped: there is no node
LOG
    echo '1/3 petri:base / quick   OK    0.01s'
    echo '2/3 petri:base / other   OK    0.01s'
    if [ "$BREAKS" = tests ]; then
        echo '3/3 petri:view / slow    FAIL  9.01s   exit status 1'
        printf '>>> the log of slow\n\nOk:                 2   \nFail:               1   \nTimeout:            0   \n'
        exit 1
    fi
    if [ "$BREAKS" = time ]; then
        echo '3/3 petri:view / slow    TIMEOUT  900.01s   killed by signal 15 SIGTERM'
        printf '\nOk:                 2   \nFail:               0   \nTimeout:            1   \n'
        exit 1
    fi
    echo '3/3 petri:view / slow    OK    9.01s'
    printf '\nOk:                 3   \nFail:               0   \nTimeout:            0   \n'
    ;;
esac
END
    fake_tool later/ninja <<'END'
mkdir -p "$2/src"
[ ! -e "$2/src/petri" ] || { echo 'ninja: no work to do.'; exit; }
echo "ninja: Entering directory"
for i in 1 2 3; do echo "[$i/4] Compiling part$i.c"; done
[ "$BREAKS" != compiler ] || { echo 'FAILED: part4.o'; echo 'part4.c:1:1: error: what is this'; exit 1; }
echo '[4/4] Linking petri'
cp "$WORK/later/petri" "$2/src/petri"
END
    fake_tool later/petri <<'END'
case $1 in
run) echo "this is petri $*" ;;
test)
    [ -z "${COLORTERM:-}${LANG:-}${WORK:-}" ] && [ "$(umask)" = 0022 ] || { echo "0 passed, 5 failed" && exit 1; }
    case $2 in
    *golden*) [ ! -e golden-fails ] || { echo "4 passed, 1 failed" && exit 1; } ;;
    esac
    echo "ok a.fl"
    echo "5 passed, 0 failed, 1 script without a test"
    ;;
esac
END
}

# with_sudo all|nothing: creates a fake sudo that allows everything or nothing.
with_sudo() {
    fake_tool bin/sudo <<END
[ $1 = all ] || { echo 'somebody is not in the sudoers file.' >&2; exit 1; }
[ "\$1" != -n ] || shift
FAKE_UID=0
export FAKE_UID
exec "\$@"
END
}

# on_machine COMMAND...: runs a command in the machine's environment.
on_machine() {
    env -i PATH="$work/bin" HOME="$work" WORK="$work" FAKE_UID="$uid" FAKE_GROUPS="$groups" NETWORK="$network" BREAKS="$breaks" "$@"
}
# dev ARGUMENTS...: runs ./dev without a terminal.
dev() {
    : >"$work/calls"
    on_machine sh "$project/dev" "$@" >"$work/out" 2>"$work/err" </dev/null
    status=$?
}
# typed ANSWER ARGUMENTS...: runs ./dev on a terminal of 110 columns and types the answer. The output is in `out`.
script=$(command -v script) || script=
typed() {
    answer=$1
    shift
    : >"$work/calls"
    : >"$work/err"
    (sleep 1; printf '%s\n' "$answer") | on_machine TERM=xterm SHELL=/bin/sh "$script" -qec "stty cols 110 -echo; sh $(quoted "$project/dev") $*" \
        /dev/null >"$work/out" 2>&1
    status=$?
}

# odd COMMAND...: runs a command through .ci/clean-env, in an environment that would affect tests.
odd() {
    (umask 077 && COLORTERM=truecolor LANG=de_DE.UTF-8 CDPATH=. POSIXLY_CORRECT=1 TMPDIR="/no such" TZ=Asia/Tokyo HOME=/proc PETRI_TESTS='' \
        TRIES="a 'b'" PETRI_CPU=scalar "$root/.ci/clean-env" "$@") >out 2>err
    status=$?
}
odd env
check "tests do not see other variables" [ "$(grep -cE '^(COLORTERM|LANG|CDPATH|POSIXLY_CORRECT|TMPDIR)=' out)" -eq 0 ]
check "tests have a fixed locale" has out LC_ALL=C.UTF-8
check "tests have a fixed time zone" has out TZ=UTC
check "variables that select tests are passed" has out "TRIES=a 'b'"
check "variables that Meson sets are passed" has out PETRI_CPU=scalar
odd sh -c 'umask; touch "$HOME/x"; echo "$HOME"; exit 77'
check "the status of a test is passed on" status_is 77
check "tests have umask 022" has out 0022
check "tests may write into their home folder" empty err
check "the home folder is removed" [ ! -e "$(tail -n 1 out)" ]

machine
dev run dish.fl --every 7
check "the first ./dev run succeeds on a new machine" status_is 0
check "run runs the script with its options" has out "this is petri run --show dish.fl --every 7"
check "run reports the number and size of packages" has err "packages: 3 to install, 61 MB to download, 212 MB of disk space"
check "run shows progress of the installation" has err "packages: 3 of 3"
check "run shows progress of the compilation" has err "compiling: 4 of 4"
check "run prints at most 20 lines" lines_at_most err 20
check "run does not ask without a terminal" lacks err "[Y/n]"
check "run installs the compiler" grep -q 'apt-get .*install.* gcc libc6-dev meson ' "$work/calls"
check "run installs libchafa for pictures in terminals" grep -q 'apt-get .*install.* libchafa-dev' "$work/calls"
check "run does not install packages for windows" lacks calls libsdl2-dev
check "run does not install packages for video" lacks calls ffmpeg
check "run does not install packages for tests" lacks calls libcmocka-dev
check "run compiles the programs, not the tests" has calls "ninja -C $project/build src/petri src/petri-pictures"
check "warnings are not errors" lacks calls "--werror"
rm "$project/build/build.ninja"
on_machine CI=true sh "$project/dev" run dish.fl >"$work/out" 2>&1
check "warnings are errors in CI" has calls "meson setup $project/build $project --werror"
dev run dish.fl
check "a second run runs the script" has out "this is petri run --show dish.fl"
check "a second run prints no messages" empty err
check "a second run installs nothing" lacks calls apt-get
check "a second run does not configure" lacks calls "meson"
dev build
check "build installs packages for windows" has calls " libsdl2-dev ffmpeg"
check "build does not install packages again" lacks calls "gcc"
check "build configures again when a library was added" grep -q 'meson setup --reconfigure' "$work/calls"
dev test
check "test installs packages for tests" grep -q ' libcmocka-dev tmux procps .* fonts-dejavu-extra' "$work/calls"
check "test leaves out the slow tests" has calls "--no-suite thorough"
check "test exits with 0 if all tests pass" status_is 0
check "the last line counts tests and scripts" [ "$(tail -n 1 "$work/out")" = "3 passed, 0 failed" ]
mkdir -p "$project/samples" "$project/tests/golden"
dev test
check "the last line includes scripts" [ "$(tail -n 1 "$work/out")" = "13 passed, 0 failed" ]
check "test reports why a test was skipped" has out "skipped: other: there is no node"
check "test reports a test that was skipped without a reason" has out "skipped: quick: no reason given"
check "test names no log if all tests pass" lacks out "to repeat"
dev test --all
check "test --all leaves out no tests" lacks calls "--no-suite thorough"
check "test --all runs all tests and scripts" [ "$(tail -n 1 "$work/out")" = "13 passed, 0 failed" ]
dev test base golden
check "test SUITE finds slow tests" lacks calls "--no-suite thorough"
check "test SUITE runs the tests of the suite" grep -q '^meson test .*--print-errorlogs .* quick other$' "$work/calls"
check "test FOLDER runs the scripts of the folder" has out "scripts in tests/golden"
check "test FOLDER runs no other folder" lacks out "scripts in samples"
dev test samples
check "test FOLDER runs no other tests" lacks calls "--print-errorlogs"
check "test FOLDER counts the scripts of the folder" [ "$(tail -n 1 "$work/out")" = "5 passed, 0 failed" ]
dev test ase
check "test rejects an unknown name" status_is 2
check "test reports the unknown name" has err "no such test or suite: 'ase'"
check "test rejects an unknown name before it compiles" empty calls
dev test quick-lint
check "test rejects an unknown name that consists of parts of others" status_is 2
check "test rejects it before it compiles" [ "$(grep ninja calls)" = "ninja -C $project/build build.ninja" ]
dev test quick
check "test NAME builds only what the test needs" has calls "ninja -C $project/build tests/quick"
check "test NAME builds nothing else" lacks calls "src/petri"
dev test base
check "test SUITE builds what the tests of the suite need" has calls "ninja -C $project/build tests/quick lib/libother.a"
dev test slow
check "test NAME builds petri and the programs that petri starts" has calls "ninja -C $project/build src/petri src/petri-ranks"
dev test lint
check "a test that reads the build folder needs everything" has calls "ninja -C $project/build all"
dev test prose
check "a test of the sources needs nothing" [ "$(grep ninja calls)" = "ninja -C $project/build build.ninja" ]
check "a test of the sources runs" has calls "prose"
dev test golden
check "test FOLDER builds only petri" has calls "ninja -C $project/build src/petri"
check "test FOLDER does not ask for the tests" lacks calls "meson"
touch "$project/golden-fails"
dev test
check "test names a folder with failed scripts" has out "log: build/tests.log; to repeat: ./dev test golden"
check "the log has the results of the scripts" grep -q '^4 passed, 1 failed$' "$project/build/tests.log"
rm "$project/golden-fails"
check "tests are counted while they run" has err "tests: 3 of 3"
breaks=tests
dev test
check "test exits with 1 if a test fails" status_is 1
check "the log of a failed test is shown" has out ">>> the log of slow"
check "test names the log and the command that repeats the failed test" has out "log: build/tests.log; to repeat: ./dev test slow"
breaks=time
dev test
check "test fails if a test takes too long" status_is 1
check "test says that it took too long" has out "timed out after 900.01s, perhaps because the machine was busy: slow; to repeat: ./dev test slow"
check "failures are counted" [ "$(tail -n 1 "$work/out")" = "12 passed, 1 failed" ]

machine
breaks=compiler
dev run dish.fl
check "a compilation error exits with 1" status_is 1
check "a compilation error is shown" has err "part4.c:1:1: error: what is this"
check "successful compiler commands are not shown" lacks err "Compiling part1.c"
check "a compilation error names the log" has err "build/compile.log"
breaks=
dev run dish.fl
check "run continues after the error is fixed" has out "this is petri"

# With CDPATH, cd prints the target of a relative path.
machine
on_machine CDPATH="$work" sh "${project#"$work"/}/dev" run dish.fl >out 2>err </dev/null
status=$?
check "run exits with 0 with CDPATH" status_is 0
check "run runs the script with CDPATH" has out "this is petri"

machine
breaks=count
dev run dish.fl
check "run never counts more packages than there are" lacks err " 4 of 3"
breaks=

machine
uid=1000
dev run dish.fl
check "run without root and sudo exits with 1" status_is 1
check "run without root and sudo gives the reason" has err "you are not root and cannot use sudo"
check "run without root prints the command for an administrator" has err "  apt-get install --no-install-recommends gcc libc6-dev meson"
check "run without root does not call apt-get" lacks calls apt-get
with_sudo nothing
dev run dish.fl
check "run with a refusing sudo prints the command" has err "  apt-get install --no-install-recommends gcc"
check "run with a refusing sudo does not call apt-get" lacks calls apt-get
with_sudo all
dev run dish.fl
check "run uses sudo" has out "this is petri"

machine
network=no
dev run dish.fl
check "run without a network exits with 1" status_is 1
check "run without a network suggests the reason" has err "no network?"
check "run without a network hides the errors of apt-get" lacks err "E: "
check "run without a network prints at most 3 lines" lines_at_most err 3
check "run without a network names the log" has err "build/packages-lists.log"
check "the log contains the errors of apt-get" grep -q 'Unable to locate package meson' "$project/build/packages-lists.log"
touch "$work/lists"
dev run dish.fl
check "run with old lists and no network suggests the reason" has err "no network?"
check "run with old lists and no network names the log" has err "build/packages.log"
network=yes breaks=dpkg
dev run dish.fl
check "other errors of apt-get are shown" has err "E: Sub-process dpkg returned an error code (1)"
check "other errors name the log" has err "build/packages.log"

machine
rm "$work/bin/apt-get"
dev run dish.fl
check "run without a known package manager lists Debian's packages" has err \
    "please install the equivalents of these Debian packages: gcc libc6-dev meson ninja-build"
fake_tool bin/pacman </dev/null
dev run dish.fl
check "run prints the command for pacman" has err \
    "petri needs packages; to install them, run: sudo pacman -S --needed gcc meson ninja pkgconf bison re2c xxhash cairo pango"
check "run does not start pacman" lacks calls pacman
fake_tool bin/dnf </dev/null
dev run dish.fl
check "run prints the command for dnf" has err \
    "run: sudo dnf install gcc glibc-devel meson ninja-build pkgconf-pkg-config bison re2c xxhash-devel cairo-devel pango-devel"
check "run does not start dnf" lacks calls dnf
fake_tool bin/brew <<'END'
[ "$1" != --prefix ] || { echo "$WORK/brew"; exit; }
shift
for package; do
    case $package in
    bison) mkdir -p "$WORK/brew/opt/bison/bin" && { echo '#!/bin/sh' && echo 'echo bison 3.8.2'; } >"$WORK/brew/opt/bison/bin/bison" ;;
    pkgconf) cp "$WORK/later/pkg-config" "$WORK/bin" ;;
    meson | ninja) cp "$WORK/later/$package" "$WORK/bin" ;;
    re2c) { echo '#!/bin/sh'; } >"$WORK/bin/re2c" ;;
    cairo | pango) touch "$WORK/later/lib${package}1.0-dev" "$WORK/later/lib${package}2-dev" ;;
    *) touch "$WORK/later/lib$package-dev" ;;
    esac
done
chmod +x "$WORK"/bin/* "$WORK/brew/opt/bison/bin/bison"
END
{ echo 'echo bison 2.3'; } | fake_tool bin/bison
dev run dish.fl
check "run installs with brew" has calls "brew install meson ninja pkgconf bison re2c xxhash cairo pango"
check "run installs no packages that macOS has" lacks calls "brew install gcc"
check "run compiles after brew" has out "this is petri run --show dish.fl"
dev run dish.fl
check "run does not install bison again" lacks calls " bison"
machine
rm "$work/bin/apt-get"
echo '[ "$1" = --prefix ] || { echo "Error: no formula"; exit 1; }' | fake_tool bin/brew
dev run dish.fl
check "run shows errors of brew" has err "Error: no formula"

machine
mkdir -p "$project/src/packaging"
fake_tool "${project#"$work"/}/src/packaging/package.sh" </dev/null
dev package
check "package makes packages" has calls "package.sh $project/build/package"
check "package installs the packaging tools" grep -q 'apt-get .*install.* dpkg-dev debhelper dh-python' calls
check "package installs the build dependencies" has calls libsdl2-dev
check "package installs what only packages need" eval 'has calls libopenmpi-dev && has calls build-essential'
check "package reports the folder" has err "packages are in $project/build/package"

# Python modules are not known to pkg-config.
machine
dev build
check "build builds all programs" has calls "ninja -C $project/build programs lib/session/libpetri.a"
dev package --wheel
check "package --wheel installs Python modules" has calls " python3-build python3-cffi"
check "package --wheel configures again after an installation" has calls "meson setup --reconfigure"
dev package --wheel
check "a second package --wheel does not configure" lacks calls meson
rm "$work/later/python3-wheel"
touch "$work/later/python3-yaml"
on_machine sh -c 'cd "$1" && . .ci/progress.sh && . .ci/packages.sh && has_module yaml cffi && ! has_module yaml wheel' - "$project"
status=$?
check "modules are found" status_is 0

machine
for arguments in 'run' 'test --foo' 'test --all quick' 'build x' 'install /a /b' 'install --prefix' 'package --dynamic' 'package --wheel --test' \
    'dist x' 'dist --wheel' 'sanitize --address' 'fuzz --minutes' 'fuzz --minutes x' 'fuzz --minutes 1 --seconds 1' 'fuzz nosuch' 'mutate nosuch' \
    'mutate --count x' 'coverage x' 'format --chek' 'tidy --depe' 'maths x' 'maths 0' 'crash-test 1 2' 'hashes x' 'gallery x' 'web --serve x' \
    'web 8080' 'figures x' 'clean-install --user' 'setup some' 'help nosuch' 'completion x' 'nosuch' 'test nosuch' 'test quick nosuch' \
    'uninstall a b'; do
    # shellcheck disable=SC2086 # arguments are words
    dev $arguments
    check "'$arguments' is rejected" eval 'status_is 2 && has err "dev: " && has err "usage: ./dev " && empty out && empty calls'
done
for subcommand in $(sed -n "/<<'END'/,/^END/s/^\([a-z][a-z-]*\)[ :].*/\1/p" "$project/.ci/commands.sh"); do
    dev "$subcommand" --help
    check "'$subcommand --help' prints the usage" eval 'status_is 0 && has out "usage: ./dev $subcommand" && empty err && empty calls'
done
dev run dish.fl --help
check "'run FILE --help' prints the usage" has out "usage: ./dev run"
dev help web
check "'help SUBCOMMAND' prints the usage" has out "usage: ./dev web"
dev
check "without arguments, the overview is printed" eval 'status_is 2 && has err "  crash-test [COUNT]"'
dev help
check "help prints the overview" eval 'status_is 0 && has out "  crash-test [COUNT]"'
# completed WORD...: prints the completions of the last word.
completed() {
    bash -c "$(cat completion)"'; COMP_WORDS=("$@") COMP_CWORD=$(($# - 1)); _petri_dev; echo "${COMPREPLY[*]}"' -- "$@"
}
dev completion
cp out completion
check "subcommands are completed" [ "$(completed ./dev un)" = uninstall ]
check "options are completed" [ "$(completed ./dev package --ma)" = --manylinux ]
check "words are completed" [ "$(completed ./dev setup a)" = all ]

machine
dev install "$work/some where"
check "install compiles first" grep -q 'ninja .* installed' "$work/calls"
check "install uses the given prefix" has calls "meson configure $project/build -Dprefix=$work/some where"
mkdir -p "$work/other/bin"
dev install "$work/other"
dev uninstall "$work/some where"
check "uninstall removes the files" eval 'status_is 0 && has err "removed 2 files from $work/some where"'
check "uninstall removes the folder that install created" [ ! -e "$work/some where/share/petri" ]
check "uninstall installs and compiles nothing" empty calls
dev uninstall "$work/some where"
check "uninstall reports that nothing is installed" eval 'status_is 1 && has err "nothing to uninstall"'
echo changed >>"$work/other/share/petri/my dish.fl"
echo mine >"$work/other/bin/mine"
dev uninstall "$work/other"
check "uninstall keeps changed files" eval 'has err "  $work/other/share/petri/my dish.fl" && exists "$work/other/share/petri/my dish.fl"'
check "uninstall keeps other files" exists "$work/other/bin/mine"
check "uninstall removes the program" [ ! -e "$work/other/bin/petri" ]
mkdir -p "$work/old/share/petri" "$work/old/bin"
echo old | tee "$work/old/bin/petri-old" | cksum | sed 's|$| bin/petri-old|' >"$work/old/share/petri/installed.txt"
dev install "$work/old"
dev uninstall "$work/old"
check "uninstall removes files of earlier versions" [ ! -e "$work/old/bin/petri-old" ]
check "uninstall keeps folders that existed before" exists "$work/old/share/petri"
dev install "$work/some where"
check "install uses meson" has calls "meson install -C $project/build --no-rebuild"
check "install prints the line that extends PATH" has err "  export PATH=\"\$HOME/some where/bin:\$PATH\""
dev install
check "install by root uses /usr/local" has calls "-Dprefix=/usr/local"
uid=1000
dev install
check "install by a user uses ~/.local" has calls "-Dprefix=$work/.local"
check "install prints no MANPATH if none is set" lacks err MANPATH
# installed SHELL PROFILE: checks that the printed lines work in this shell and, through PROFILE, in new shells.
installed() {
    rm -f "$work/$2"
    on_machine SHELL="/bin/$1" MANPATH=/man sh "$project/dev" install >out 2>err </dev/null
    grep '^  ' err >typed
    on_machine MANPATH=/man sh -c '. ./typed && echo "$PATH $MANPATH"' >now 2>&1
    on_machine MANPATH=/man sh -c ". ~/$2; echo \"\$PATH \$MANPATH\"" >next 2>&1
    grep -qxF "$work/.local/bin:$work/bin $work/.local/share/man:/man" now && cmp now next
}
check "bash finds petri and its manual" installed bash .bashrc
check "zsh finds petri and its manual" installed zsh .zshrc
check "another shell finds petri and its manual" installed dash .profile
on_machine SHELL=/usr/bin/fish sh "$project/dev" install >out 2>err </dev/null
check "install prints the command for fish" has err '  fish_add_path "$HOME/.local/bin"'
on_machine PATH="$work/.local/bin:$work/bin" sh "$project/dev" install >out 2>err </dev/null
check "install prints no line if petri is already in PATH" lacks err "PATH"

machine
for tool in bash dirname mktemp unshare git; do
    rm -f "$work/bin/$tool"
    ln -s "$(PATH=/usr/bin:/bin env which $tool)" "$work/bin/$tool"
done
uid=1000
dev clean-install
check "clean-install without root exits with 77" status_is 77
check "clean-install without root gives the reason" has err "not possible here: root is required"
uid=0
dev clean-install
check "clean-install installs debootstrap" grep -q 'apt-get .* install debootstrap' "$work/calls"
check "clean-install outside a checkout exits with 77" status_is 77
check "clean-install outside a checkout gives the reason" has err "not possible here: not a git checkout"
(cd "$project" && git init -q && git -c user.name=x -c user.email=x@y commit -q --allow-empty -m x)
echo 'exit 1' | fake_tool bin/unshare
dev clean-install
check "clean-install without namespaces exits with 77" status_is 77
check "clean-install without namespaces gives the reason" has err "not possible here: no namespaces"
check "clean-install leaves no files behind" [ -z "$(find /var/tmp -maxdepth 1 -name 'petri-clean-run-*' -newer "$work/bin/unshare")" ]

# Minimal containers have no pseudo-terminals.
if [ -n "$script" ] && "$script" -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    machine
    typed y run dish.fl
    check "run asks on a terminal" has out "[Y/n]"
    check "run prints a line before it reads sizes" has out "dev: packages are missing; reading their sizes"
    check "run asks only once" count_is out "[Y/n]" 1
    check "run names the packages" has out "gcc libc6-dev meson ninja-build"
    check "run estimates sizes without package lists" has out \
        "petri needs 20 Debian packages (about 204 with dependencies, 155 MB to download, 600 MB of disk space,"
    check "run estimates the time" has out "3 minutes): gcc"
    check "run prints the size of the packages for tests" has out "more (about 327 with "
    check "run announces that later commands do not ask" has out "Later commands install what they need without asking again"
    check "run continues after yes" has out "this is petri run --show dish.fl"
    erase=$(printf '\r\033[K')
    check "packages are counted on one line" has out "${erase}dev: packages: 2 of 3, setting up part2${erase}"
    check "compiled files are counted on one line" has out "${erase}dev: compiling: 2 of 4${erase}dev: compiling: 3 of 4${erase}"
    typed n test
    check "test does not ask again" lacks out "[Y/n]"
    check "test installs its packages" grep -q 'apt-get .* install .*libcmocka-dev' "$work/calls"
    check "the progress line names the slowest test" has out "${erase}dev: tests: 2 of 3, slow${erase}"
    machine
    typed n run dish.fl
    check "run exits with 1 after no" status_is 1
    check "run prints the command to install packages after no" has out "apt-get install --no-install-recommends gcc"
    check "run installs nothing after no" lacks calls "apt-get -qy update"
    touch "$work/lists"
    uid=1000 groups='users sudo'
    with_sudo all
    typed n run dish.fl
    check "run reads sizes from the package lists" has out "packages (3 with dependencies, 61 MB to download, 212 MB of disk space,"
    check "run reads package lists without sudo" lacks calls sudo
    with_sudo nothing
    groups=users
    typed y run dish.fl
    check "a user without sudo is not asked" lacks out "[Y/n]"
    check "a user without sudo gets the command" has out "  apt-get install --no-install-recommends gcc"
    uid=0
    typed '' run dish.fl
    check "run asks again after no, and Enter means yes" has out "this is petri"
    "$root/.ci/hostile" 'tty; echo "$COLORTERM $LANG"; umask; printf "1 of 2\r\033[K2 of 2\n"; exit 3' >out 2>&1
    status=$?
    check "hostile exits with the command's status" status_is 3
    check "hostile provides a terminal with odd settings" has out "truecolor de_DE.UTF-8"
    check "hostile shows each line in its final state" [ "$(tail -n 2 out | tr '\n' ' ')" = "0077 2 of 2 " ]
else
    echo "skipped: questions: there are no pseudo-terminals"
fi
finish
