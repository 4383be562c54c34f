#!/usr/bin/env bash
# check.sh FOLDER/engine.sh: what the engine in the folder lacks, in one line with the remedy; nothing where it lacks nothing.
set -euo pipefail
common=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=/dev/null
source "$common/missing.sh"
folder=$(cd "$(dirname "$1")" && pwd)
missing=$(missing_of "$folder")
[ -z "$missing" ] || echo "$missing: ./dev engines ${folder##*/}"
