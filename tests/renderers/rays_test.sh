#!/usr/bin/env bash
# rays_test.sh COMMAND…: tries an example renderer, if its interpreter is installed.
set -euo pipefail
command -v "$1" >/dev/null || {
    echo "SKIPPED: $1 is not installed"
    exit 77
}
exec /usr/bin/python3 -B "$(dirname "${BASH_SOURCE[0]}")/rays_test.py" "$@"
