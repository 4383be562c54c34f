"""Packs raw dumps of the capture targets, and any other channel, into aov.exr.

    python3 pack_aov.py --width 1280 --height 720 --a a.raw [--b b.raw] [--c c.raw] [-o aov.exr]
    python3 pack_aov.py --channel P=position.npy --channel shadow.V=mask.npy --channel texel=texel.npy

Each dump holds width × height pixels of four little-endian float32, row by row from the top; with
--bottom-up from the bottom, as glReadPixels and glGetTexImage give them. a: P and the mask; b: normal and
object; c: r, d and the texel. --channel takes a vector (P, Ng, texel, kernel_axis, unmoved.texel, unmoved.kernel_axis) or a single channel
by its name in docs/evaluate.md, from a .npy file of float32 or a dump of as many floats a pixel as it has.
What is NaN in P is not judged; without P, which then the whole camera of case.toml must tell, what is NaN in
the mask. Needs Python 3.6 and numpy, nothing else.
"""

import argparse
import os
import struct
import sys
import zlib

import numpy

TARGETS = {
    "a": ("P.X", "P.Y", "P.Z", "shadow.V"),
    "b": ("Ng.X", "Ng.Y", "Ng.Z", "id.geom"),
    "c": ("z.light", "z.map", "texel.X", "texel.Y"),
}
VECTORS = {"P": "XYZ", "Ng": "XYZ", "texel": "XY", "kernel_axis": "XY", "unmoved.texel": "XY", "unmoved.kernel_axis": "XY"}
SINGLES = ("shadow.V", "valid", "id.geom", "z.light", "z.map", "map_index", "tan_theta", "unmoved.V",
           "unmoved.z.light", "unmoved.z.map", "unmoved.map_index")
POSITION = ("P.X", "P.Y", "P.Z")
ROWS_OF_BLOCK = 16  # of EXR's ZIP compression


def parse_arguments():
    parser = argparse.ArgumentParser(description="Packs raw dumps of the capture targets into aov.exr.")
    parser.add_argument("--width", type=int, help="of dumps [px]")
    parser.add_argument("--height", type=int, help="of dumps [px]")
    parser.add_argument("--a", help="P and the mask")
    parser.add_argument("--b", help="normal and object")
    parser.add_argument("--c", help="receiver depth, map depth, and the texel that was looked up")
    parser.add_argument("--channel", action="append", default=[], metavar="NAME=FILE",
                        help="a channel or vector of its own: " + ", ".join((*VECTORS, *SINGLES)))
    parser.add_argument("--bottom-up", action="store_true", help="the files begin with the lowest row")
    parser.add_argument("-o", "--output", default="aov.exr")
    return parser.parse_args()


def read_numbers(path):
    try:
        if path.lower().endswith(".npy"):
            return numpy.asarray(numpy.lib.format.open_memmap(path, mode="r"))
        if os.path.getsize(path) % 4 != 0:
            return sys.exit(f"{path}: {os.path.getsize(path)} bytes; a float has four")
        return numpy.fromfile(path, dtype="<f4")
    except OSError as error:
        return sys.exit(f"{path}: {error.strerror or error}")
    except Exception as error:  # numpy tells of a damaged header in many ways
        return sys.exit(f"{path}: no .npy file of floats: {str(error).splitlines()[0]}")


def load(path, count, arguments):
    """An image of so many floats a pixel, the top row first."""
    values = read_numbers(path)
    if path.lower().endswith(".npy"):
        if values.dtype != numpy.float32:
            sys.exit(f"{path}: {values.dtype} numbers; save array.astype('<f4')")
        height, width = values.shape[:2] if values.ndim in (2, 3) else (0, 0)
        if values.size != width * height * count or values.size == 0:
            sys.exit(f"{path}: the shape {values.shape}; it must be (height, width, {count})")
    else:
        width, height = arguments.width, arguments.height
        if not width or not height or width < 1 or height < 1:
            sys.exit(f"{path}: how large is the image? give --width and --height")
        if values.size != width * height * count:
            sys.exit(f"{path}: {values.size * 4} bytes, but {width}x{height} pixels of {count} floats are "
                     f"{width * height * count * 4}")
    image = values.reshape(height, width, count)
    return image[::-1] if arguments.bottom_up else image


def add(channels, names, path, arguments):
    image = load(path, len(names), arguments)
    for i, name in enumerate(names):
        if name in channels:
            sys.exit(f"{path}: {name} is given twice; keep one")
        channels[name] = image[:, :, i]


