#!/usr/bin/env bash
# The adapter of three.js, where it is installed.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
for program in node chromium; do
    command -v "$program" >/dev/null || {
        echo "SKIPPED: there is no $program"
        exit 77
    }
done
[ -d "$here/../../engines/three/node_modules/three" ] || {
    echo "SKIPPED: three.js is not installed: ./dev engines three"
    exit 77
}
/usr/bin/python3 -c 'import numpy, OpenImageIO' 2>/dev/null || {
    echo "three_test.sh: Debian's python3-openimageio and python3-numpy are missing" >&2
    exit 1
}
exec /usr/bin/python3 -B "$here/three_test.py"
