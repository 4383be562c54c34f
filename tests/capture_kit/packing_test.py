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
    """Writes a dump whose numbers all differ; most have no short decimal."""
    pixels = (numpy.arange(WIDTH * HEIGHT * 4, dtype="f4") + numpy.float32(first)) / numpy.float32(3)
    image = pixels.reshape(HEIGHT, WIDTH, 4)
    image.astype("<f4").tofile(KIT / name)
    return image


def run_packer(*arguments):
    return subprocess.run([sys.executable, str(KIT / "pack_aov.py"), "-o", str(KIT / "aov.exr"), *arguments],
                          capture_output=True, text=True)


def pack(*arguments):
    return run_packer("--width", str(WIDTH), "--height", str(HEIGHT), *arguments)


def save(name, *shape):
    """A .npy file of random floats, of all magnitudes and signs."""
    image = numpy.random.default_rng(len(name)).standard_normal(shape).astype("f4")
    numpy.save(KIT / name, image)
    return image


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
        numpy.testing.assert_array_equal(channels["texel.X"], layers["c"][::-1, :, 2])
        numpy.testing.assert_array_equal(channels["texel.Y"], layers["c"][::-1, :, 3])

    def test_depths_without_a_texel(self):
        dump("a.raw", 1)
        c = dump("c.raw", 1)
        c[:, :, 2:] = 0
        c.tofile(KIT / "c.raw")
        self.assertEqual(pack("--a", str(KIT / "a.raw"), "--c", str(KIT / "c.raw")).returncode, 0)
        channels = read()
        self.assertIn("z.map", channels)
        self.assertNotIn("texel.X", channels)

    def test_channels_of_their_own(self):
        # More rows than an EXR block. Noise does not compress, and equal numbers do.
        shape = (37, 11)
        images = {"P": save("p.npy", *shape, 3), "texel": save("texel.npy", *shape, 2),
                  "Ng": save("ng.npy", *shape, 3), "unmoved.texel": save("u.npy", *shape, 2)}
        singles = ("shadow.V", "id.geom", "z.light", "z.map", "map_index", "tan_theta", "unmoved.V",
                   "unmoved.z.light", "unmoved.z.map", "unmoved.map_index")
        images.update({name: save(f"{name}.npy", *shape) for name in singles})
        images["valid"] = numpy.ones(shape, dtype="f4")
        images["map_index"][:] = 3
        for name in ("valid", "map_index"):
            numpy.save(KIT / f"{name}.npy", images[name])
        files = {"P": "p.npy", "texel": "texel.npy", "Ng": "ng.npy", "unmoved.texel": "u.npy"}
        words = [f"--channel={name}={KIT / files.get(name, name + '.npy')}" for name in images]
        result = run_packer(*words)
        self.assertEqual(result.returncode, 0, result.stderr)
        channels = read()
        for name, image in images.items():
            letters = "XYZ"[:image.shape[2]] if image.ndim == 3 else ""
            for i, letter in enumerate(letters):
                numpy.testing.assert_array_equal(channels.pop(f"{name}.{letter}"), image[:, :, i], name)
            if not letters:
                numpy.testing.assert_array_equal(channels.pop(name), image, name)
        self.assertEqual(channels, {})

    def test_a_mask_alone(self):
        mask = save("mask.npy", 3, 5)
        mask[1, 2] = numpy.nan
        numpy.save(KIT / "mask.npy", mask)
        result = run_packer(f"--channel=shadow.V={KIT / 'mask.npy'}")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("needs the whole camera", result.stdout)
        channels = read()
        self.assertEqual(set(channels), {"shadow.V", "valid"})
        self.assertEqual(channels["valid"].sum(), 14)
        self.assertEqual(channels["valid"][1, 2], 0)

    def test_needs_nothing_but_numpy(self):
        dump("a.raw", 1)
        hidden = "import sys; sys.modules['OpenImageIO'] = None; import runpy; runpy.run_path(sys.argv.pop(1))"
        result = subprocess.run([sys.executable, "-c", hidden, str(KIT / "pack_aov.py"), "--width", str(WIDTH),
                                 "--height", str(HEIGHT), "--a", str(KIT / "a.raw"), "-o", str(KIT / "aov.exr")],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_refusals_are_one_line(self):
        dump("a.raw", 1)
        save("p.npy", 3, 5, 3)
        save("other.npy", 4, 5)
        numpy.save(KIT / "double.npy", numpy.zeros((3, 5)))
        (KIT / "bad.npy").write_bytes(b"no array")
        (KIT / "empty.npy").write_bytes(b"")
        (KIT / "odd.raw").write_bytes(b"\0" * 243)
        save("v.npy", 3, 5)
        numpy.savez(KIT / "zip", v=numpy.zeros(3))
        (KIT / "zip.npz").rename(KIT / "zip.npy")
        huge = numpy.lib.format.header_data_from_array_1_0(numpy.zeros((1, 1), "f4"))
        huge["shape"] = (1 << 20, 1 << 20)
        with open(KIT / "huge.npy", "wb") as file:
            numpy.lib.format.write_array_header_1_0(file, huge)
        p = f"--channel=P={KIT / 'p.npy'}"
        a = ("--width", "5", "--height", "3", "--a", str(KIT / "a.raw"))
        for arguments, message in [
                ((p,), "no mask"),
                ((f"--channel=shadow.V={KIT / 'zip.npy'}",), "no .npy file of floats"),
                ((f"--channel=shadow.V={KIT / 'empty.npy'}",), "empty.npy"),
                ((f"--channel=shadow.V={KIT / 'huge.npy'}",), "huge.npy"),
                ((*a[:4], "--a", str(KIT / "odd.raw")), "bytes; a float has four"),
                ((f"--channel=shadow.V={KIT / 'v.npy'}", "-o", str(KIT / "v.npy")), "is one of the inputs"),
                ((p, f"--channel=shadow.V={KIT / 'other.npy'}"), "files of several sizes, 5x3, 5x4"),
                ((p, f"--channel=shadow.V={KIT / 'double.npy'}"), "float64 numbers"),
                ((p, f"--channel=shadow.V={KIT / 'p.npy'}"), "must be (height, width, 1)"),
                ((p, f"--channel=shadow.V={KIT / 'bad.npy'}"), "bad.npy"),
                ((p, f"--channel=shadow.V={KIT / 'none.npy'}"), "none.npy"),
                ((*a, p), "P.X is given twice"),
                (("--a", str(KIT / "a.raw")), "give --width and --height"),
                (("--channel=colour=x.npy",), "must be NAME=FILE"),
                (("--channel=P",), "must be NAME=FILE"),
                ((*a, "-o", str(KIT)), "Is a directory")]:
            result = run_packer(*arguments)
            self.assertEqual(result.returncode, 1, (arguments, result.stderr))
            self.assertIn(message, result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)

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
        self.assertIn("64 bytes, but 5x3 pixels of 4 floats are 240", result.stderr)


unittest.main()
