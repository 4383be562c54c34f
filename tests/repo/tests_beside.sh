#!/usr/bin/env bash
# tests_beside.sh FILE…: prints the unit tests of these sources, a line "PROGRAM FILTER" for each library, with GoogleTest's
# filter.
# The tests of LAYER/SUBJECT/… are in tests/LAYER/SUBJECT, or if there is no such folder in tests/LAYER. A test file
# stands for itself.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# suites FILE…: the names of their test suites, as a filter.
suites()
{
    sed -nE 's/^ *(TEST|TEST_F|TEST_P|RC_GTEST_PROP)\(([A-Za-z0-9_]+),.*/\2.*:*\/\2.*/p' "$@" | sort -u | paste -sd :
}

declare -A sources=()
for file in "$@"; do
    path=${file#tests/}
    layer=${path%%/*}
    [ "$layer" != cli ] || continue # its tests run the program
    grep -q "gnomon_test(${layer}_tests " "tests/$layer/CMakeLists.txt" 2>/dev/null || continue
    folder=tests/${path%/*}
    while [ ! -d "$folder" ]; do
        folder=${folder%/*}
    done
    if [[ $file == tests/*_test.cpp ]]; then
        sources[$layer]+="$file"$'\n'
    else
        sources[$layer]+=$(find "$folder" -name '*_test.cpp')$'\n'
    fi
done
for layer in "${!sources[@]}"; do
    readarray -t files < <(sort -u <<<"${sources[$layer]}" | sed '/^$/d')
    echo "${layer}_tests $(suites "${files[@]}")"
done
