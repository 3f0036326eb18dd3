#!/bin/sh
# install.sh: installs the files of all outputs; conda-build selects those of each.
set -eu
meson install -C build --no-rebuild
