#!/usr/bin/python3
"""Computes the matrices of cascades with numpy, by docs/cascades.md, and expects equal bits.

    cascades_oracle.py GNOMON

For random cameras, lights and splits, `gnomon compare` prints its float32 matrices. Here they are composed in double and
rounded once. Only auto near and far, which depend on the scene's triangles, come from the program.
"""

import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

JOBS = 24
WIDTH, HEIGHT = 32, 18


def float32(values):
    return np.asarray(values, dtype=np.float64).astype(np.float32).astype(np.float64)


def normalised(v):
    return v / np.linalg.norm(v)


class Camera:
    def __init__(self, job):
        eye, target = float32(job["eye"]), np.array(job["target"])
        self.eye = eye
        self.forward = normalised(target - eye)
        self.right = normalised(np.cross(self.forward, [0, 1, 0]))
        self.up = np.cross(self.right, self.forward)
        self.is_perspective = "fov" in job
        self.half_height = np.tan(np.radians(job["fov"]) / 2) if self.is_perspective else job["height"] / 2

    def half_sides(self, depth):
        scale = depth if self.is_perspective else 1
        return self.half_height * scale * WIDTH / HEIGHT, self.half_height * scale


class Light:
    def __init__(self, job):
        self.origin = float32(job["position"])
        self.forward = normalised(float32(job["direction"]))
        right = normalised(np.cross(self.forward, [0, 1, 0]))
        up = np.cross(right, self.forward)
        roll = np.radians(job["roll"])
        self.right = np.cos(roll) * right + np.sin(roll) * up
        self.up = np.cos(roll) * up - np.sin(roll) * right


def split_depths(job):
    near, far, count = job["near"], job["far"], job["count"]
    weight = {"uniform": 0, "logarithmic": 1, "practical": job["lambda"]}[job["split"]]
    shares = np.arange(1, count) / count
    inner = weight * near * (far / near) ** shares + (1 - weight) * (near + (far - near) * shares)
    return np.concatenate(([near], inner, [far]))


def tight_sides(light, camera, begin, end):
    corners = []
    for depth in (begin, end):
        x, y = camera.half_sides(depth)
        for sx in (-x, x):
            for sy in (-y, y):
                corners.append(camera.eye + depth * camera.forward + sx * camera.right + sy * camera.up)
    offsets = np.array(corners) - light.origin
    across, along = offsets @ light.right, offsets @ light.up
    return (across.min(), across.max()), (along.min(), along.max())


def stable_sides(light, camera, begin, end, resolution):
    near_side = np.hypot(*camera.half_sides(begin))
    far_side = np.hypot(*camera.half_sides(end))
    depth = end - begin
    centre_depth = begin + min(depth, (depth**2 + far_side**2 - near_side**2) / (2 * depth))
    radius = np.hypot(end - centre_depth, far_side)
    least = 2 * radius / (resolution - 1)
    texel = np.float32(least)
    if float(texel) < least:
        texel = np.nextafter(texel, np.float32(np.inf))
    texel = float(texel)
    centre = camera.eye + centre_depth * camera.forward
    return texel, [round(float(axis @ centre) / texel) for axis in (light.right, light.up)]


def depth_row(light, near, far):
    row = 2 * np.append(light.forward, -(light.forward @ light.origin)) / (far - near)
    row[3] -= (far + near) / (far - near)
    return row


def matrix(job, light, camera, begin, end, near, far):
    rows = []
    if job["fit"] == "tight":
        for axis, (low, high) in zip((light.right, light.up), tight_sides(light, camera, begin, end)):
            row = 2 * np.append(axis, -(axis @ light.origin)) / (high - low)
            row[3] -= (high + low) / (high - low)
            rows.append(row)
    else:
        resolution = job["resolution"]
        texel, middles = stable_sides(light, camera, begin, end, resolution)
        for axis, middle in zip((light.right, light.up), middles):
            rows.append(np.append(2 * axis / (resolution * texel), -2 * middle / resolution))
    rows.append(depth_row(light, near, far))
    rows.append(np.array([0.0, 0.0, 0.0, 1.0]))
    return np.array(rows).astype(np.float32)


def random_job(dice, number):
    def coordinates(reach):
        return [dice.uniform(-reach, reach) for _ in range(3)]

    near = dice.uniform(0.1, 2)
    job = {
        "eye": coordinates(20),
        "target": coordinates(5),
        "position": coordinates(10),
        "direction": [dice.uniform(-1, 1), -dice.uniform(0.2, 1), dice.uniform(-1, 1)],
        "roll": dice.choice([0, dice.uniform(-180, 180)]),
        "near": near,
        "far": near + dice.uniform(5, 80),
        "count": dice.randint(2, 8),
        "split": dice.choice(["uniform", "logarithmic", "practical"]),
        "lambda": dice.uniform(0, 1),
        "fit": ["tight", "stabilised"][number % 2],
        "blend": dice.choice([0, dice.uniform(0.05, 0.9)]),
        "resolution": dice.choice([16, 64, 256]),
    }
    if dice.random() < 0.75:
        job["fov"] = dice.uniform(20, 100)
    else:
        job["height"] = dice.uniform(1, 20)
    return job


def toml(job):
    view = f"vertical_fov_deg = {job['fov']!r}" if "fov" in job else f"orthographic_height = {job['height']!r}"
    weight = f"split_lambda = {job['lambda']!r}" if job["split"] == "practical" else ""
    return f"""
[scene]
builtin = "columns"
[image]
width = {WIDTH}
height = {HEIGHT}
[camera]
eye = {job['eye']}
target = {job['target']}
{view}
[light]
type = "directional"
direction = {job['direction']}
position = {job['position']}
[shadow_map]
layout = "cascades"
resolution = {job['resolution']}
roll_deg = {float(job['roll'])!r}
cascades = {job['count']}
split = "{job['split']}"
{weight}
cascade_near = {job['near']!r}
cascade_far = {job['far']!r}
cascade_fit = "{job['fit']}"
blend = {float(job['blend'])!r}
"""


def check(gnomon, job, folder):
    path = Path(folder) / "job.toml"
    path.write_text(toml(job), encoding="utf-8")
    run = subprocess.run([gnomon, "compare", path, "--json"], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{run.stderr}\n{path.read_text(encoding='utf-8')}")
    inputs = json.loads(run.stdout)["exact_inputs"]
    light, camera, splits = Light(job), Camera(job), split_depths(job)
    for i in range(job["count"]):
        begin = splits[i] - (job["blend"] * (splits[i] - splits[i - 1]) if i > 0 else 0)
        near, far = (float.fromhex(inputs[f"{plane}_{i}"]) for plane in ("near", "far"))
        expected = matrix(job, light, camera, begin, splits[i + 1], near, far)
        used = np.array([float.fromhex(value) for value in inputs[f"light_clip_from_world_{i}"]])
        used = used.reshape(4, 4).astype(np.float32)
        if not np.array_equal(used, expected):
            sys.exit(f"cascade {i} of\n{job}\nused\n{used}\nexpected\n{expected}\n{used - expected}")
        end = float.fromhex(inputs[f"slice_end_{i}"])
        if end != float(np.float32(splits[i + 1])):
            sys.exit(f"cascade {i} of {job} ends at {end}, expected {splits[i + 1]}")
    return job["count"]


def main():
    dice = random.Random(25)
    with tempfile.TemporaryDirectory() as folder:
        matrices = sum(check(sys.argv[1], random_job(dice, i), folder) for i in range(JOBS))
    print(f"{matrices} matrices of {JOBS} jobs are equal to the bit")


if __name__ == "__main__":
    main()
