#!/usr/bin/env python3
"""Lets Gnomon drive Godot 3 (docs/renderer_protocol.md). README.md explains how."""
import math
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "common" / "python"))

import numpy  # noqa: E402

import glb  # noqa: E402
from picture import MASKS, mask_of_pictures  # noqa: E402
from process import Godot  # noqa: E402
from protocol import Refused, read_options, serve  # noqa: E402
from settings import CASTS, FILTERS, KEYS, SPOT_NEAR, atlas_of, directional_size_of, light_of, refused  # noqa: E402
from x_server import RASTERIZERS, XServer  # noqa: E402

NAMES = {"gles3": "Godot GLES3", "gles2": "Godot GLES2"}
DEFAULT_DIRECTIONAL_SIZE = 4096
PLUS, MINUS, DIGITS = 1, 2, 4  # as in worker.gd
PIXELS = {8: ("<f2", 4), 4: ("u1", 4), 3: ("u1", 3)}  # type and number of channels by bytes of a pixel
LEAST_LIGHT = 8 / 255  # darker pixels are too coarse for a quotient


def positions_of(digits, scale):
    """The world position from its sign and base-256 digits; NaN without a sign."""
    signs = numpy.select([digits[0] == PLUS, digits[0] == MINUS], [1.0, -1.0], math.nan)
    return signs * sum(digit * 256.0**-(i + 1) for i, digit in enumerate(digits[1:])) * scale


def normals_of(corners):
    """The flat normals of clockwise triangles, one for each corner: float32 of shape (n, 3, 3)."""
    normals = numpy.cross(corners[:, 2] - corners[:, 0].astype(float), corners[:, 1] - corners[:, 0].astype(float))
    lengths = numpy.linalg.norm(normals, axis=1, keepdims=True)
    normals = numpy.divide(normals, lengths, where=lengths > 0, out=numpy.tile([0.0, 1.0, 0.0], (len(normals), 1)))
    return numpy.repeat(normals[:, None], 3, axis=1).astype("<f4")


class GodotRenderer:
    """A display and a Godot, which is restarted if a directional light's maps change their size."""

    def __init__(self, api, rasterizer, mask):
        self.api, self.rasterizer, self.is_picture = api, rasterizer, mask == "picture"
        self.server, self.godot = XServer(), None
        try:
            self._start(DEFAULT_DIRECTIONAL_SIZE)
        except OSError:
            self.close()
            raise

    def _start(self, directional_size):
        if self.godot:
            self.godot.close()
        self.godot, self.directional_size = None, directional_size
        self.godot = Godot(self.server.environment(self.rasterizer), self.api, directional_size)

    def hello(self):
        said = self.godot.call("hello")
        return {"name": NAMES[self.api], "version": said["version"].split("-")[0][:32], "device": said["device"][:124], "keys": KEYS}

    def open(self, scene):
        self.told = None
        objects = glb.read_objects(scene["mesh"]["file"])
        least, most = glb.corners(objects)
        self.scale = 2.0 ** math.ceil(math.log2(max(abs(least).max(), abs(most).max(), 1e-3)) + 1e-6)
        self.reach = float(numpy.linalg.norm(most - least) + numpy.linalg.norm((least + most) / 2 - scene["camera"]["eye"]))
        self.objects = objects
        self._open(scene)

    def _open(self, scene):
        mesh, told = scene["mesh"], []
        for i, (name, (positions, triangles)) in enumerate(self.objects.items()):
            file = self.godot.folder / f"object{i}"
            corners = positions[triangles[:, [0, 2, 1]]]  # Godot's front faces are clockwise
            file.write_bytes(corners.astype("<f4").tobytes() + normals_of(corners).tobytes())
            told.append({"file": str(file), "corners": corners.size // 3, "casts": name not in mesh["no_cast"],
                         "seen": name not in mesh["no_receive"]})
        self.godot.call("open", objects=told, camera=scene["camera"], light=scene["light"], reach=self.reach, scale=self.scale, **scene["image"])

    def _image(self, name, image):
        file = self.godot.folder / name
        data = file.read_bytes()
        file.unlink()
        number, channels = PIXELS[len(data) // (image["width"] * image["height"])]
        values = numpy.frombuffer(data, number).reshape(image["height"], image["width"], channels)[..., :3].astype(float)
        return values if number == "<f2" else values / 255

    def draw(self, scene, order, frame):
        problems = refused(order, scene["light"])
        if problems:
            raise Refused(problems)
        needed, engine = directional_size_of(order, scene["light"]), order["engine"]
        if needed not in (None, self.directional_size):
            self._start(needed)
            self._open(scene)
        began = time.monotonic()
        self.godot.call("draw", light=light_of(order, scene["light"]), atlas=atlas_of(order), folder=str(self.godot.folder),
                        shadows=engine["shadow_enabled"], cull="cull_" + engine["cull_mode"], cast_shadow=CASTS[engine["cast_shadow"]],
                        filter_mode=FILTERS[engine["filter_mode"]], is_picture=self.is_picture)
        seconds = time.monotonic() - began
        planes = self._planes(scene["image"])
        for name, plane in planes.items():
            numpy.save(pathlib.Path(frame).with_name(name + ".npy"), plane.astype(numpy.float32))
        table = {"resolution": order["shadow_map"]["resolution"]}
        if scene["light"]["type"] == "spot":
            table |= {"near": SPOT_NEAR, "far": order["shadow_map"]["far"]}
        return {"seconds": seconds, "files": {name: name + ".npy" for name in planes},
                "case": {"shadow_map": table, "channels": {"fractions": True}}}

    def _planes(self, image):
        shadowed, unshadowed = (self._image(name, image)[..., 0] for name in ("shadowed", "unshadowed"))
        digits = [numpy.rint(255 * self._image(f"digit{i}", image)) for i in range(DIGITS + 1)]
        position = positions_of(digits, self.scale)
        shows = numpy.isfinite(position).all(-1)
        if self.is_picture:
            picture = mask_of_pictures(shadowed, unshadowed, 16 if self.api == "gles3" else 8)
            picture["valid"] *= shows  # the sky is lit, too
            return {"position": numpy.where(shows[..., None], position, math.nan), **picture}
        is_told = unshadowed >= LEAST_LIGHT
        share = numpy.clip(numpy.divide(shadowed, unshadowed, where=is_told, out=numpy.ones_like(shadowed)), 0, 1)
        return {"position": numpy.where(shows[..., None], position, math.nan), "shadow": numpy.where(shows, share, 0)}

    def close(self):
        if self.godot:
            self.godot.close()
        self.server.close()


def start():
    return GodotRenderer(**read_options(sys.argv[1:], {"api": list(NAMES), "rasterizer": list(RASTERIZERS), "mask": MASKS}))


if __name__ == "__main__":
    sys.exit(serve("godot", start))
