#!/usr/bin/env bash
# test_files.sh ROOT: finds test files that no CMakeLists.txt and no script names, so that they never run.
set -euo pipefail
cd "$1/tests"

readarray -t runners < <(find . ../cmake -name CMakeLists.txt -o -name '*_test.sh' -o -name 'Gnomon*.cmake' 2>/dev/null)
forgotten=0
for list in */CMakeLists.txt; do
    grep -q "add_subdirectory(${list%/*})" CMakeLists.txt || {
        echo "tests/$list: tests/CMakeLists.txt does not add its folder, so nothing there runs" >&2
        forgotten=1
    }
done
while read -r file; do
    name=${file##*/}
    name=${name//./\\.}
    name=${name/%\\.py/(\\.py)?} # unittest takes a module's name
    # A script may contain its own name.
    others=()
    for runner in "${runners[@]}"; do
        [ "$runner" = "$file" ] || others+=("$runner")
    done
    grep -qE "(^|[^A-Za-z0-9_])${name}([^A-Za-z0-9_.]|\$)" "${others[@]}" || {
        echo "tests/${file#./}: no CMakeLists.txt and no script names it, so it never runs" >&2
        forgotten=1
    }
done < <(find . -name '*.cpp' -o -name '*_test.py' -o -name '*_test.mjs' -o -name '*_test.sh' \
    -o -name '*_test.cmake' | sort)
exit "$forgotten"
