"""exr_pixels.py RUN COUNT SEED: prints random pixels of a run's only image as JSON, a quarter of them wrong if it has as many.

Numbers are doubles; NaN and the infinities are texts.
"""

import json
import math
import sys
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "notebooks"))

import gnomon  # noqa: E402

NAMES = ("class", "verdict", "receiver_depth", "map_depth", "critical_bias", "needed_bias_m",
         "needed_bias_texels", "cause", "label", "prim", "witness", "map_index")


def value_of(number):
    if isinstance(number, numpy.floating):
        return float(number) if math.isfinite(number) else str(float(number))
    return int(number)


def main():
    run, count, seed = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    (path,) = (run / "pixels").glob("*.exr")
    layers = gnomon.load_layers(path)
    height, width = layers["class"].shape
    random = numpy.random.default_rng(seed)
    wrong = numpy.flatnonzero(layers["cause"])
    some_wrong = random.choice(wrong, min(len(wrong), count // 4), replace=False)
    anywhere = random.choice(height * width, count - len(some_wrong), replace=False)
    pixels = []
    for index in map(int, [*some_wrong, *anywhere]):
        y, x = divmod(index, width)
        pixels.append({"x": x, "y": y, **{name: value_of(layers[name][y, x]) for name in NAMES if name in layers}})
    json.dump({"width": width, "height": height, "pixels": pixels}, sys.stdout)


main()
