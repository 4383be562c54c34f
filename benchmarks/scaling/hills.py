"""A height field with any number of triangles, and its jobs."""

import math

SIDE_M = 40
TERRAIN = "hills_{}.obj"


def triangles_of(cells):
    return 2 * cells * cells


def write(folder, cells):
    """Writes the field as an OBJ file of 2 cells² triangles; returns its path."""
    path = folder / TERRAIN.format(cells)
    if path.exists():
        return path
    places = [SIDE_M * (i / cells - 0.5) for i in range(cells + 1)]
    along = [math.sin(0.9 * x) + 0.4 * math.sin(2.3 * x + 1) for x in places]
    across = [math.cos(0.7 * z) for z in places]
    with path.open("w") as file:
        for z, far in zip(places, across):
            file.writelines(f"v {x:.5f} {near * far:.5f} {z:.5f}\n" for x, near in zip(places, along))
        for row in range(cells):
            first = row * (cells + 1) + 1
            file.writelines(f"f {i} {i + cells + 1} {i + 1}\nf {i + 1} {i + cells + 1} {i + cells + 2}\n"
                            for i in range(first, first + cells))
    return path


def job(scene, width, height, resolution, axes=""):
    """A job whose camera and light see the whole field."""
    return f"""[scene]
file = "{scene.name}"
[camera]
eye = [18, 9, 18]
target = [0, 0, 0]
[image]
width = {width}
height = {height}
[light]
type = "directional"
direction = [-0.8, -0.6, 0.1]
[shadow_map]
resolution = {resolution}
depth_format = "d32f"
[bias]
constant = 0.001
{axes}"""


def bias_axis(count):
    return f'"bias.constant" = {{from = 1e-7, to = 1e-1, count = {count}, scale = "log"}}\n' if count > 1 else ""


def near_axis(count):
    return f'"shadow_map.near" = {{from = -60, to = -40, count = {count}}}\n' if count > 1 else ""
