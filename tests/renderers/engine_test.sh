#!/usr/bin/env bash
# engine_test.sh NAME [TEST]: runs NAME_test.py, or TEST, if everything that engines/NAME needs is installed.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
engines=$here/../../engines
missing=$(bash "$engines/common/check.sh" "$engines/$1/engine.sh")
[ -z "$missing" ] || {
    echo "SKIPPED: $missing"
    exit 77
}
/usr/bin/python3 -c 'import numpy, OpenImageIO' 2>/dev/null || {
    echo "engine_test.sh: Debian's python3-openimageio and python3-numpy are missing" >&2
    exit 1
}
exec /usr/bin/python3 -B "$here/${2:-$1_test.py}"
