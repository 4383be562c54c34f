#!/usr/bin/env bash
# Measures and draws the figures of docs/figures.md: lessons.sh [GNOMON [FOLDER]].
# GNOMON is the program, by default that of ./dev build; figures and what they are drawn from go to
# FOLDER, by default out/figures. Needs python3 with matplotlib, pandas and OpenImageIO.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
gnomon=${1:-$root/build/release/bin/gnomon}
out=${2:-$root/out/figures}
data=$out/lessons

[ -x "$gnomon" ] || {
    echo "lessons.sh: $gnomon is missing; build it with ./dev build" >&2
    exit 1
}
rm -rf "$data"
mkdir -p "$data"

# draw NAME INPUT…: NAME.svg and NAME.png.
draw()
{
    local type
    for type in svg png; do
        "$gnomon" figure "$@" -o "$out/$1.$type"
    done
    echo "$out/$1.png"
}

# A sphere over a plane under a spot light, without a bias.
"$gnomon" compare --builtin sphere-plane --set image.width=640 --set image.height=360 \
    --set bias.constant=0 --aov "$data/acne.exr" --depth-map "$data/depth_map.exr" >/dev/null

# The far edge of a wall's shadow from above, texels of 0.177 m on the ground; the light's camera
# stands so that the edge falls inside a texel, and the bias keeps nine texels of acne away.
for filter in nearest pcf3 pcf5 pcf7 pcf9; do
    "$gnomon" compare --builtin wall --set image.width=512 --set image.height=8 \
        --set 'camera.eye=[2, 10, 0]' --set 'camera.target=[2, 0, 0]' \
        --set 'camera.up=[0, 0, -1]' --set camera.orthographic_height=0.0375 \
        --set shadow_map.fit=fixed --set shadow_map.half_extent=4 --set shadow_map.resolution=64 \
        --set 'light.position=[0.05, 2, 0]' --set bias.constant_m=0.8 \
        --set "lookup.filter=$filter" --aov "$data/$filter.exr" >/dev/null
done

PYTHONPATH="$root/reports/figures" /usr/bin/python3 -B "$root/examples/figures/crops.py" "$data"
draw acne "$data/acne.csv"
draw pcf-edge "$data"/{nearest,pcf3,pcf5,pcf7,pcf9}.csv
draw depth-map "$data/depth_map.csv"

# The foot of a wall from above: pixels of 5 mm.
"$gnomon" sweep --builtin wall --out "$data/wall" --quiet --no-keep-pixels \
    --set image.width=800 --set image.height=400 \
    --set 'camera.eye=[0.5, 10, 0]' --set 'camera.target=[0.5, 0, 0]' \
    --set 'camera.up=[0, 0, -1]' --set camera.orthographic_height=2 \
    --axis scene.wall.light_angle_deg=30,45,60 \
    --axis 'bias.constant_m={from = 0, to = 0.5, count = 11}'
draw peter-panning "$data/wall"

"$gnomon" sweep --builtin sphere-plane --out "$data/resolution" --quiet --no-keep-pixels \
    --set image.width=640 --set image.height=360 \
    --axis shadow_map.resolution=128,256,512,1024,2048,4096 --axis lookup.filter=nearest,pcf3,pcf5
draw map-resolution "$data/resolution"

# A view in four slices, and one map of as many bytes.
columns=$root/examples/cascades_columns.toml
for layout in cascades one_map; do
    "$gnomon" compare "$columns" --case "$layout" --view-depths "$data/$layout.csv" >/dev/null
done
draw cascades "$data"/{cascades,one_map}.csv

# Every figure of a run: two resolutions, two filters, 41 biases.
"$gnomon" sweep --builtin sphere-plane --out "$data/sweep" --quiet --no-keep-pixels \
    --set image.width=640 --set image.height=360 --axis shadow_map.resolution=256,1024 \
    --axis lookup.filter=nearest,pcf3 \
    --axis 'bias.constant={from = 1e-6, to = 0.1, count = 41, scale = "log"}'
for name in bias-curve errors-vs-z depth-error-vs-z causes error-vs-axis heat-map pareto; do
    draw "$name" "$data/sweep"
done
