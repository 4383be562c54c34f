#!/usr/bin/python3
"""Writes the pixels that figures are drawn from as CSV files: crops.py FOLDER.

The folder has the images of lessons.sh; the package gnomon is found through PYTHONPATH.
"""

import sys
from pathlib import Path

import gnomon

# What stands under a figure's title.
SETTINGS = ("scene.builtin", "light.type", "shadow_map.resolution", "shadow_map.depth_format")

folder = Path(sys.argv[1])


def write(table, name):
    table.to_csv(folder / f"{name}.csv", index=False, lineterminator="\n")


# 240 x 150 pixels of the sphere, its shadow and the plane around it.
layers = gnomon.load_layers(folder / "acne.exr")
write(layers.crop(["class", "critical_bias"], (250, 120, 240, 150), [*SETTINGS, "lookup.filter"]),
      "acne")

# One row of pixels across the edge.
for name in ("nearest", "pcf3", "pcf5", "pcf7", "pcf9"):
    layers = gnomon.load_layers(folder / f"{name}.exr")
    write(layers.crop(["P.X", "class", "verdict"], (46, 4, 420, 1),
                      [*SETTINGS, "shadow_map.half_extent", "scene.wall.light_angle_deg",
                       "lookup.filter"]), name)

depth_map = gnomon.load_depth_map(folder / "depth_map.exr")
write(depth_map.crop(["light_distance_m"],
                     keys=[*SETTINGS, "shadow_map.near", "shadow_map.far"]), "depth_map")
