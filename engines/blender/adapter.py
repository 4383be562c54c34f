#!/usr/bin/env python3
"""Lets Gnomon drive Blender (docs/renderer_protocol.md). README.md explains how."""
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "common" / "python"))

import numpy  # noqa: E402
import OpenImageIO  # noqa: E402

from picture import MASKS, mask_of_pictures  # noqa: E402
from process import Blender  # noqa: E402
from protocol import Refused, read_options, serve  # noqa: E402
from settings import keys_of, refused, settings_of, without_shadows  # noqa: E402
from x_server import RASTERIZERS, XServer  # noqa: E402

NAMES = {"eevee": "Blender EEVEE", "cycles": "Blender Cycles"}
PICTURE_BITS = {"eevee": 16, "cycles": 32}  # precision of the pass Combined; files have 32 bits


def channels_of(file):
    """The channels of an EXR file by name, without the view layer's."""
    image = OpenImageIO.ImageInput.open(str(file))  # ImageBuf would return a cached older file of this name
    pixels = image.read_image(OpenImageIO.FLOAT)
    names = image.spec().channelnames
    image.close()
    return {name.removeprefix("ViewLayer."): pixels[..., i] for i, name in enumerate(names)}


def stacked(channels, name, members):
    return numpy.stack([channels[f"{name}.{member}"] for member in members], axis=-1)


def planes_of_eevee(channels, scale):
    whole, fine, finest = (stacked(channels, name, "RGB").astype(float) for name in ("whole", "fine", "finest"))
    position = (whole + (fine + finest) / 1024) / scale
    # Where coplanar facets meet, both may be added; such sums are not positions.
    shows = (channels["Combined.A"] == 1) & (fine < 1024).all(-1) & (finest < 1).all(-1)
    return position, numpy.clip(channels["Shadow.R"], 0, 1), shows


def planes_of_cycles(channels, _):
    return stacked(channels, "Position", "XYZ"), channels["DiffDir.R"] > 0, channels["Combined.A"] == 1


class BlenderRenderer:
    """Blender, and for EEVEE its display."""

    def __init__(self, engine, rasterizer, mask):
        self.engine, self.is_cycles, self.is_picture = engine, engine == "cycles", mask == "picture"
        self.server = None if self.is_cycles else XServer()
        try:
            self.device = self.server.device(rasterizer) if self.server else "CPU"
            self.blender = Blender(self.server.environment(rasterizer) if self.server else {})
        except OSError:
            self.close()
            raise
        self.scale = None

    def hello(self):
        said = self.blender.call("hello")
        return {"name": NAMES[self.engine], "version": said["version"], "device": self.device, "keys": keys_of(self.is_cycles)}

    def open(self, scene):
        self.scale = self.blender.call("open", scene=scene, is_cycles=self.is_cycles)["scale"]

    def _rendered(self, settings):
        """The channels of a frame, and its duration [s]."""
        file = self.blender.folder / "frame.exr"
        began = time.monotonic()
        self.blender.call("draw", settings=settings, file=str(file))
        seconds = time.monotonic() - began
        channels = channels_of(file)
        file.unlink()
        return channels, seconds

    def draw(self, scene, order, frame):
        problems = refused(order, scene["light"], self.is_cycles)
        if problems:
            raise Refused(problems)
        settings = settings_of(order, scene["light"], self.is_cycles)
        channels, seconds = self._rendered(settings)
        position, shadow, shows = (planes_of_cycles if self.is_cycles else planes_of_eevee)(channels, self.scale)
        planes = {"position": numpy.where(shows[..., None], position, numpy.nan), "shadow": numpy.where(shows, shadow, 0)}
        if self.is_picture:
            unshadowed, _ = self._rendered(without_shadows(settings))
            planes |= mask_of_pictures(channels["Combined.R"], unshadowed["Combined.R"], PICTURE_BITS[self.engine])
            planes["valid"] *= shows  # a pixel may be lit but have no position
        for name, plane in planes.items():
            numpy.save(pathlib.Path(frame).with_name(name + ".npy"), plane.astype(numpy.float32))
        case = {"shadow_map": {"resolution": order["shadow_map"]["resolution"]}}
        return {"seconds": seconds, "files": {name: name + ".npy" for name in planes},
                "case": case if self.is_cycles and not self.is_picture else {**case, "channels": {"fractions": True}}}

    def close(self):
        if hasattr(self, "blender"):
            self.blender.close()
        if self.server:
            self.server.close()


def start():
    return BlenderRenderer(**read_options(sys.argv[1:], {"engine": list(NAMES), "rasterizer": list(RASTERIZERS), "mask": MASKS}))


if __name__ == "__main__":
    sys.exit(serve("blender", start))
