#!/usr/bin/env python3
"""A renderer that Gnomon drives. It traces a ray through each pixel, and one from the hit to the light. Only needs NumPy.

docs/renderer_protocol.md describes requests and answers; README.md explains how to adapt it."""
import json
import pathlib
import struct
import sys
import time

import numpy as np

KEYS = [{"name": "bias_m", "type": "number", "range": [0, 1e6], "default": 0.001, "unit": "m",
         "help": "how far from the surface, along the ray, a shadow ray begins to look for what it hits"}]
OF_MAPS = {"resolution", "near", "far", "light_clip_from_world", "vertical_fov_deg", "half_extent", "light_camera", "maps"}
opened = {}  # what `open` said, and "objects"


def read_objects(file):
    """The triangles of each object of a .glb file, (n, 3, 3), by name."""
    data = pathlib.Path(file).read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    gltf = json.loads(data[20:20 + length])

    def values(accessor, kind):
        view = gltf["bufferViews"][gltf["accessors"][accessor]["bufferView"]]
        return np.frombuffer(data, kind, view["byteLength"] // 4, 28 + length + view.get("byteOffset", 0))

    parts = {node["name"]: gltf["meshes"][node["mesh"]]["primitives"][0] for node in gltf["nodes"]}
    return {name: values(part["attributes"]["POSITION"], "<f4").astype(float).reshape(-1, 3)[values(part["indices"], "<u4")].reshape(-1, 3, 3)
            for name, part in parts.items()}


def first_hits(origins, directions, triangles, least=0.0):
    """The distance of the first triangle beyond `least` for each ray, in lengths of its direction; inf if there is none."""
    found = np.full(len(origins), np.inf)
    for group in np.array_split(triangles, len(triangles) // 64 + 1):  # most rays miss the boxes around most groups
        sides = np.sort([(group.min((0, 1)) - 1e-6 - origins) / directions, (group.max((0, 1)) + 1e-6 - origins) / directions], axis=0)
        enters, leaves = sides[0].max(1), sides[1].min(1)
        near = np.flatnonzero((enters <= leaves) & (leaves > least) & (enters < found))
        a, e, f = group[:, 0], group[:, 1] - group[:, 0], group[:, 2] - group[:, 0]
        o, d = origins[near, None], directions[near, None]
        p, q = np.cross(d, f), np.cross(o - a, e)
        det = (e * p).sum(2)
        u, v, t = ((o - a) * p).sum(2) / det, (d * q).sum(2) / det, (f * q).sum(2) / det
        t[~((u >= 0) & (v >= 0) & (u + v <= 1) & (t > least))] = np.inf
        found[near] = np.minimum(found[near], t.min(1, initial=np.inf))
    return found


def pixel_rays(camera, width, height):
    """Origin and direction of the ray through each pixel's centre, top left first."""
    eye, target, up = (np.array(camera[name], float) for name in ("eye", "target", "up"))
    forward = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(forward, up) / np.linalg.norm(np.cross(forward, up))
    is_flat = "orthographic_height" in camera
    half = camera["orthographic_height"] / 2 if is_flat else np.tan(np.radians(camera["vertical_fov_deg"]) / 2)
    y, x = np.mgrid[0:height, 0:width].reshape(2, -1, 1) + 0.5
    aside = (2 * x / width - 1) * width / height * half * right + (1 - 2 * y / height) * half * np.cross(right, forward)
    return (eye + aside, forward + 0 * aside) if is_flat else (eye + 0 * aside, forward + aside)


def draw(bias_m, width, height):
    """The world position of each pixel, NaN for background, and 1 for lit, 0 for shadowed pixels: float32."""
    light, mesh = opened["light"], opened["mesh"]
    seen, casting = (np.concatenate([triangles for name, triangles in opened["objects"].items() if name not in mesh.get(left_out, [])] or [np.zeros((1, 3, 3))])
                     for left_out in ("no_receive", "no_cast"))
    origins, directions = pixel_rays(opened["camera"], width, height)
    position = (origins + first_hits(origins, directions, seen)[:, None] * directions).astype(np.float32)
    position[~np.isfinite(position).all(1)] = np.nan
    starts = position.astype(float)  # rounded, as they are read from a target
    way = 0 * starts - light["direction"] if light["type"] == "directional" else light["position"] - starts
    far = np.linalg.norm(way, axis=1)
    blocked = first_hits(starts, way / far[:, None], casting, bias_m)
    lit = np.isinf(blocked) if light["type"] == "directional" else ~(blocked < far)
    return {"position": position.reshape(height, width, 3), "shadow": lit.astype(np.float32).reshape(height, width)}


def answer_to(request):
    if "hello" in request:
        return {"protocol": 1, "name": "rays.py", "version": "1", "device": "NumPy " + np.__version__, "keys": KEYS}
    if "open" in request:
        opened.update(request["open"], objects=read_objects(request["open"]["mesh"]["file"]))
        return {"ok": True}
    order, began = request["draw"], time.monotonic()
    asked = {f"{table}.{key}" for table in ("shadow_map", "lookup", "bias", "method", "engine") for key in order.get(table, {})}
    if refused := asked - {f"shadow_map.{key}" for key in OF_MAPS} - {"engine.bias_m"}:
        return {"error": {key: "rays have no such setting" for key in sorted(refused)}}
    for name, values in draw(order["engine"]["bias_m"], **opened["image"]).items():
        np.save(pathlib.Path(request["frame"]).with_name(name + ".npy"), values)
    return {"ok": True, "seconds": time.monotonic() - began, "files": {name: name + ".npy" for name in ("position", "shadow")}}


np.seterr(all="ignore")  # rays along an axis divide by 0, and those that miss multiply infinities
for line in sys.stdin:
    told = json.loads(line)
    if "close" in told:
        break
    try:
        said = answer_to(told)
    except (KeyError, OSError, ValueError) as problem:
        said = {"error": f"{type(problem).__name__}: {problem}"}
    print(json.dumps({"id": told["id"], **said}), flush=True)
