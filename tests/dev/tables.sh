#!/bin/sh
# tables.sh: compares the tables of ./dev with the files that they must agree with: packages, tests, subcommands.
# usage: tables.sh INTRO-TESTS, Meson's list of tests (build/meson-info/intro-tests.json)
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
tests=$1
scratch
for file in progress commands packages tests; do
    # shellcheck source=/dev/null
    . "$root/.ci/$file.sh"
done
# packages_in NEEDS: prints the packages of the list, one a line.
packages_in() { echo "$1" | sed -n 's/.*: *//p' | tr -s ' ' '\n' | sed '/^$/d' | sort -u; }
# first_is_in_second A B: prints the lines of A that B lacks. Returns true if there are none.
first_is_in_second() {
    grep -vxF -f "$2" "$1" >missing
    sed 's/^/  missing: /' missing
    empty missing
}

sed -n '/^Build-Depends:/,/^$/s/^ \([a-z0-9.+-]*\).*/\1/p' "$root/src/packaging/debian/control" |
    sed 's/^debhelper-compat$/debhelper/' | sort >build_depends
echo build-essential >>build_depends # each Debian package needs it
packages_in "$BUILD_NEEDS
$PYTHON_NEEDS
$PACKAGE_NEEDS" >package_needs
check "Build-Depends is found" [ "$(wc -l <build_depends)" -gt 15 ]
check "./dev package installs Build-Depends" first_is_in_second build_depends package_needs
# build-essential needs libc6-dev.
packages_in "$BUILD_NEEDS" | grep -e '^lib.*-dev$' -e '^zlib' | grep -vx libc6-dev >libraries
check "Build-Depends has all libraries that ./dev build installs" first_is_in_second libraries build_depends
sed -n "/^foreach name, row/,/^}/s/^ .*, '\([^']*\)'\],\$/\1/p" "$root/meson.build" | tr ' ' '\n' | sort >optional
check "meson.build's optional libraries are found" [ "$(wc -l <optional)" -gt 10 ]
check "Build-Depends has all optional libraries of meson.build" first_is_in_second optional build_depends
# Open MPI has several names for pkg-config.
sed -n "/^foreach name, row/,/^}/s/^  '[a-z]*': \['[a-z0-9]*', '\([^']*\)'.*/\1/p" "$root/meson.build" |
    sed 's/^mpi$/ompi-c/' >names
echo "$OPTIONAL_LIBRARIES" | tr ' ' '\n' >watched
check "./dev configures again if an optional library of meson.build was installed" first_is_in_second names watched

python3 -c "import json, sys
for test in json.load(open(sys.argv[1])):
    print(test['name'], *[suite.split(':')[1] for suite in test['suite']])" "$tests" | tr ' ' '\n' | sort -u >names
check "Meson's list of tests is found" [ "$(wc -l <names)" -gt 100 ]
# shellcheck disable=SC2046 # names are words
unlikely_names $(cat names) golden conformance samples >rejected
check "./dev test accepts each test, suite and folder" empty rejected
check "./dev test rejects other names" [ "$(unlikely_names nosuch test_nosuch --list '' | wc -l)" -eq 4 ]

commands | sed -n 's/^\([a-z][a-z-]*\)[ :].*/\1/p' >subcommands
# shellcheck disable=SC2016 # the dollar is in dev
{ echo help && sed -n '/^case \$subcommand in$/,/^esac$/s/^\([a-z-]*\)).*/\1/p' "$root/dev"; } >implemented
check "each subcommand is implemented" first_is_in_second subcommands implemented
check "each implemented subcommand is in the table" first_is_in_second implemented subcommands
sed -n 's/^| `\.\/dev \([a-z-]*\).*/\1/p' "$root/CONTRIBUTING.md" >described
check "CONTRIBUTING.md describes each subcommand" first_is_in_second subcommands described
while read -r subcommand; do
    synopsis "$subcommand" | tr -s '[]| ' '\n' | grep '^--' >options
    usage "$subcommand" | sed -n 's/^  \(--[a-z-]*\) .*/\1/p' >rows
    check "the usage of $subcommand describes its options" cmp options rows
done <subcommands
check "lines of the table fit in 120 columns" eval '! commands | grep -E "^.{121}"'
finish
