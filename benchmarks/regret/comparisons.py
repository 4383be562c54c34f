"""Runs `gnomon compare`, and reads the scenes and views of the study from its results."""

import hashlib
import json
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy
import OpenImageIO

from recommendation import ErrorCurve
from regret import ScoredView
from views import Camera


@dataclass(frozen=True)
class Scene:
    """A built-in scene, or a scene file on ground."""

    name: str
    arguments: tuple
    settings: dict
    contents: str = ""  # a hash of the file, for the cache of views

    @staticmethod
    def builtin(name):
        return Scene(name, ("--builtin", name), {})

    @staticmethod
    def file(path):
        return Scene(path.stem, (str(path),), {"scene.ground": True},
                     hashlib.sha256(path.read_bytes()).hexdigest())


def hexadecimal(texts):
    return numpy.array([float.fromhex(text) for text in texts])


def read_channels(path, names):
    """Float channels of an EXR by name."""
    source = OpenImageIO.ImageInput.open(str(path))
    every = list(source.spec().channelnames)
    channels = [source.read_image(0, 0, every.index(name), every.index(name) + 1, "float")[:, :, 0] for name in names]
    source.close()
    return channels


class Program:
    """The program, the image's size, and a folder that caches compared views."""

    def __init__(self, path, threads, image, kept=None):
        self.path, self.threads, self.kept = Path(path).resolve(), threads, kept
        self.image = {"image.width": image[0], "image.height": image[1]}
        self.identity = hashlib.sha256(self.path.read_bytes()).hexdigest()
        if kept:
            kept.mkdir(parents=True, exist_ok=True)

    def builtin_names(self):
        listing = subprocess.run([self.path, "scenes"], capture_output=True, text=True, check=True).stdout
        return [line.split()[0] for line in listing.splitlines() if line and not line[0].isspace()]

    def arguments(self, scene, settings):
        result = ["compare", *scene.arguments, "--json"]
        for key, value in {**scene.settings, **self.image, **settings}.items():
            result += ["--set", f"{key}={json.dumps(value)}"]
        return result

    def compare(self, scene, settings, aov=None):
        """The JSON of a comparison; raises RuntimeError if it fails."""
        command = [self.path, *self.arguments(scene, settings), "--threads", str(self.threads)]
        command += ["--aov", str(aov)] if aov else []
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(map(str, command))} ended with {done.returncode}: {done.stderr.strip()}")
        return json.loads(done.stdout)

    def view(self, scene, settings):
        """A view, compared or from the cache."""
        key = repr((self.identity, scene.contents, self.arguments(scene, settings)))
        file = self.kept / f"{hashlib.sha256(key.encode()).hexdigest()}.npz" if self.kept else None
        if file and file.exists():
            with numpy.load(file) as data:
                return ScoredView(ErrorCurve(data["lit"], data["blocked"]), *data["lengths"].tolist(),
                                  bool(data["is_spot"]))
        view = self.new_view(scene, settings)
        if file:
            written = file.with_suffix(f".{id(view)}.part")
            with written.open("wb") as out:
                numpy.savez(out, lit=view.curve.lit, blocked=view.curve.blocked, is_spot=view.is_spot,
                            lengths=[view.median_light_distance_m, view.near_m, view.far_m, view.texel_m])
            written.rename(file)
        return view

    def new_view(self, scene, settings):
        with tempfile.TemporaryDirectory(prefix="gnomon_regret_") as folder:
            aov = Path(folder) / "view.exr"
            result = self.compare(scene, settings, aov)
            truth, critical, light_distance_m = read_channels(aov, ["truth", "critical_bias", "light_distance_m"])
        scored = truth >= 0
        frustum = result["frustum"]
        view = ScoredView(ErrorCurve(critical[truth == 1], critical[truth == 0]),
                          float(numpy.median(light_distance_m[scored])) if scored.any() else float("nan"),
                          frustum["near_m"], frustum["far_m"], frustum["texel_m"],
                          frustum["projection"] == "perspective")
        measured = result["false_shadow"] + result["false_lit"]
        if view.curve.errors_at(0) != measured:  # the study's jobs have no bias
            raise RuntimeError(f"{scene.name}: {measured} errors, but {view.curve.errors_at(0)} by the critical biases")
        return view

    def box(self, scene, settings):
        """The scene's bounding box, read from the frustum of a map that is fitted to the scene and looks straight down."""
        down = {"light.type": "directional", "light.direction": [0, -1, 0], "shadow_map.fit": "scene",
                "shadow_map.near": "auto", "shadow_map.far": "auto", "shadow_map.resolution": 16,
                "bias.constant": 0}
        result = self.compare(scene, {**settings, **down})
        clip_from_world = hexadecimal(result["exact_inputs"]["light_clip_from_world"]).reshape(4, 4)
        padding = 1 + 2e-4  # the margin of automatic planes
        ends = numpy.array([[-1, -1, -1 / padding, 1], [1, 1, 1 / padding, 1]])
        corners = numpy.linalg.solve(clip_from_world, ends.T)[:3].T
        return corners.min(axis=0), corners.max(axis=0), result

    def camera_and_box(self, scene):
        """The job's own camera, and (lower, upper) of the whole scene's box."""
        lower, upper, result = self.box(scene, {})
        exact, job = result["exact_inputs"], result["job"]
        eye, forward, right, up = (hexadecimal(exact[name]) for name in ("eye", "forward", "right", "up"))
        if "camera.target" in job:
            target = numpy.array(job["camera.target"], float)
            up_hint = tuple(job["camera.up"])
            lens = next((key, job[key]) for key in ("camera.vertical_fov_deg", "camera.orthographic_height")
                        if key in job)
        else:  # framed: looks at the centre of the box without ground, with the default field of view
            bare = self.box(scene, {"scene.ground": False})
            target = eye + forward * (forward @ (0.5 * (bare[0] + bare[1]) - eye))
            up_hint, lens = (0, 1, 0), ("camera.vertical_fov_deg", 45)
        return Camera(eye, target, forward, right, up, up_hint, lens), (lower, upper)
