#!/usr/bin/env bash
# rays_test.sh COMMAND…: one of the example renderers draws what is true.
set -euo pipefail
command -v "$1" >/dev/null || {
    echo "SKIPPED: there is no $1"
    exit 77
}
exec /usr/bin/python3 -B "$(dirname "${BASH_SOURCE[0]}")/rays_test.py" "$@"
