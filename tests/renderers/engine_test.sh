#!/usr/bin/env bash
# engine_test.sh NAME: the adapter in engines/NAME, where what it needs is installed, by NAME_test.py.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
engines=$here/../../engines
source "$engines/common/missing.sh"
missing=$(missing_of "$engines/$1")
[ -z "$missing" ] || {
    echo "SKIPPED: $missing: ./dev engines $1"
    exit 77
}
/usr/bin/python3 -c 'import numpy, OpenImageIO' 2>/dev/null || {
    echo "engine_test.sh: Debian's python3-openimageio and python3-numpy are missing" >&2
    exit 1
}
exec /usr/bin/python3 -B "$here/$1_test.py"
