#!/usr/bin/env bash
# Hands document_links.sh small checkouts that must pass or fail: document_links_test.sh WORK_FOLDER.
set -euo pipefail

work_folder=$1
script=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/document_links.sh

# expect MESSAGE PAGE COMMENT: a checkout whose README holds PAGE and whose source holds COMMENT;
# MESSAGE is what the check says, empty when everything leads somewhere.
expect()
{
    local output status=0
    rm -rf "$work_folder"
    mkdir -p "$work_folder/docs" "$work_folder/scene/settings"
    printf '# Formulas\n\n## Driver bound, B\n' > "$work_folder/docs/formulas.md"
    printf '# Read me\n%s\n' "$2" > "$work_folder/README.md"
    printf '/// %s\n' "$3" > "$work_folder/scene/settings/job.hpp"
    output=$(bash "$script" "$work_folder" 2>&1) || status=$?
    if [ "$output" != "$1" ] || { [ -z "$1" ] && [ "$status" -ne 0 ]; } ||
        { [ -n "$1" ] && [ "$status" -eq 0 ]; }; then
        printf 'expected "%s", got status %d: "%s"\n' "$1" "$status" "$output" >&2
        exit 1
    fi
}

expect "" "[a](docs/formulas.md#driver-bound-b) [b](#read-me) [c](https://example.org/x)" \
    "Source: docs/formulas.md#driver-bound-b."
expect "README.md: docs/lost.md does not exist" "[a](docs/lost.md)" ""
expect "README.md: docs/formulas.md has no heading #lost" "[a](docs/formulas.md#lost)" ""
expect "scene/settings/job.hpp: docs/lost.md does not exist" "[a](#read-me)" "docs/lost.md"
expect "scene/settings/job.hpp: docs/methods/lost.md does not exist" "[a](#read-me)" "docs/methods/lost.md"
expect "scene/settings/job.hpp: docs/formulas.md has no heading #lost" "[a](#read-me)" \
    "docs/formulas.md#lost"
expect "README.md: scene/lost does not exist" '`scene/lost`' ""
expect "" '`scene/settings/job` `scene/settings/job.hpp` `scene/settings/`' ""
