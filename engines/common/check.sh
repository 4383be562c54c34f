#!/usr/bin/env bash
# check.sh FOLDER/engine.sh: prints the first missing requirement of the engine and the remedy, in one line.
set -euo pipefail
common=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=/dev/null
source "$common/missing.sh"
folder=$(cd "$(dirname "$1")" && pwd)
missing=$(missing_of "$folder")
[ -z "$missing" ] || echo "$missing: ./dev engines ${folder##*/}"
