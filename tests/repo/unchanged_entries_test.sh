#!/usr/bin/env bash
# unchanged_entries_test.sh WORK BUILD: unchanged_entries.sh, and what CMake says of the libraries' unit tests in BUILD.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
work=$1
build=$2
rm -rf "$work"
mkdir -p "$work"

# expect CHANGED FILE ENTRY…: with this one changed file, these entries of FILE are left out and no others.
expect()
{
    local changed=$1 file=$2 found
    shift 2
    found=$(printf '%s\n' "$changed" | bash tests/repo/unchanged_entries.sh "$file" | sort | paste -sd ' ')
    if [ "$found" != "$*" ]; then
        echo "after a change of $changed these are left out: ${found:-none}; expected: ${*:-none}"
        exit 1
    fi
}

printf '%s\n' 'drawn scene/ tests/drawn/' 'told docs/a.md' >"$work/paths.txt"
expect scene/job.cpp "$work/paths.txt" told
expect tests/drawn/x_test.cpp "$work/paths.txt" told
expect docs/a.md "$work/paths.txt" drawn
expect docs/aXmd "$work/paths.txt" drawn told # a point is a point
expect old/scene/job.cpp "$work/paths.txt" drawn told
expect '' "$work/paths.txt" drawn told

# The layers from below: who changes one has its tests run, and those of all that is built on it.
grep -E '^(scene|methods|analysis)_tests |^store_run_store_test |^reports_table_test ' "$build/unit_paths.txt" >"$work/units.txt"
expect scene/settings/job.cpp "$work/units.txt"
expect methods/list.cpp "$work/units.txt" scene_tests
expect analysis/metrics/metrics.cpp "$work/units.txt" methods_tests scene_tests
expect reports/table.cpp "$work/units.txt" analysis_tests methods_tests scene_tests
expect cli/main.cpp "$work/units.txt" analysis_tests methods_tests reports_table_test scene_tests store_run_store_test
expect docs/metrics.md "$work/units.txt" methods_tests reports_table_test scene_tests store_run_store_test
expect examples/job.toml "$work/units.txt" analysis_tests methods_tests reports_table_test store_run_store_test
for common in CMakeLists.txt cmake/GnomonLibrary.cmake tests/support/lane.hpp tests/CMakeLists.txt dev; do
    expect "$common" "$work/units.txt"
done
echo "entries are left out by what they are made of"
