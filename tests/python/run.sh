#!/bin/sh
# run.sh PETRI [PYTHON WHEEL]: runs the tests of the Python module and the examples of its tutorial, with the module in
# the wheel in the folder WHEEL.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=${here%/tests/*}
[ $# -eq 3 ] || {
    echo "skipped: no module was built, for there is no Python with build, cffi, numpy and setuptools"
    exit 77
}
PETRI=$1
PATH=$(cd "$(dirname "$PETRI")" && pwd):$PATH # petri.sweep starts petri
export PETRI PATH
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$2" -m zipfile -e "$3"/petri-*.whl "$scratch"
for holder in 'petri authors' 'Yann Collet'; do
    find "$scratch" -name 'LICENSE*' -exec cat {} + | grep -q "$holder" || {
        echo "the wheel has no licence of $holder"
        exit 1
    }
done
PYTHONPATH=$scratch
PYTHONDONTWRITEBYTECODE=1
export PYTHONPATH PYTHONDONTWRITEBYTECODE
"$2" "$here/test_petri.py"
"$2" "$here/test_lexer.py" "$root/samples"
cd "$root/samples" # the tutorial uses these scripts
"$2" -m doctest "$root/src/python/TUTORIAL.md"
# Jupyter stores files in the home folder.
HOME=$scratch "$2" "$here/notebooks.py" "$root"/samples/notebooks/*.ipynb
"$2" "$root/tests/bench/python.py" petri.fl 1
