#!/bin/sh
# run.sh BUILD draws|none SANITIZERS: tests an installation of BUILD that was moved to another folder: the command, its
# helper programs, its hints, the library, the manual and the completions.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
build=$(cd "$1" && pwd)
scratch
SHELL=/bin/sh # shell of `script`
export SHELL
helps() { "$1" help 2>&1 | tee out | grep -q 'usage: petri'; }

DESTDIR=$work/made meson install -C "$build" --no-rebuild >log 2>&1
check "meson install succeeds" [ $? -eq 0 ]
binary=$(find made -path '*/bin/petri')
[ -n "$binary" ] || { cat log; echo "FAIL nothing is installed"; exit 1; }
mkdir "with blanks"
mv "$(dirname "$(dirname "$binary")")" "with blanks/prefix"
prefix="$work/with blanks/prefix"
check "a moved petri runs scripts" sh -c "'$prefix/bin/petri' run --frames 1 '$prefix/share/petri/samples/hello.fl' >out 2>&1"
check "a moved petri finds petri-pictures" helps "$prefix/bin/petri"
mkdir links
ln -s "$prefix/bin/petri" links/dish
check "petri finds petri-pictures if it is called through a link" helps links/dish
check "only petri is installed in bin" [ "$(ls "$prefix/bin")" = petri ]

mkdir lone
cp "$prefix/bin/petri" lone
check "a copy of petri alone runs scripts" lone/petri run --frames 1 "$prefix/share/petri/samples/petri.fl"
lone/petri view x.fl >out 2>&1
check "a copy of petri alone cannot show scripts" [ $? -eq 1 ]
check "the message names petri-pictures" has out petri-pictures
check "the message names the folder of the copy" has out "$work/lone/"
check "the message names the libexec folder" has out "$work/libexec"
check "the message is one line" [ "$(wc -l <out)" -eq 1 ]

# hint PATH [NAME=VALUE]: prints the command that the hint proposes for saving a picture, if petri is started as PATH in
# a terminal.
hint() {
    env ${2:+"$2"} TERM=dumb script -qec "'$1' run --frames 2 dish.fl" /dev/null 2>/dev/null </dev/null |
        tr -d '\r' | tee out | sed -n 's/.*to save a picture: \(.*\) (or OUT.mp4)/\1/p'
}
sh_works() { rm -f OUT.png && sh -c "$1" >out 2>&1 && [ -s OUT.png ]; }
# Minimal containers have no pseudo-terminals.
if [ "$2" = draws ] && script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    cp "$prefix/share/petri/samples/petri.fl" dish.fl
    mkdir -p build/src
    cp "$build/src/petri" "$build/src/petri-pictures" build/src
    ln -s src/petri build/petri
    for way in build/petri ./build/petri "$work/build/petri" "$prefix/bin/petri" links/dish; do
        check "the hint for $way works" sh_works "$(hint "$way")"
    done
    check "the hint for a build folder is a relative path" [ "$(hint "$work/build/petri")" = "build/petri render dish.fl -o OUT.png" ]
    cd build/src || exit 1
    cp ../../dish.fl .
    check "the hint in the folder of the program is a relative path" [ "$(hint "$work/build/src/petri")" = "./petri render dish.fl -o OUT.png" ]
    cd "$work" || exit 1
    PATH="$prefix/bin:$PATH"
    check "the hint for an installed petri is its name" [ "$(hint petri)" = "petri render dish.fl -o OUT.png" ]
    check "the hint for an installed petri works" sh_works "$(hint petri)"
    cp dish.fl "it's a dish.fl"
    script -qec "petri run --frames 1 \"it's a dish.fl\"" /dev/null </dev/null 2>/dev/null | tr -d '\r' >out
    check "the script's name is quoted" has out "petri view 'it'\\''s a dish.fl'"
else
    echo "skipped: the hints: petri does not draw or there are no pseudo-terminals"
fi

# Embedding is not tested with sanitizers, because the programs would need the sanitizers' libraries.
if [ "$3" = none ] && command -v cc >/dev/null; then
    # shellcheck source=tests/install/embed.sh
    . "$here/embed.sh"
fi
# shellcheck source=tests/install/manual.sh
. "$here/manual.sh"
finish
