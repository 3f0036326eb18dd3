#!/bin/sh
# check_commits.sh SOURCE_ROOT: checks that commit subjects have the form "area: verb ...", in the imperative, and at
# most 72 characters. Checks the commits after `first`, except merges. Skipped if the history does not contain `first`.
set -eu
cd "$1"
first=8441aeef8bb59b615e4b640e179c9642774eb1eb
git rev-parse --is-inside-work-tree >/dev/null 2>&1 && git cat-file -e "$first" 2>/dev/null || {
    echo "skipped: no git history"
    exit 77
}
# The verb is the first word after the areas. With exceptions, a word that ends with -ed, -ing or -s is not an
# imperative.
git log --no-merges --format='%h %s' "$first..HEAD" | LC_ALL=C.UTF-8 awk '
    {
        hash = $1
        subject = substr($0, length(hash) + 2)
        text = subject
        sub(/^([A-Za-z0-9_.\/ -]+, )*[A-Za-z0-9_.\/-]+: /, "", text)
        verb = tolower(text)
        sub(/[^a-z-].*/, "", verb)
        if (length(subject) > 72)
            wrong = length(subject) " characters, at most 72"
        else if (subject ~ /\.$/)
            wrong = "a full stop at the end"
        else if (verb == "" || (verb ~ /(ed|ing|s)$/ && verb !~ /^(embed|feed|need|seed|speed|bring|string|address|bypass|compress|cross|discuss|express|focus|pass|press|process|stress|suppress)$/))
            wrong = "not imperative"
        else
            next
        print hash ": " wrong ": " subject
        bad = 1
    }
    END { exit bad }'
