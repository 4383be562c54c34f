#!/usr/bin/env bash
# unchanged_entries.sh FILE… <CHANGED: the entries of tests, a line each, that none of the changed files touches. FILEs
# have lines "ENTRY PATH…": an entry is touched if a changed file's path begins with one of these.
set -euo pipefail
changed=$(cat)
while read -r entry paths; do
    for path in $paths; do
        ! grep -q "^${path//./\\.}" <<<"$changed" || continue 2
    done
    echo "$entry"
done < <(cat "$@")
