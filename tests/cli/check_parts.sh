#!/bin/sh
# check_parts.sh PART...: checks that these are all parts of run.sh, which meson.build lists.
set -eu
cd "$(dirname "$0")"
for file in *.sh; do
    case $file in
    run.sh | check_corpora.sh | check_parts.sh) continue ;;
    esac
    case " $* " in
    *" ${file%.sh} "*) ;;
    *)
        echo "tests/cli/meson.build does not list '${file%.sh}' in cli_parts"
        exit 1
        ;;
    esac
done
