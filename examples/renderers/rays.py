#!/usr/bin/env python3
"""A renderer that Gnomon drives: a ray through each pixel, and another from what it hits to the light. Needs NumPy alone.

docs/renderer_protocol.md says what is asked and answered, README.md here what to change to make it yours."""
import json
import pathlib
import struct
import sys
import time

import numpy as np

KEYS = [{"name": "bias_m", "type": "number", "range": [0, 1e6], "default": 0.001, "unit": "m",
         "help": "how far from the surface, along the ray, a shadow ray begins to look for what it hits"}]
ALWAYS_SAID = {"resolution", "near", "far", "light_clip_from_world", "vertical_fov_deg", "half_extent", "light_camera", "maps"}


def read_objects(file):
    """The objects of a .glb file, by name: their triangles, (n, 3, 3)."""
    data = pathlib.Path(file).read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    gltf, blob = json.loads(data[20:20 + length]), data[28 + length:]

    def values(index):
        accessor = gltf["accessors"][index]
        start = gltf["bufferViews"][accessor["bufferView"]].get("byteOffset", 0) + accessor.get("byteOffset", 0)
        number, width = {5126: ("<f4", 3), 5125: ("<u4", 3), 5123: ("<u2", 3)}[accessor["componentType"]]
        count = accessor["count"] * {"VEC3": 3, "SCALAR": 1}[accessor["type"]]
        return np.frombuffer(blob, number, count, start).reshape(-1, width)

    return {node["name"]: np.concatenate([values(part["attributes"]["POSITION"]).astype(float)[values(part["indices"])]
                                          for part in gltf["meshes"][node["mesh"]]["primitives"]])
            for node in gltf["nodes"]}


def boxed(objects):
    """The objects' triangles by 64, with the box around each such group: most rays miss most boxes."""
    groups = [g for triangles in objects for g in np.array_split(triangles, -(-len(triangles) // 64))]
    return [(g.min((0, 1)) - 1e-6, g.max((0, 1)) + 1e-6, g[:, 0], g[:, 1] - g[:, 0], g[:, 2] - g[:, 0]) for g in groups]


def first_hits(origins, directions, groups, least=0.0):
    """How many lengths of its direction each ray goes, beyond `least`, to the first triangle; inf: it meets none."""
    found = np.full(len(origins), np.inf)
    inverse = 1 / directions
    for low, high, a, e, f in groups:
        sides = np.sort([(low - origins) * inverse, (high - origins) * inverse], axis=0)
        enters, leaves = sides[0].max(1), sides[1].min(1)
        near = np.flatnonzero((enters <= leaves) & (leaves > least) & (enters < found))
        o, d = origins[near, None], directions[near, None]
        p, s = np.cross(d, f), o - a
        q, det = np.cross(s, e), (e * p).sum(2)
        u, v, t = (s * p).sum(2) / det, (d * q).sum(2) / det, (f * q).sum(2) / det
        t[~((u >= 0) & (v >= 0) & (u + v <= 1) & (t > least))] = np.inf
        found[near] = np.minimum(found[near], t.min(1, initial=np.inf))
    return found


def pixel_rays(camera, width, height):
    """Origin and direction of the ray through each pixel's centre, from the top left on."""
    eye, target, up = (np.array(camera[name], float) for name in ("eye", "target", "up"))
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, up) / np.linalg.norm(np.cross(forward, up))
    is_flat = "orthographic_height" in camera
    half = camera["orthographic_height"] / 2 if is_flat else np.tan(np.radians(camera["vertical_fov_deg"]) / 2)
    y, x = np.mgrid[0:height, 0:width].reshape(2, -1, 1) + 0.5
    aside = (2 * x / width - 1) * width / height * half * right + (1 - 2 * y / height) * half * np.cross(right, forward)
    return (eye + aside, forward + 0 * aside) if is_flat else (eye + 0 * aside, forward + aside)


def draw(scene, objects, bias_m):
    """The world position of each pixel, NaN where it shows nothing, and 1 where it is lit, 0 where not: float32."""
    width, height, light, mesh = scene["image"]["width"], scene["image"]["height"], scene["light"], scene["mesh"]
    seen, casting = ([objects[name] for name in objects if name not in mesh.get(left_out, [])]
                     for left_out in ("no_receive", "no_cast"))
    origins, directions = pixel_rays(scene["camera"], width, height)
    position = (origins + first_hits(origins, directions, boxed(seen))[:, None] * directions).astype(np.float32)
    position[~np.isfinite(position).all(1)] = np.nan
    shows = np.isfinite(position).all(1)
    starts = position[shows].astype(float)
    way = 0 * starts - light["direction"] if light["type"] == "directional" else light["position"] - starts
    far = np.linalg.norm(way, axis=1)
    blocked = first_hits(starts, way / far[:, None], boxed(casting), bias_m)
    lit = np.ones(width * height, np.float32)
    lit[shows] = np.isinf(blocked) if light["type"] == "directional" else blocked >= far
    return position.reshape(height, width, 3), lit.reshape(height, width)


def answer_draw(request, scene, objects):
    order = request["draw"]
    refused = {f"{table}.{key}" for table in ("shadow_map", "lookup", "bias", "method", "engine") for key in order.get(table, {})}
    refused -= {f"shadow_map.{key}" for key in ALWAYS_SAID} | {"engine.bias_m"}
    if refused:
        return {"error": {key: "rays have no such setting" for key in sorted(refused)}}
    began = time.monotonic()
    files = dict(zip(("position", "shadow"), draw(scene, objects, order["engine"]["bias_m"])))
    for name, values in files.items():
        np.save(pathlib.Path(request["frame"]).with_name(name + ".npy"), values)
    return {"ok": True, "seconds": time.monotonic() - began, "files": {name: name + ".npy" for name in files}}


def main():
    scene = objects = None
    for line in sys.stdin:
        request = json.loads(line)
        answer = {"ok": True}
        try:
            if "close" in request:
                return
            if "hello" in request:
                answer = {"protocol": 1, "name": "rays.py", "version": "1", "device": "NumPy " + np.__version__, "keys": KEYS}
            elif "open" in request:
                scene, objects = request["open"], read_objects(request["open"]["mesh"]["file"])
            elif "draw" in request and scene:
                answer = answer_draw(request, scene, objects)
            else:
                answer = {"error": "asked for something else than hello, open, draw, close, or to draw before a scene is open"}
        except (KeyError, OSError, ValueError, TypeError) as problem:
            answer = {"error": f"{type(problem).__name__}: {problem}"}
        print(json.dumps({"id": request["id"], **answer}), flush=True)


np.seterr(all="ignore")  # rays along an axis divide by 0, and those that miss multiply infinities
main()
