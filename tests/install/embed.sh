# embed.sh: tests of programs that embed petri, built against `prefix` with pkg-config and CMake. Sourced by run.sh.
# shellcheck shell=sh disable=SC2154 # check.sh and run.sh set them
printf '#include <petri.h>\n#include <stdio.h>\nint main(void) {\n    return puts(petri_version()) < 0;\n}\n' >app.c
ln -s "$prefix" moved
PKG_CONFIG_PATH=$(dirname "$(find moved/ -name petri.pc)")
export PKG_CONFIG_PATH
sed -i "s|^prefix=.*|prefix=$work/moved|" "$PKG_CONFIG_PATH"/petri*.pc # adapts the prefix to the moved installation
# shellcheck disable=SC2046 # options are words
cc app.c -o app $(pkg-config --cflags --libs petri) >out 2>&1
check "a program with libpetri links" [ $? -eq 0 ]
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH") # because the library is not in a standard folder
export LD_LIBRARY_PATH
version=$("$prefix/bin/petri" --version | sed 's/petri //')
series=${version%.*}
check "a program with libpetri runs" [ "$(./app)" = "$version" ]
LC_ALL=C readelf -d app >out
check "a program with libpetri uses the shared library" has out "Shared library: [libpetri.so.$series]"
# shellcheck disable=SC2046 # options are words
cc app.c -o app_static $(pkg-config --cflags petri) -L"$LD_LIBRARY_PATH" -l:libpetri.a -lm -lpthread >out 2>&1
check "a program with the static libpetri links" [ $? -eq 0 ]
check "a program with the static libpetri runs without other libraries" [ "$(env -u LD_LIBRARY_PATH ./app_static)" = "$version" ]
# The samples, compiled as their first lines say.
embed="$prefix/share/petri/samples/embed"
# shellcheck disable=SC2046 # options are words
cc -std=c11 -Wall -Wextra -Werror "$embed/speed.c" -o speed $(pkg-config --cflags --libs petri) -lm >out 2>&1
check "the sample in C compiles" [ $? -eq 0 ]
./speed >out 2>&1
check "the sample in C runs" [ $? -eq 0 ]
check "the sample in C moves its particles" [ "$(grep -c -e '^  0: 1000 particles, age 0, mean speed 0.00$' \
    -e '^120: 1000 particles, age 2, mean speed [1-9][0-9]*\.[0-9][0-9]$' out)" -eq 2 ]
if command -v c++ >/dev/null; then
    # shellcheck disable=SC2046 # options are words
    c++ -std=c++17 -Wall -Wextra -Werror "$embed/steer.cpp" -o steer $(pkg-config --cflags --libs petri) >out 2>&1
    check "the sample in C++ compiles" [ $? -eq 0 ]
    check "the sample in C++ steers its particles" [ "$(./steer 2>&1 | tail -n 1)" = "240:  -0.333  25.463" ]
else
    echo "skipped: the sample in C++: no compiler"
fi
pkg-config --libs petri >out
check "linking libpetri needs no drawing libraries" [ "$(grep -c -e pango -e cairo -e jpeg -e draw out)" -eq 0 ]
# draws SCRIPT OUT.png: saves the picture of the third frame. Exits with 2 if this build cannot draw.
cat >draws.c <<'EOF'
#include <petri-draw.h>
int main(int argc, char **argv) {
    PetriOptions options = petri_default_options();
    PetriPictureOptions wanted = petri_default_picture_options();
    PetriSession *session = petri_open(&options);
    PetriPainter *painter = petri_painter_open();
    PetriPicture *picture;
    if (argc != 3 || petri_load(session, argv[1]) != PETRI_OK)
        return 1;
    for (int frame = 0; frame < 3; frame++)
        if (petri_step(session) != PETRI_OK)
            return 1;
    if (petri_picture(session, &wanted, &picture) != PETRI_OK)
        return 1;
    PetriStatus status = petri_picture_save(picture, painter, argv[2]);
    return status == PETRI_UNSUPPORTED ? 2 : status != PETRI_OK;
}
EOF
dish="$prefix/share/petri/samples/petri.fl"
[ "$2" != draws ] || "$prefix/bin/petri" render "$dish" -o wanted.png --frames 1 --quiet
# as_rendered PROGRAM draws|none: succeeds if PROGRAM saves the picture that `petri render` saves, or reports that this
# build cannot draw.
as_rendered() {
    rm -f drawn.png
    "$1" "$dish" drawn.png >out 2>&1
    status=$?
    if [ "$2" = draws ]; then cmp drawn.png wanted.png; else [ $status -eq 2 ]; fi
}
# shellcheck disable=SC2046 # options are words
cc draws.c -o draws $(pkg-config --cflags --libs petri-draw) >out 2>&1
check "a program with libpetri-draw links" [ $? -eq 0 ]
check "a program with libpetri-draw draws like petri" as_rendered ./draws "$2"
LC_ALL=C readelf -d draws | grep -o '\[libpetri.*' | sort | xargs >out
check "a program with libpetri-draw uses both shared libraries" [ "$(cat out)" = "[libpetri-draw.so.$series] [libpetri.so.$series]" ]
LC_ALL=C readelf -V "$LD_LIBRARY_PATH/libpetri-draw.so" >out
check "libpetri-draw needs the libpetri of its release" has out "PETRI_PRIVATE_$version"
# shellcheck disable=SC2046 # options are words
cc draws.c -o draws_static $(pkg-config --cflags --static --libs petri-draw |
    sed -e 's/-lpetri-draw/-l:libpetri-draw.a/' -e 's/-lpetri /-l:libpetri.a /') >out 2>&1
