#!/usr/bin/env python3
"""Lets Gnomon drive VTK (docs/renderer_protocol.md). README.md explains how."""
import os
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "common" / "python"))

import numpy  # noqa: E402

from keys import boolean, choice, number, refusals  # noqa: E402
from picture import MASKS  # noqa: E402
from protocol import Refused, read_options, serve  # noqa: E402
from x_server import RASTERIZERS, XServer  # noqa: E402

LARGEST_MAP = 8192
KEYS = [
    boolean("ShadowMapPass", True, "vtkShadowMapPass stands in the sequence of passes: false draws no shadows"),
    choice("Window", ["image", "square"], "image",
           "the render window: of the image's size, or a square one that has the image in a corner; the map is drawn with its aspect"),
    number("ShadowAttenuation", 0, 1, 1, "", "vtkLight: how much of the light a shadow takes away"),
    boolean("FrontfaceCulling", False, "vtkProperty: what faces the camera is not seen, and what faces the light does not cast"),
    boolean("BackfaceCulling", False, "vtkProperty: what faces away from the camera is not seen, and from the light does not cast"),
]
WHY = "vtkShadowMapPass has no such setting"


def refuse_unsupported(order):
    engine = order["engine"]
    culls = engine["FrontfaceCulling"], engine["BackfaceCulling"]
    nothing_added = {f"bias.{key}": (0, "off") for key in ("constant", "constant_m", "slope", "normal_m", "normal_texels")}
    allowed = {"shadow_map.layout": ("single",), "shadow_map.reversed": (False,), "lookup.outside": ("lit",), **nothing_added}
    if culls in ((False, False), (True, False), (False, True)):
        allowed["shadow_map.cull"] = ({(False, False): "none", (True, False): "front", (False, True): "back"}[culls],)
    problems = refusals(order, KEYS, allowed, WHY)
    if order["shadow_map"]["resolution"] > LARGEST_MAP:
        problems["shadow_map.resolution"] = f"maps have at most {LARGEST_MAP} texels a side"
    if problems:
        raise Refused(problems)


class Vtk:
    """VTK and its display."""

    def __init__(self, rasterizer, mask):
        self.server, self.is_picture = XServer(), mask == "picture"
        os.environ.update(self.server.environment(rasterizer))
        try:
            from stage import Stage, VTK_VERSION  # VTK connects to the display when it is loaded
            self.stage, self.version = Stage(), VTK_VERSION
        except ImportError as problem:
            self.server.close()
            raise OSError(f"{problem}; apt-get install python3-vtk9") from problem

    def hello(self):
        return {"name": "VTK", "version": self.version, "device": self.stage.device()[:124], "keys": KEYS}

    def open(self, scene):
        if scene["light"]["type"] == "point":
            raise Refused("vtkShadowMapBakerPass draws no map for a light whose cone angle is 90 degrees or more: point lights cast nothing")
        self.stage.open(scene)

    def draw(self, scene, order, frame):
        refuse_unsupported(order)
        began = time.monotonic()
        planes, near, far = self.stage.draw(order["engine"], order["shadow_map"], self.is_picture)
        seconds = time.monotonic() - began
        for name, plane in planes.items():
            numpy.save(pathlib.Path(frame).with_name(name + ".npy"), plane)
        table = {"resolution": order["shadow_map"]["resolution"], **({} if near is None else {"near": near, "far": far})}
        return {"seconds": seconds, "files": {name: name + ".npy" for name in planes},
                "case": {"shadow_map": table, "channels": {"fractions": True}}}

    def close(self):
        self.stage.close()
        self.server.close()


if __name__ == "__main__":
    sys.exit(serve("vtk", lambda: Vtk(**read_options(sys.argv[1:], {"rasterizer": list(RASTERIZERS), "mask": MASKS}))))
