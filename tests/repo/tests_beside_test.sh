#!/usr/bin/env bash
# tests_beside_test.sh: every source of a library has tests beside it, by which `./dev quick` tries it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

beside() { bash tests/repo/tests_beside.sh "$@"; }

for layer in scene methods raster_gl reference_rt analysis store reports; do
    while read -r folder; do
        line=$(beside "$folder/any.cpp")
        [[ $line == "${layer}_tests "*.* ]] || { echo "$folder: no tests beside it: '$line'" && exit 1; }
    done < <(find "$layer" -type d)
done
[ "$(beside tests/store/csv_text_test.cpp)" = 'store_tests CsvNumber.*:*/CsvNumber.*:CsvText.*:*/CsvText.*' ]
[ "$(beside store/csv/csv_text.cpp tests/store/csv_text_test.cpp)" = "$(beside store/csv/csv_text.cpp)" ]
[ -z "$(beside cli/main.cpp docs/building.md README.md)" ]
