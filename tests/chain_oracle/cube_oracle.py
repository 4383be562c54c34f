#!/usr/bin/python3
"""Computes causes, labels and the numbers of each face under point lights, as chain_oracle.py does.

    cube_oracle.py PROGRAM BUILTIN_TRIANGLES [--seed S] [--all] [--keep DIR]

The scenes are the built-in lamp-room, whose triangles BUILTIN_TRIANGLES prints, with maps so small that many pixels
read over seams, and every second scene of chain_oracle.py, or with --all each, with a seeded job of a point light. The
six faces follow docs/point_lights.md.

Exit status: 0 if nothing differs and every cause, label and face occurred; 1 otherwise; 77 if OpenImageIO or numpy is
missing.
"""

import argparse
import random
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import chain_oracle
import cube_faces
import small_scenes

NAMES = [*chain_oracle.chain.CAUSES, *sorted(chain_oracle.LABELS_THAT_OCCUR), *cube_faces.NAMES, "over seams"]

LAMP_ROOM = {"scene.builtin": "lamp-room", "image.width": 56, "image.height": 32}
LAMP_ROOM_JOBS = (
    {"shadow_map.resolution": 64, "lookup.filter": "nearest"},
    {"shadow_map.resolution": 48, "lookup.filter": "pcf3", "shadow_map.depth_format": "d16", "bias.constant": 0.0,
     "bias.slope": 0.0005},
    {"shadow_map.resolution": 64, "lookup.filter": "pcf3", "shadow_map.reversed": True,
     "shadow_map.depth_format": "d32f", "lookup.outside": "shadowed"},
    # Clips the table, the beam and the far corners. The moved lamp has other seams.
    {"shadow_map.resolution": 24, "lookup.filter": "pcf5", "shadow_map.near": 1.1, "shadow_map.far": 2.4,
     "light.position": [-0.2, 1.6, 0.4], "shadow_map.cull": "back"},
    {"shadow_map.resolution": 48, "lookup.filter": "pcf3", "shadow_map.near": 0.9, "shadow_map.far": 2.2,
     "lookup.outside": "clamp", "bias.normal_texels": 1.5, "shadow_map.reversed": True},
    {"shadow_map.resolution": 16, "lookup.filter": "linear", "bias.constant": 0.002, "light.position": [0.5, 1.5, 0.5],
     "shadow_map.cull": "front"},
)


def builtin_triangles(printer, name):
    """A built-in scene's triangles: three corners of three floats each."""
    lines = subprocess.run([printer, name], capture_output=True, text=True, check=True).stdout.splitlines()
    rows = [chain_oracle.floats(line.split()) for line in lines]
    return [tuple(tuple(row[3 * k:3 * k + 3]) for k in range(3)) for row in rows]


def jobs(printer, folder, seed, step):
    """The name, the job and the scene's triangles of each job."""
    room = builtin_triangles(printer, "lamp-room")
    for number, job in enumerate(LAMP_ROOM_JOBS):
        yield f"lamp_room_{number}", LAMP_ROOM | job, room
    for index in range(step - 1, len(small_scenes.MESHES), step):
        mesh = small_scenes.MESHES[index]
        source = random.Random(f"point {seed} {index}")
        objects = small_scenes.build(index, source)
        mesh_file = folder / f"{mesh.__name__}.obj"
        mesh_file.write_text(small_scenes.obj_text(objects))
        triangles = [triangle for part in objects.values() for triangle in part if small_scenes.has_area(triangle)]
        yield mesh.__name__, small_scenes.random_point_job(source, mesh_file.name), triangles


def check_all(options, folder):
    total, count = Counter(), 0
    for name, job, triangles in jobs(options.builtin_triangles, folder, options.seed, 1 if options.all else 2):
        lines, tally = chain_oracle.check_job(options.program, job, triangles, folder / f"{name}.toml")
        total.update(tally.checked)
        count += len(lines)
        print(f"{name}: {tally.checked['scored']} pixels, {tally.checked['over seams']} over seams")
        for line in lines[:20]:
            print(f"{name}: {line}")
    for name in ["scored", *NAMES]:
        print(f"{name}: {total[name]} pixels")
    missing = [name for name in NAMES if not total[name]]
    for name in missing:
        print(f"no pixel is {name}: the scenes do not test it")
    print(f"{count} differences")
    return 1 if count or missing else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("builtin_triangles")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--all", action="store_true", help="all ten small scenes")
    parser.add_argument("--keep", type=Path, help="a folder for job files and images")
    options = parser.parse_args()
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
        return check_all(options, options.keep)
    with tempfile.TemporaryDirectory() as folder:
        return check_all(options, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
