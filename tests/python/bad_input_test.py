"""Invalid arguments of all functions."""

import random
import unittest

import gnomon
import numpy as np
from support import IS_FULL, SUN, plate


BAD_CALLS = [
    (lambda: gnomon.Scene([[0, 0, 0]], [[0, 0, 1]]), r"triangles\[0, 2\] is 1: there are 1 vertices"),
    (lambda: gnomon.Scene([[0, 0]], [[0, 0, 0]]), r"vertices has the shape \(1, 2\): it must be \(n, 3\)"),
    (lambda: gnomon.Scene([[0, float("nan"), 0]] * 3, [[0, 1, 2]]), r"vertices\[0\]: y is nan"),
    (lambda: gnomon.Scene("mesh", [[0, 1, 2]]), "vertices must be an array of numbers"),
    (lambda: gnomon.Scene(np.eye(3), np.eye(3)), "triangles must be an array of integers"),
    (lambda: gnomon.Scene(np.eye(3), [[0, 1, -1]]), r"triangles\[0, 2\] is -1"),
    (lambda: gnomon.Scene(np.zeros((0, 3)), np.zeros((0, 3), int)), "no triangle has an area"),
    (lambda: gnomon.Scene(np.eye(3), [[0, 1, 2]], objects={"a": 2}), "objects cover 2 of 1 triangles"),
    (lambda: gnomon.Scene(np.eye(3), [[0, 1, 2]], no_cast=["b"]), 'scene has no object of this name; the nearest is "mesh"'),
    (lambda: gnomon.load("nothing.obj"), "nothing.obj"),
    (lambda: gnomon.builtin("colums"), "columns"),
    (lambda: gnomon.builtin("columns", angle=1), "unknown key"),
    (lambda: gnomon.truth(plate(), [[0, 0]], SUN), r"points has the shape \(1, 2\)"),
    (lambda: gnomon.truth(plate(), [0, 0, 0], SUN), r"points has the shape \(3\)"),
    (lambda: gnomon.truth(plate(), [[0, 0, float("inf")]], SUN), r"points\[0\]: z is inf"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"directon": 1}), "light.directon=.*unknown key"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"direction": [0, 0, 0]}), "light.direction"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {}), "light"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"position": [0, 1, float("nan")]}), "light.position"),
    (lambda: gnomon.truth(plate(), triangles=[9], barycentrics=[[0, 0]], light=SUN), r"triangles\[0\] is 9: the scene has 4"),
    (lambda: gnomon.truth(plate(), triangles=[0], barycentrics=[[1, 1]], light=SUN), r"barycentrics\[0\] is \(1, 1\)"),
    (lambda: gnomon.truth(plate(), triangles=[0, 1], barycentrics=[[0, 0]], light=SUN), "2 triangles and 1 barycentrics"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], SUN, side="up"), 'side = "up"'),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], SUN, side=["x"]), "side = "),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], SUN, threads=100_000), "threads = 100000: must be a whole number"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], SUN, threads="x"), "threads = 'x'"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"position": [0, 1, 0], "cone_deg": 4}), "light.cone_deg"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"position": [0, 1, 0], "direction": [0, -1, 0], "cone_deg": 4}), "light.cone_deg"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], {"direction": 5}), "light.direction=5"),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], 5), "light must be a dict"),
    (lambda: gnomon.compare("wall", threads=-1), "threads = -1"),
    (lambda: gnomon.compare("wall", device=1.5), "device = 1.5"),
    (lambda: gnomon.compare(plate(), scene={"builtin": "wall"}), "scene.builtin: the job already is a scene"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN, np.zeros((4, 4, 3)), eye=[float("nan")] * 3), "eye: x is nan"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN, np.zeros((4, 4, 3)), eye=5), "eye = 5"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN, np.zeros((4, 4, 3)), image={"width": 7}), "image.width: the mask already sets"),
    (lambda: gnomon.Scene(np.eye(3), [[0, 1, 2]], objects={"a": 2**70}), r'objects\["a"\]'),
    (lambda: gnomon.truth(plate(), [[0, 0, 0]], SUN, project="up"), 'project = "up"'),
    (lambda: gnomon.compare("wall", bias={"constant": "x"}), r"bias.constant=.x.*must be a number"),
    (lambda: gnomon.compare("wall", bias={"constnt": 1}), "unknown key; the nearest is bias.constant"),
    (lambda: gnomon.compare({"bias": {"constant": 1}}), "no scene"),
    (lambda: gnomon.compare("wall", case="night"), "night"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN), "needs the whole camera"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN, np.zeros((4, 5, 3))), "positions has 5x4 pixels, the mask 4x4"),
    (lambda: gnomon.evaluate(np.full((4, 4), 2.0), plate(), SUN, np.zeros((4, 4, 3))), r"mask\[0, 0\] is 2"),
    (lambda: gnomon.evaluate(np.ones(4), plate(), SUN, np.zeros((4, 4, 3))), r"mask must have the shape \(height, width\)"),
    (lambda: gnomon.evaluate(np.ones((4, 4)), plate(), SUN, np.full((4, 4, 3), np.nan)), "no pixel can be scored"),
]


class BadInputTest(unittest.TestCase):
    def test_is_an_exception_that_names_argument_and_index(self):
        for number, (call, words) in enumerate(BAD_CALLS):
            with self.subTest(number=number, words=words):
                with self.assertRaisesRegex(gnomon.InputError, words) as caught:
                    call()
                self.assertNotIn("\n", str(caught.exception))

    def test_random_arguments_never_crash(self):
        seed = 7
        rng = random.Random(seed)
        numbers = [0, 1, -1, 2, 3, 1e300, float("nan"), float("inf"), -0.0, 1e-320, 2**32, 2**63 - 1]

        def array():
            shape = rng.choice([(0,), (3,), (1, 3), (5, 3), (2, 2), (0, 3), (2, 3, 3), ()])
            dtype = rng.choice([np.float64, np.float32, np.int64, np.int8, np.uint32, object, "U3"])
            with np.errstate(all="ignore"):
                try:
                    given = np.array([rng.choice(numbers) for _ in range(int(np.prod(shape)))], float)
                    return given.reshape(shape).astype(dtype)
                except (OverflowError, ValueError):
                    return None

        scene = plate()
        calls = 0
        for _ in range(20_000 if IS_FULL else 1_500):
            arguments = [array() for _ in range(3)]
            light = {rng.choice(["direction", "position", "target"]): [rng.choice(numbers) for _ in range(3)] for _ in range(2)}
            try:
                with np.errstate(all="ignore"):
                    kind = rng.randrange(4)
                    if kind == 0:
                        gnomon.Scene(arguments[0], arguments[1])
                    elif kind == 1:
                        gnomon.truth(scene, arguments[0], light)
                    elif kind == 2:
                        gnomon.truth(scene, triangles=arguments[0], barycentrics=arguments[1], light=light)
                    else:
                        gnomon.evaluate(arguments[0], scene, light, arguments[1])
            except (ValueError, TypeError, OverflowError):
                pass
            calls += 1
        self.assertGreater(calls, 1000, f"seed {seed}")
