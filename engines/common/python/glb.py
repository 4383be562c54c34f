"""Reads Gnomon's mesh files: binary glTF with a node for each object, and no transforms."""
import json
import pathlib
import struct

import numpy


def read_objects(file):
    """The objects by name: positions, float32 of shape (n, 3) [m], and triangles, uint32 of shape (m, 3).

    @throws OSError  if the file cannot be read.
    """
    data = pathlib.Path(file).read_bytes()
    length = struct.unpack_from("<I", data, 12)[0]
    gltf, blob = json.loads(data[20:20 + length]), data[28 + length:]

    def values(index):
        accessor = gltf["accessors"][index]
        start = gltf["bufferViews"][accessor["bufferView"]].get("byteOffset", 0) + accessor.get("byteOffset", 0)
        number, width = {5126: ("<f4", 3), 5125: ("<u4", 1)}[accessor["componentType"]]
        return numpy.frombuffer(blob, number, accessor["count"] * width, start)

    def joined(parts):
        positions = [values(part["attributes"]["POSITION"]).reshape(-1, 3) for part in parts]
        firsts = numpy.cumsum([0] + [len(p) for p in positions[:-1]]).astype(numpy.uint32)
        triangles = [values(part["indices"]).reshape(-1, 3) + first for part, first in zip(parts, firsts)]
        return numpy.concatenate(positions), numpy.concatenate(triangles)

    return {node["name"]: joined(gltf["meshes"][node["mesh"]]["primitives"]) for node in gltf["nodes"]}


def corners(objects):
    """The lower and upper corner of the bounding box of all objects."""
    positions = numpy.concatenate([positions for positions, _ in objects.values()])
    return positions.min(0), positions.max(0)