check "a program with the static libpetri-draw and libpetri links" [ $? -eq 0 ]
check "a program with the static libraries draws like petri" as_rendered ./draws_static "$2"
# Records ten frames, then replays them. Exits with 2 if this build has no SQLite.
cat >archives.c <<'EOF'
#include <petri-archive.h>
#include <petri-inspect.h>
#include <stdio.h>
#include <string.h>
int main(int argc, char **argv) {
    uint8_t recorded[16] = {1}, computed[16] = {0};
    PetriOptions options = petri_default_options();
    PetriSession *session = petri_open(&options);
    PetriArchive *archive = argc == 3 ? petri_archive_create(session, argv[2], NULL) : NULL;
    if (petri_archive_problem(archive))
        return puts(petri_archive_problem(archive)), 2;
    if (!archive || petri_load(session, argv[1]) != PETRI_OK)
        return 1;
    for (int frame = 0; frame < 10; frame++)
        if (petri_step(session) != PETRI_OK)
            return 1;
    if (petri_archive_complete(archive) != PETRI_OK)
        return 1;
    petri_archive_close(&archive);
    petri_close(&session);
    archive = petri_archive_open(argv[2], 0);
    options.read_file = petri_archive_read;
    options.read_user_data = archive;
    session = petri_open(&options);
    if (petri_archive_check(archive) != PETRI_OK || petri_archive_replay(archive, session, 9) != PETRI_OK)
        return 1;
    bool same = petri_archive_digest(archive, 9, recorded) && petri_digest(session, computed) == PETRI_OK &&
                memcmp(recorded, computed, sizeof recorded) == 0;
    petri_close(&session);
    petri_archive_close(&archive);
    return !same;
}
EOF
# archives PROGRAM: succeeds if PROGRAM replays its archive and petri verifies it, or if this build has no SQLite.
archives() {
    rm -f own.petri
    "$1" "$dish" own.petri >out 2>&1
    status=$?
    if [ $status -eq 2 ]; then has out "built without SQLite"; else
        [ $status -eq 0 ] && "$prefix/bin/petri" archive verify own.petri | grep -q '^verified: 10 of 10 frames'
    fi
}
# shellcheck disable=SC2046 # options are words
cc archives.c -o archives $(pkg-config --cflags --libs petri-archive) >out 2>&1
check "a program with libpetri-archive links" [ $? -eq 0 ]
check "a program with libpetri-archive records and replays" archives ./archives
LC_ALL=C readelf -d archives | grep -o '\[lib\(petri\|sqlite\).*' | sort | xargs >out
check "a program with libpetri-archive uses both shared libraries" [ "$(cat out)" = "[libpetri-archive.so.$series] [libpetri.so.$series]" ]
# shellcheck disable=SC2046 # options are words
cc archives.c -o archives_static $(pkg-config --cflags --static --libs petri-archive |
    sed -e 's/-lpetri-archive/-l:libpetri-archive.a/' -e 's/-lpetri /-l:libpetri.a /') >out 2>&1
check "a program with the static libpetri-archive and libpetri links" [ $? -eq 0 ]
check "a program with the static libraries records and replays" archives ./archives_static
if command -v cmake >/dev/null; then
    cat >CMakeLists.txt <<EOF
cmake_minimum_required(VERSION 3.16)
project(app C)
find_package(petri $series REQUIRED)
add_executable(app app.c)
target_link_libraries(app petri::petri)
add_executable(draws draws.c)
target_link_libraries(draws petri::draw)
add_executable(archives archives.c)
target_link_libraries(archives petri::archive)
EOF
    { cmake -S . -B cmake -DCMAKE_PREFIX_PATH="$prefix" && cmake --build cmake; } >out 2>&1
    check "CMake builds programs with libpetri and libpetri-draw" [ $? -eq 0 ]
    check "the program that CMake built runs" [ "$(env -u LD_LIBRARY_PATH cmake/app)" = "$version" ]
    check "the program that CMake built draws like petri" as_rendered ./cmake/draws "$2"
    check "the program that CMake built records and replays" archives ./cmake/archives
    sed -i "s/petri $series/petri 0.2/" CMakeLists.txt
    cmake -S . -B cmake >out 2>&1
    check "CMake rejects another minor version" has out 'requested version "0.2"'
else
    echo "skipped: CMake is not installed"
fi
