#!/usr/bin/env bash
# unchanged_entries.sh FILE… <CHANGED: prints the CTest entries that the changed files do not affect. FILEs have lines
# "ENTRY PATH…": an entry is affected if the path of a changed file begins with one of these.
set -euo pipefail
changed=$(cat)
while read -r entry paths; do
    for path in $paths; do
        ! grep -q "^${path//./\\.}" <<<"$changed" || continue 2
    done
    echo "$entry"
done < <(cat "$@")
