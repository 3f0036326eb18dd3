#!/bin/sh
# check_identity.sh SOURCE_ROOT: names of people and hosts are in src/packaging/identity.ini only and in the files that
# hosts.sh writes, which are up to date; LICENSE names the same authors, templates contain only names that fill.sh knows,
# and no text tells people to get petri from a registry, where
# the name may belong to another project.
set -eu
cd "$1"
identity=src/packaging/identity.ini
bad=0
registries='npx|npm (install|i|add)|yarn add|pnpm add|pipx? install|(brew|conda|mamba|apt|apt-get|dnf|cargo) (install|add)|ext install|docker pull'
value() { sed -n "s/^$1 = //p" $identity; }
git rev-parse --git-dir >/dev/null 2>&1 || {
    echo "skipped: not a git checkout"
    exit 77
}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
values=$scratch/values
sed -n 's/^[a-z_]* = \(.*[^0-9].*\)/\1/p' $identity | sort -u >"$values"
src/packaging/hosts.sh "$scratch/hosts"
written=$(cd "$scratch/hosts" && find . -type f | sed 's|^\./||')
for file in $written; do
    cmp "$scratch/hosts/$file" "$file" || {
        echo "$file is not what hosts/$file, $identity and the version give; run src/packaging/hosts.sh"
        bad=1
    }
done
# shellcheck disable=SC2046 # names of files without spaces
if git grep --untracked -niF -f "$values" -- . ":!$identity" ':!LICENSE' $(printf ' :!%s' $written); then
    echo "these names belong in $identity only; write @NAME@ instead, and print the file with src/packaging/fill.sh"
    bad=1
fi
if git grep --untracked -nP "\\b($registries) +(-\\S+ +)*(lib|python3-)?petri(?![\\w./-])" -- . ':!tests/lint/check_identity.sh'; then
    echo "petri is in no registry; name a file, or a command of dev that makes one"
    bad=1
fi
grep -qi "^Copyright (c) [0-9]* $(value authors)\$" LICENSE || {
    echo "LICENSE does not name '$(value authors)', the authors in $identity"
    bad=1
}
for template in $(git grep --untracked -lE '@(AUTHORS|EMAIL|HOMEPAGE|REPOSITORY|VERSION|APP_ID|NPM)@' -- src ':!*.sh' ':!*.cmake.in' ':!*meson.build'); do
    src/packaging/fill.sh "$template" YEAR=x DATE=x SHA256=x >/dev/null || bad=1
done
exit $bad
