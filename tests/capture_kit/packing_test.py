"""Packs dumps with the kit's pack_aov.py, and reads them back."""

import pathlib
import subprocess
import sys
import unittest

import numpy
import OpenImageIO as oiio

KIT = pathlib.Path(sys.argv.pop())
WIDTH, HEIGHT = 5, 3


def dump(name, first):
    """Every number of the image is another one; bits that no decimal has are among them."""
    pixels = (numpy.arange(WIDTH * HEIGHT * 4, dtype="f4") + numpy.float32(first)) / numpy.float32(3)
    image = pixels.reshape(HEIGHT, WIDTH, 4)
    image.astype("<f4").tofile(KIT / name)
    return image


def pack(*arguments):
    return subprocess.run([sys.executable, str(KIT / "pack_aov.py"), "--width", str(WIDTH), "--height",
                           str(HEIGHT), "-o", str(KIT / "aov.exr"), *arguments],
                          capture_output=True, text=True)


def read():
    image = oiio.ImageInput.open(str(KIT / "aov.exr"))
    spec = image.spec()
    pixels = image.read_image(oiio.FLOAT)
    assert spec.format == oiio.FLOAT
    return {name: pixels[:, :, i] for i, name in enumerate(spec.channelnames)}


class Packing(unittest.TestCase):
    def test_level_0(self):
        a = dump("a.raw", 1)
        self.assertEqual(pack("--a", str(KIT / "a.raw")).returncode, 0)
        channels = read()
        self.assertEqual(set(channels), {"P.X", "P.Y", "P.Z", "shadow.V", "valid"})
        for i, name in enumerate(("P.X", "P.Y", "P.Z", "shadow.V")):
            numpy.testing.assert_array_equal(channels[name], a[:, :, i])
        self.assertTrue((channels["valid"] == 1).all())

    def test_all_targets_bottom_up(self):
        layers = {k: dump(f"{k}.raw", 100 * i) for i, k in enumerate("abc")}
        files = [x for k in "abc" for x in (f"--{k}", str(KIT / f"{k}.raw"))]
        self.assertEqual(pack(*files, "--bottom-up").returncode, 0)
        channels = read()
        numpy.testing.assert_array_equal(channels["P.Y"], layers["a"][::-1, :, 1])
        numpy.testing.assert_array_equal(channels["Ng.Z"], layers["b"][::-1, :, 2])
        numpy.testing.assert_array_equal(channels["id.geom"], layers["b"][::-1, :, 3])
        numpy.testing.assert_array_equal(channels["z.light"], layers["c"][::-1, :, 0])
        numpy.testing.assert_array_equal(channels["z.map"], layers["c"][::-1, :, 1])

    def test_pixels_that_show_nothing(self):
        a = dump("a.raw", 1)
        a[1, 2] = numpy.nan
        a.tofile(KIT / "a.raw")
        self.assertEqual(pack("--a", str(KIT / "a.raw")).returncode, 0)
        channels = read()
        self.assertEqual(channels["valid"][1, 2], 0)
        self.assertEqual(channels["valid"].sum(), WIDTH * HEIGHT - 1)
        self.assertTrue(numpy.isfinite(channels["shadow.V"]).all())

    def test_dump_of_another_size(self):
        (KIT / "a.raw").write_bytes(b"\0" * 64)
        result = pack("--a", str(KIT / "a.raw"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("64 bytes, but 5x3 pixels of four floats are 240", result.stderr)


unittest.main()
