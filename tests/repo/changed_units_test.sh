#!/usr/bin/env bash
# changed_units_test.sh WORK: changed_units.py finds changed sources, a unit for each changed header, and all units where
# the checks changed.
set -euo pipefail
script=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/changed_units.py
rm -rf "$1"
mkdir -p "$1/build"
cd "$1"
git init -q .
echo 'inline int one() { return 1; }' >one.hpp
echo '#include "one.hpp"' >first.cpp
echo 'int second;' >second.cpp
echo '/build/' >.gitignore
echo 'Checks: none' >.clang-tidy
git add -A
git -c user.name=test -c user.email=test@example.invalid commit -qm first
for name in first second; do
    printf '{"directory": "%s", "command": "g++ -o %s.o -c ../%s.cpp", "file": "%s"}\n' \
        "$PWD/build" "$name" "$name" "$PWD/$name.cpp"
done | paste -sd, | sed 's/^/[/; s/$/]/' >build/compile_commands.json

# expect_units NAME…
expect_units()
{
    local found
    found=$(python3 "$script" . build HEAD | sed 's/\\//g; s|.*/||; s/\$$//' | paste -sd' ')
    [ "$found" = "$*" ] || {
        echo "changed_units.py found \"$found\" in place of \"$*\"" >&2
        exit 1
    }
}
expect_units
echo '// more' >>second.cpp
expect_units second.cpp
git checkout -q second.cpp
echo '// more' >>one.hpp
expect_units first.cpp
# One unit is enough for a header: its own source if there is one.
echo '#include "one.hpp"' >one.cpp
printf ',{"directory": "%s", "command": "g++ -o one.o -c ../one.cpp", "file": "%s"}]' "$PWD/build" "$PWD/one.cpp" |
    cat <(sed 's/]$//' build/compile_commands.json) - >build/more.json
mv build/more.json build/compile_commands.json
git add one.cpp
git -c user.name=test -c user.email=test@example.invalid commit -qm second one.cpp
expect_units one.cpp
[ "$(python3 "$script" . build HEAD --commands)" = "cd $PWD/build && g++ -c ../one.cpp -fsyntax-only" ]
echo '// more' >>second.cpp
expect_units one.cpp second.cpp
git checkout -q .
echo 'Checks: all' >.clang-tidy
expect_units first.cpp second.cpp one.cpp
git checkout -q .
echo 'int new_one;' >one_more.hpp
echo '#include "one_more.hpp"' >>first.cpp
expect_units first.cpp
