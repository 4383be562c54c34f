#!/usr/bin/env bash
# pack_aov.py packs raw dumps into a case's image.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
/usr/bin/python3 -c 'import numpy, OpenImageIO' 2>/dev/null || {
    echo "SKIPPED: Debian's python3-openimageio and python3-numpy are missing"
    exit 77
}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$GNOMON" capture-kit "$folder" >/dev/null
exec /usr/bin/python3 -B "$here/packing_test.py" "$folder"
