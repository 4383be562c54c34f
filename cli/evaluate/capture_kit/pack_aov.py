"""Packs raw dumps of the capture targets into aov.exr.

    /usr/bin/python3 pack_aov.py --width 1280 --height 720 --a a.raw [--b b.raw] [--c c.raw] [-o aov.exr]

Each dump holds width × height pixels of four little-endian float32, row by row from the top; with
--bottom-up from the bottom, as glReadPixels and glGetTexImage give them. a: P and the mask; b: normal and
object; c: r and d. Needs Debian's python3-openimageio and python3-numpy.
"""

import argparse
import sys

import numpy
import OpenImageIO as oiio

CHANNELS = {
    "a": ("P.X", "P.Y", "P.Z", "shadow.V"),
    "b": ("Ng.X", "Ng.Y", "Ng.Z", "id.geom"),
    "c": ("z.light", "z.map"),
}


def parse_arguments():
    parser = argparse.ArgumentParser(description="Packs raw dumps of the capture targets into aov.exr.")
    parser.add_argument("--width", type=int, required=True, help="[px]")
    parser.add_argument("--height", type=int, required=True, help="[px]")
    parser.add_argument("--a", required=True, help="P and the mask")
    parser.add_argument("--b", help="normal and object")
    parser.add_argument("--c", help="receiver depth and map depth")
    parser.add_argument("--bottom-up", action="store_true", help="the dumps begin with the lowest row")
    parser.add_argument("-o", "--output", default="aov.exr")
    return parser.parse_args()


def load(path, width, height, is_bottom_up):
    values = numpy.fromfile(path, dtype="<f4")
    if values.size != width * height * 4:
        sys.exit(f"{path}: {values.size * 4} bytes, but {width}x{height} pixels of four floats are "
                 f"{width * height * 16}")
    image = values.reshape(height, width, 4)
    return image[::-1] if is_bottom_up else image


def main():
    arguments = parse_arguments()
    names, layers = [], []
    for target, channels in CHANNELS.items():
        path = getattr(arguments, target)
        if path:
            image = load(path, arguments.width, arguments.height, arguments.bottom_up)
            names += channels
            layers.append(image[:, :, :len(channels)])
    pixels = numpy.concatenate(layers, axis=2)
    seen = numpy.isfinite(pixels[:, :, :3]).all(axis=2)
    pixels[:, :, 3][~seen] = 0  # the mask of pixels that show nothing
    names.append("valid")
    pixels = numpy.ascontiguousarray(
        numpy.concatenate([pixels, seen[:, :, None].astype("f4")], axis=2), dtype="f4")
    spec = oiio.ImageSpec(arguments.width, arguments.height, len(names), oiio.FLOAT)
    spec.channelnames = names
    spec.attribute("compression", "zip")
    output = oiio.ImageOutput.create(arguments.output)
    if not output or not output.open(arguments.output, spec) or not output.write_image(pixels):
        sys.exit(f"{arguments.output}: {output.geterror() if output else oiio.geterror()}")
    output.close()
    print(f"{arguments.output}: {arguments.width}x{arguments.height}, {int(seen.sum())} pixels show "
          f"something; channels {', '.join(names)}")


main()
