#!/usr/bin/env bash
# test_files_test.sh WORK: test_files.sh accepts a tree whose files are all named, and refuses each kind of
# forgotten file.
set -euo pipefail
check=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/test_files.sh
rm -rf "$1"
mkdir -p "$1/tests/layer"
cd "$1/tests/layer"
printf 'gnomon_test(layer SOURCES a_test.cpp helper.cpp)\n# b_test.sh runs the rest\n' >CMakeLists.txt
echo 'add_subdirectory(layer)' >../CMakeLists.txt
touch a_test.cpp helper.cpp
printf 'python3 -m unittest c_test\nnode --test d_test.mjs\n' >b_test.sh
touch c_test.py d_test.mjs
bash "$check" "$1"

for forgotten in extra_test.cpp other_helper.cpp lost_test.py lost_test.mjs lost_test.sh aa_test.cpp; do
    touch "$forgotten"
    if message=$(bash "$check" "$1" 2>&1); then
        echo "test_files.sh does not see that nobody names $forgotten" >&2
        exit 1
    fi
    [[ "$message" == "tests/layer/$forgotten: "* ]] || {
        echo "test_files.sh says of $forgotten: $message" >&2
        exit 1
    }
    rm "$forgotten"
done

echo '# nothing' >../CMakeLists.txt
if message=$(bash "$check" "$1" 2>&1) || [[ "$message" != "tests/layer/CMakeLists.txt: "* ]]; then
    echo "test_files.sh does not see that nobody adds the folder: $message" >&2
    exit 1
fi
