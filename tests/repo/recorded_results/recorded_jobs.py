"""The jobs whose results are kept: a few of all that keys can say together, drawn once and for all."""

import hashlib
import itertools
from dataclasses import dataclass

BUILTIN = ("sphere-cube", "sphere-plane", "yard", "playground", "two-distances", "tilted-plane", "wall", "room",
           "fence", "terrain", "columns", "sphere-field")
SHARED = ("suzanne.obj", "bunny.obj", "nefertiti.obj")
VARIANTS = 14  # of each scene: every filter twice

SPOT = ("light.type=spot", "light.position=[4, 9, 5]", "light.target=[0, 0.5, 0]", "light.cone_deg=70")
SUN = ("light.type=directional", "light.direction=[-0.5, -1, -0.3]")
FILTERS = ("nearest", "linear", "hardware", "pcf3", "pcf5", "pcf7", "pcf9")
# Each choice is a list of settings, so that it may set several keys or none.
CHOICES = {
    "light": [(), (), SPOT],
    "resolution": [(f"shadow_map.resolution={texels}",) for texels in (64, 128, 200, 256, 512)],
    "format": [(f"shadow_map.depth_format={name}",)
               for name in ("d16", "d24", "d32", "d32f", "d24", "u8", "u12", "u24")],
    "bias": [(), ("bias.constant=0.002",), ("bias.slope=0.0015",), ("bias.normal_texels=1.5",),
             ("bias.constant=0.001", "bias.slope=0.0005"), ("bias.constant=-0.001",),
             ("bias.constant=0.0005", "bias.normal_texels=0.7")],
    "outside": [(f"lookup.outside={name}",) for name in ("lit", "shadowed", "clamp")],
    "cull": [(f"shadow_map.cull={name}",) for name in ("none", "none", "front", "back")],
    "fit": [("shadow_map.fit=scene",), ("shadow_map.fit=camera",), "fixed"],
    "planes": [(), (), ("shadow_map.near=1", "shadow_map.far=14")],
    "reversed": [("shadow_map.reversed=false",), ("shadow_map.reversed=true",)],
    "roll": [(), ("shadow_map.roll_deg=17",)],
}


@dataclass(frozen=True)
class RecordedJob:
    name: str
    kind: str  # compare, evaluate, tune or sweep
    scene: str
    arguments: tuple  # behind the scene

    @property
    def is_shared(self):
        return self.scene in SHARED

    def scene_arguments(self):
        """The scene on the command line. A shared scene is in the current folder."""
        if self.is_shared:
            return [self.scene, "--set", "scene.ground=true"]
        return ["--builtin", self.scene]


def chosen(key, number):
    """A pseudo-random choice of a key, which depends on the number alone."""
    digest = hashlib.sha256(f"{key} {number}".encode()).digest()
    return CHOICES[key][int.from_bytes(digest[:4], "big") % len(CHOICES[key])]


def settings(number, lookup_filter):
    light = chosen("light", number)
    picked = ["image.width=160", "image.height=90", f"lookup.filter={lookup_filter}", *light]
    for key in CHOICES:
        choice = chosen(key, number)
        if key == "light":
            continue
        if choice == "fixed":
            picked += light or SUN
            choice = ("shadow_map.fit=fixed",
                      "shadow_map.fov_deg=40" if light else "shadow_map.half_extent=4")
        picked += choice
    if light and not any(setting.startswith("bias.constant=") for setting in picked):
        picked.append("bias.constant=0")  # some scenes have a bias in metres, which a spot light cannot have
    return [argument for setting in dict.fromkeys(picked) for argument in ("--set", setting)]


def comparisons():
    scenes = itertools.cycle(BUILTIN + SHARED)
    extras = itertools.cycle((["--advise"], [], ["--verify"], [], [], ["--audit"], []))
    for number in range(VARIANTS * len(BUILTIN + SHARED)):
        scene = next(scenes)
        lookup_filter = FILTERS[number // len(BUILTIN + SHARED) % len(FILTERS)]
        yield RecordedJob(f"compare-{number:03}", "compare", scene,
                          (*settings(number, lookup_filter), *next(extras)))


def evaluations():
    for number, lookup_filter in enumerate(FILTERS):
        yield RecordedJob(f"evaluate-{number:03}", "evaluate", BUILTIN[number],
                          tuple(settings(1000 + number, lookup_filter)))


def tunings():
    for number, lookup_filter in enumerate(("nearest", "linear", "hardware", "pcf3", "pcf5")):
        yield RecordedJob(f"tune-{number:03}", "tune", BUILTIN[number],
                          ("--set", "image.width=96", "--set", "image.height=54", "--set",
                           f"lookup.filter={lookup_filter}", "--max-resolution", "512"))


AXES = {
    "constant": "bias.constant=0,0.0005,0.002,0.01",
    "metres": "bias.constant_m=0,0.01,0.05",
    "slope": "bias.slope=0,0.001",
    "normal": "bias.normal_texels=0,1.5",
    "resolution": "shadow_map.resolution=64,128,256",
    "format": "shadow_map.depth_format=d16,d32f,u10",
    "filter": "lookup.filter=nearest,linear,hardware,pcf3",
    "outside": "lookup.outside=lit,shadowed,clamp",
    "reversed": "shadow_map.reversed=false,true",
    "cull": "shadow_map.cull=none,front,back",
}
SWEPT = (("constant", "resolution"), ("constant", "filter"), ("constant", "format"), ("constant", "slope", "normal"),
         ("filter", "outside"), ("constant", "reversed"), ("cull", "constant"), ("resolution", "format"),
         ("filter", "normal"), ("constant", "outside", "reversed"))


def sweeps():
    scenes = itertools.cycle(BUILTIN + SHARED)
    for number in range(2 * len(SWEPT)):
        axes = [argument for axis in SWEPT[number % len(SWEPT)] for argument in ("--axis", AXES[axis])]
        extra = (["--keep-pixels"], ["--no-keep-pixels", "--verify"])[number % 2] if number >= len(SWEPT) else \
            ["--no-keep-pixels"]
        base = [argument for setting in ("image.width=96", "image.height=54") for argument in ("--set", setting)]
        yield RecordedJob(f"sweep-{number:03}", "sweep", next(scenes), (*base, *axes, *extra))


def recorded_jobs():
    """All of them: 210 comparisons, 7 of them as another renderer's, 5 tunings, 20 sweeps."""
    return [*comparisons(), *evaluations(), *tunings(), *sweeps()]
