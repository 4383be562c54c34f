#!/usr/bin/env bash
# Whether $GNOMON starts without OpenImageIO, and with libraries that can be counted.
set -euo pipefail
command -v ldd >/dev/null || { echo "no ldd here"; exit 77; }
libraries=$(ldd "$GNOMON")
if grep -q OpenImageIO <<<"$libraries"; then
    echo "$GNOMON is linked with OpenImageIO, which it should load with its first image" >&2
    exit 1
fi
count=$(wc -l <<<"$libraries")
[ "$count" -le 40 ] || { echo "$GNOMON is linked with $count libraries" >&2; exit 1; }
