#!/usr/bin/env bash
# Measures and draws the figures of docs/depth_precision.md: depth_precision.sh [GNOMON [FOLDER]].
# GNOMON is the program, by default that of ./dev build; figures and CSV files go to FOLDER,
# by default out/figures. Needs python3 with matplotlib and pandas.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
gnomon=${1:-$root/build/release/bin/gnomon}
out=${2:-$root/out/figures}
csv=$out/csv

[ -x "$gnomon" ] || {
    echo "depth_precision.sh: $gnomon is missing; build it with ./dev build" >&2
    exit 1
}
mkdir -p "$csv"

# depth NAME OPTION…: the lesson's frustum into NAME.csv.
depth()
{
    "$gnomon" depth --near 4 --far 50 "${@:2}" --csv "$csv/$1.csv" >/dev/null
}

# draw NAME CSV…: NAME.svg and NAME.png.
draw()
{
    local type
    for type in svg png; do
        /usr/bin/python3 "$root/reports/figures/make.py" "$@" -o "$out/$1.$type"
    done
    echo "$out/$1.png"
}

for bits in 8 12 20 24; do
    depth "formula$bits" --bits "$bits" --theory-only --samples 16384
done
depth formula16 --bits 16 --theory-only --samples 262144 # the teeth near 50 m are 9 mm wide
draw error-vs-z "$csv"/formula{8,12,16,20,24}.csv

depth tolerance32 --bits 32 --tolerance 1e-8 --theory-only --samples 1024
draw tolerance-vs-z "$csv/tolerance32.csv"

depth d24 --format d24 --samples 2048
depth d32f --format d32f --samples 2048
depth d32f_reversed --format d32f --reversed --samples 2048
draw reversed-float "$csv"/{d24,d32f,d32f_reversed}.csv

depth d16 --format d16 --samples 2048
draw measured-against-formula "$csv"/{d16,d24}.csv

# A bias of a quarter of d16's step: too little for d16, ample for d24.
"$gnomon" sweep --builtin two-distances --out "$csv/two-distances" --quiet --no-keep-pixels \
    --set image.width=1280 --set image.height=720 --set shadow_map.resolution=4096 \
    --set bias.constant=4e-6 --axis shadow_map.depth_format=d16,d24
draw shadow-errors-on-depth-error "$csv"/two-distances/{error_vs_z,results}.csv
