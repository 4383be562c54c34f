"""The EXR image of a comparison, as numpy arrays."""

import json
from collections.abc import Mapping
from pathlib import Path

import numpy
import pandas

from .errors import InputError

# Indexed by the values of the layers `class`, `cause` and `label`.
CLASSES = ("background", "unmatched", "attached", "out_of_light", "indeterminate", "lit", "blocked")
CAUSES = ("none", "bias", "precision", "resolution", "coverage", "filter")
LABELS = ("right", "acne", "peter_panning", "leak", "edge", "overshadow", "bleed")


class Layers(Mapping):
    """The layers of an image by their names in docs/aov.md, each (height, width) of float32 or uint32.

    Row 0 is the top. `P` is the receiver point of each pixel [m], (height, width, 3).
    """

    def __init__(self, arrays, attributes):
        self._arrays = arrays
        self.attributes = attributes  # of the header, texts, without `gnomon:`
        self.job = json.loads(attributes.get("job", "{}"))  # every key of the job

    def __getitem__(self, name):
        return self._arrays[name]

    def __iter__(self):
        return iter(self._arrays)

    def __len__(self):
        return len(self._arrays)

    @property
    def is_lit(self):
        """(height, width) bool: lit pixels."""
        return self["class"] == CLASSES.index("lit")

    @property
    def is_blocked(self):
        """(height, width) bool: pixels in shadow."""
        return self["class"] == CLASSES.index("blocked")

    def shows_lit(self, bias=None):
        """(height, width) bool: the shadow map's verdicts at the job's constant bias or another.

        Exact for every float32 bias: the layer `critical_bias` is the smallest bias at which a pixel is
        lit. Values of unscored pixels are undefined. Raises InputError for another bias if the image
        lacks this layer, as other renderers' images may.
        """
        if bias is None:
            return self["verdict"] >= 0.5
        if "critical_bias" not in self:
            raise InputError("the image has no critical_bias, so verdicts at other biases are unknown")
        return self["critical_bias"] <= numpy.float32(bias)

    def errors(self, bias=None):
        """The numbers of false-shadow and false-lit pixels at a bias, as in `shows_lit`."""
        shown = self.shows_lit(bias)
        return {
            "false_shadow": int(numpy.count_nonzero(self.is_lit & ~shown)),
            "false_lit": int(numpy.count_nonzero(self.is_blocked & shown)),
        }

    def crop(self, names, box=None, keys=()):
        """A table with one row per pixel: `x_px`, `y_px`, the named layers, and keys of the job.

        box: left, top, width and height [px], the whole image by default; pixels are counted from
        the top left of the image. Raises InputError for a layer, key or box that the image lacks.
        """
        missing = [name for name in names if name not in self]
        missing += [key for key in keys if key not in self.job]
        if missing:
            raise InputError(f"the image has no {missing[0]}; see docs/aov.md")
        rows, columns = self[names[0]].shape[:2]
        left, top, width, height = box or (0, 0, columns, rows)
        if min(left, top, width - 1, height - 1) < 0 or left + width > columns or top + height > rows:
            raise InputError(f"the image is {columns} x {rows} pixels, which does not contain"
                             f" {width} x {height} at {left}, {top}")
        y_px, x_px = numpy.mgrid[top : top + height, left : left + width]
        table = {"x_px": x_px.ravel(), "y_px": y_px.ravel()}
        for name in names:
            layer = self[name][top : top + height, left : left + width].ravel()
            # Doubles are written with all digits of the floats.
            table[name] = layer.astype(float) if layer.dtype == numpy.float32 else layer
        return pandas.DataFrame({**table, **{key: self.job[key] for key in keys}})


def load_layers(path):
    """The layers of an EXR that `--aov`, `--out` or `--keep-pixels` wrote.

    Raises InputError if the file is missing or is another image.
    """
    arrays, attributes = _read(path, {"class", "verdict", "P.X", "P.Y", "P.Z"})
    points = numpy.stack([arrays[f"P.{axis}"] for axis in "XYZ"], axis=-1)
    return Layers({**arrays, "P": points}, attributes)


def load_depth_map(path):
    """The shadow map that `--depth-map` wrote: `depth` and `light_distance_m`.

    Raises InputError if the file is missing or is another image.
    """
    return Layers(*_read(path, {"depth", "light_distance_m"}))


def _read(path, needed):
    # Imported here, as figures read only tables and do not need this package.
    import OpenImageIO

    path = Path(path)
    if not path.exists():
        raise InputError(f"{path}: no such file")
    image = OpenImageIO.ImageInput.open(str(path))
    if image is None:
        raise InputError(f"{path}: cannot be read: {' '.join(OpenImageIO.geterror().split())}")
    try:
        spec = image.spec()
        arrays = {}
        for channel, name in enumerate(spec.channelnames):
            pixels = image.read_image(0, 0, channel, channel + 1, spec.channelformat(channel))
            if pixels is None:
                raise InputError(f"{path}: {name}: cannot be read; write the image again")
            arrays[name] = pixels[:, :, 0]
    finally:
        image.close()
    if not needed <= arrays.keys():
        raise InputError(f"{path}: was not written by gnomon compare; see docs/aov.md")
    return arrays, {
        attribute.name.removeprefix("gnomon:"): attribute.value
        for attribute in spec.extra_attribs
        if attribute.name.startswith("gnomon:")
    }