def names_of(word):
    name = word.split("=", 1)[0]
    if "=" not in word or name not in (*VECTORS, *SINGLES):
        sys.exit(f"--channel {word}: must be NAME=FILE, NAME one of {', '.join((*VECTORS, *SINGLES))}")
    return [f"{name}.{letter}" for letter in VECTORS[name]] if name in VECTORS else [name]


def read_channels(arguments):
    channels = {}
    for target, names in TARGETS.items():
        if getattr(arguments, target):
            add(channels, names, getattr(arguments, target), arguments)
    if arguments.c and not (channels["texel.X"].any() or channels["texel.Y"].any()):
        del channels["texel.X"], channels["texel.Y"]  # gnomon_depths leaves them 0
    for word in arguments.channel:
        add(channels, names_of(word), word.split("=", 1)[1], arguments)
    if "shadow.V" not in channels:
        sys.exit("no mask: give --a, or --channel shadow.V=FILE")
    sizes = {image.shape for image in channels.values()}
    if len(sizes) > 1:
        sys.exit("files of several sizes, " + ", ".join(f"{w}x{h}" for h, w in sorted(sizes))
                 + ": they must be of one frame")
    return channels


def drop_what_shows_nothing(channels):
    """The mask of pixels without a position, or without a mask, is 0 and they are not valid."""
    telling = [channels[name] for name in POSITION if name in channels] or [channels["shadow.V"]]
    seen = numpy.isfinite(telling).all(axis=0)
    channels["shadow.V"] = numpy.where(seen, channels["shadow.V"], numpy.float32(0))
    channels["valid"] = seen.astype("f4") * channels.get("valid", numpy.float32(1))
    return int((channels["valid"] != 0).sum())


def attribute(name, kind, value):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def header(names, width, height):
    """A scanline EXR file's, of 32-bit float channels (OpenEXR File Layout)."""
    channel_list = b"".join(name.encode() + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for name in names)
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    return (struct.pack("<II", 20000630, 2)
            + attribute("channels", "chlist", channel_list + b"\0")
            + attribute("compression", "compression", b"\3")  # ZIP
            + attribute("dataWindow", "box2i", window)
            + attribute("displayWindow", "box2i", window)
            + attribute("lineOrder", "lineOrder", b"\0")  # increasing y
            + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
            + attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
            + attribute("screenWindowWidth", "float", struct.pack("<f", 1))
            + b"\0")


def compressed(pixels):
    """A block as EXR's ZIP has it: bytes of even places, then of odd ones, as differences, deflated."""
    data = numpy.frombuffer(pixels, dtype="u1")
    split = numpy.concatenate([data[0::2], data[1::2]]).astype("i2")
    split[1:] = (split[1:] - split[:-1] + 128 + 256) % 256
    packed = zlib.compress(split.astype("u1").tobytes())
    return packed if len(packed) < len(pixels) else pixels


def exr_bytes(channels):
    names = sorted(channels)  # by bytes, as readers expect
    height, width = channels[names[0]].shape
    lines = numpy.stack([numpy.asarray(channels[name], dtype="<f4") for name in names], axis=1)
    head = header(names, width, height)
    tops = range(0, height, ROWS_OF_BLOCK)
    blocks = []
    for top in tops:
        packed = compressed(lines[top:top + ROWS_OF_BLOCK].tobytes())
        blocks.append(struct.pack("<ii", top, len(packed)) + packed)
    begin = len(head) + 8 * len(blocks)
    offsets = [begin + sum(len(block) for block in blocks[:i]) for i in range(len(blocks))]
    return head + struct.pack(f"<{len(offsets)}Q", *offsets) + b"".join(blocks)


def main():
    arguments = parse_arguments()
    channels = read_channels(arguments)
    inputs = [arguments.a, arguments.b, arguments.c, *(word.split("=", 1)[1] for word in arguments.channel)]
    if any(path and os.path.exists(arguments.output) and os.path.samefile(path, arguments.output)
           for path in inputs):
        sys.exit(f"{arguments.output}: the output is one of the inputs; name another with -o")
    judged = drop_what_shows_nothing(channels)
    height, width = channels["shadow.V"].shape
    try:
        with open(arguments.output, "wb") as output:
            output.write(exr_bytes(channels))
    except OSError as error:
        sys.exit(f"{arguments.output}: {error.strerror}")
    print(f"{arguments.output}: {width}x{height}, {judged} pixels show something; channels "
          f"{', '.join(sorted(channels))}")
    if POSITION[0] not in channels:
        print("without P: case.toml needs the whole camera, [camera] eye, target and the rest")


main()
