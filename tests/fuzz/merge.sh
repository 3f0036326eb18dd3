#!/bin/sh
# merge.sh BUILD SOURCE NAME...: replaces corpus/NAME by a minimal set of the inputs that it and BUILD/fuzz/NAME (from
# `./dev fuzz`) contain. The set covers code that the seeds do not cover. It has at most 16 kB and short inputs first.
set -eu
build=$(cd "$1" && pwd) source=$(cd "$2" && pwd)
shift 2
folder=$(mktemp -d "${TMPDIR:-/tmp}/petri-merge-XXXXXX")
trap 'rm -rf "$folder"' EXIT
for name; do
    corpus=$source/tests/fuzz/corpus/$name
    mkdir -p "$folder/seeds" "$folder/found" "$corpus"
    "$source/tests/fuzz/seeds.sh" "$build" "$source" "$folder/seeds"
    ls "$folder/seeds/$name" >"$folder/list"
    find "$build/fuzz/$name" "$corpus" -type f -size -3k -exec cp {} "$folder/found" \;
    # Only edges count, not how often they are taken.
    "$build/tests/fuzz/fuzz_$name" -set_cover_merge=1 -use_counters=0 -timeout=10 -close_fd_mask=3 "$folder/seeds/$name" \
        "$folder/found" >"$folder/log" 2>&1
    (cd "$folder/seeds/$name" && xargs rm -f <"$folder/list")
    rm -f "$corpus"/*
    total=0
    find "$folder/seeds/$name" -type f -printf '%s %f\n' | sort -n | while read -r size input; do
        total=$((total + size))
        [ $total -gt 16000 ] || cp "$folder/seeds/$name/$input" "$corpus/$(echo "$input" | cut -c -12)"
    done
    echo "$name: $(find "$corpus" -type f | wc -l) inputs"
    rm -rf "$folder/seeds" "$folder/found"
done
