#!/usr/bin/python3
"""Computes the causes and labels of wrong pixels in exact integers, and compares them with Gnomon's.

    chain_oracle.py PROGRAM [--jobs N] [--seed S] [--only K] [--keep DIR]

PROGRAM compares ten small scenes with N seeded jobs each. The oracle derives the verdict and the truth of every scored
pixel from the exact inputs, the cause and the label of every wrong or partial pixel, and the sums of the job. It shares
no code with the program and follows docs/causes.md and docs/truth.md. DIR keeps the job files and images.

Exit status: 0 if nothing differs and every cause and label occurred; 1 otherwise; 77 if OpenImageIO or numpy is missing.
"""

import argparse
import json
import random
import subprocess
import sys
import tempfile
from collections import Counter
from fractions import Fraction
from pathlib import Path

try:
    import numpy
    import OpenImageIO
except ImportError:
    print("SKIPPED: Debian's python3-openimageio and python3-numpy are missing")
    sys.exit(77)

import cause_chain as chain
import cube_checks
import exact_geometry as geometry
import small_scenes
from map_lookup import Lookup, Settings

NO_TRIANGLE = 0xFFFFFFFF
CLASS_LIT, CLASS_BLOCKED = 5, 6
LABELS_THAT_OCCUR = set(chain.LABELS) - {"bleed"}


def read_parts(path):
    """The channels of an EXR's parts by name, top row first. Integers stay integers."""
    source = OpenImageIO.ImageInput.open(str(path))
    parts = {}
    while source.seek_subimage(len(parts), 0):
        spec = source.spec()
        channels = {}
        for index, name in enumerate(spec.channelnames):
            form = str(spec.channelformat(index))
            data = source.read_image(len(parts), 0, index, index + 1, form if form == "uint" else "float")
            channels[name] = numpy.asarray(data)[:, :, 0]
        parts[spec.getattribute("oiio:subimagename") or str(len(parts))] = channels
    source.close()
    return parts


def floats(texts):
    """Parses hexadecimal doubles."""
    return [float.fromhex(text) for text in texts]


def matrix_rows(texts):
    """The rows of a matrix of 16 hexadecimal doubles."""
    values = floats(texts)
    return [values[4 * k:4 * k + 4] for k in range(4)]


class Run:
    """One `gnomon compare` and its results."""

    def __init__(self, program, job_file, settings=()):
        stem = job_file.with_suffix("")
        tag = "plain" if settings else "job"
        aov, depth_map = Path(f"{stem}.{tag}.exr"), Path(f"{stem}.{tag}.map.exr")
        command = [program, "compare", str(job_file), "--json", "--threads", "1", "--aov", str(aov),
                   "--depth-map", str(depth_map)]
        for setting in settings:
            command += ["--set", setting]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}\nended with {done.returncode}: {done.stderr}")
        self.json = json.loads(done.stdout)
        (self.pixels,) = read_parts(aov).values()
        maps = read_parts(depth_map)
        self.map_names = list(maps)
        self.stored = [channels["depth"] for channels in maps.values()]


def job_value(result, key):
    """A key of the job, nested in the JSON or not."""
    job = result["job"]
    if key in job:
        return job[key]
    for part in key.split("."):
        job = job[part]
    return job


class Camera:
    """The documented pixel rays in double."""

    def __init__(self, inputs, width, height):
        self.is_perspective = inputs["projection"] == "perspective"
        self.eye, self.forward, self.right, self.up = (floats(inputs[name])
                                                       for name in ("eye", "forward", "right", "up"))
        self.half_height = float.fromhex(inputs["half_height"])
        self.width, self.height = width, height

    def ray(self, x, y):
        sx = (2 * (x + 0.5) / self.width - 1) * (self.width / self.height) * self.half_height
        sy = (1 - 2 * (y + 0.5) / self.height) * self.half_height
        base = self.forward if self.is_perspective else self.eye
        moved = [base[k] + sx * self.right[k] + sy * self.up[k] for k in range(3)]
        return (self.eye, moved) if self.is_perspective else (moved, self.forward)


class Oracle:
    """A job's exact inputs and its pixels."""

    def __init__(self, triangles, run, plain_run):
        inputs = run.json["exact_inputs"]
        self.run, self.plain_run, self.triangles = run, plain_run, triangles
        self.light_place = floats(inputs["light_position" if inputs["light_type"] != "directional" else "light_direction"])
        height, width = run.pixels["prim"].shape
        self.camera = Camera(inputs, width, height)
        keys = ("shadow_map.resolution", "shadow_map.reversed", "lookup.filter", "lookup.outside")
        self.settings = Settings({key: job_value(run.json, key) for key in keys}, inputs["light_type"] == "point")
        self.rows = [matrix_rows(inputs[name]) for name in inputs if name.startswith("light_clip_from_world")]
        self.has_position = inputs["light_type"] != "directional"
        mesh = geometry.Mesh(triangles, self.world_shift(triangles, inputs))
        light = geometry.Light(position=mesh.point(floats(inputs["light_position"]))) if self.has_position else \
            geometry.Light(direction=mesh.point(floats(inputs["light_direction"])))
        self.mesh = mesh
        self.light = light
        cull = job_value(run.json, "shadow_map.cull")
        self.views = [chain.LightView(mesh, light, rows, self.settings.resolution, cull, self.settings.is_reversed)
                      for rows in self.rows]
        self.constant = numpy.float32(float.fromhex(inputs["bias_constant"]))
        self.slope = numpy.float32(float.fromhex(inputs["bias_slope"]))

    def world_shift(self, triangles, inputs):
        """A power of two whose multiples of all coordinates are integers."""
        points = [value for triangle in triangles for corner in triangle for value in corner] + self.camera.eye
        points += floats(inputs["light_position" if self.has_position else "light_direction"])
        count = self.settings.resolution
        if not self.camera.is_perspective:
            points += [value for x in range(self.camera.width) for y in range(self.camera.height)
                       for value in self.camera.ray(x, y)[0]]
        if not self.has_position:
            points += [value for rows in self.rows for x in range(count) for y in range(count)
                       for value in chain.texel_ray(rows, (x, y), count, True, self.settings.is_reversed)[0]]
        return geometry.shift_of(points)

    def lookup(self, run, x, y):
        values = (run.pixels[name][y, x] for name in ("receiver_depth", "texel.X", "texel.Y", "map_depth"))
        map_index = int(run.pixels["map_index"][y, x]) if self.settings.is_cube else 0
        return Lookup(self.settings, *values, map_index)

    def receiver(self, x, y):
        eye, direction = self.camera.ray(x, y)
        direction = geometry.scaled(direction, geometry.shift_of(direction))
        triangle = int(self.run.pixels["prim"][y, x])
        return geometry.receiver_point(self.mesh, triangle, self.mesh.point(eye), direction)

    def verdict(self, x, y):
        """GL's verdict, rounded to a fraction of K x K taps."""
        value = Fraction(float(self.run.pixels["verdict"][y, x]))
        taps = self.settings.taps ** 2
        whole = round(value * taps)
        return Fraction(whole, taps) if abs(value - Fraction(whole, taps)) < Fraction(1, 10 ** 6) else value

    def pixel(self, x, y):
        channels = self.run.pixels
        bias = numpy.float32(self.constant + numpy.float32(self.slope * channels["tan_theta"][y, x]))
        truth = chain.LIT if channels["class"][y, x] == CLASS_LIT else chain.BLOCKED
        lookups = (self.lookup(self.run, x, y), self.lookup(self.plain_run, x, y))
        return chain.Pixel(self.views, self.settings, self.run.stored, int(channels["prim"][y, x]),
                           self.receiver(x, y), truth, self.verdict(x, y), lookups, bias, self.moved(x, y))

    def moved(self, x, y):
        """The float32 offset and depth of the bias terms beside constant and slope."""
        names = ("moved.X", "moved.Y", "moved.Z", "moved.depth")
        channels = self.run.pixels
        return [channels[name][y, x] if name in channels else numpy.float32(0) for name in names]


class Tally:
    """The sums of the JSON over a job's pixels."""

    def __init__(self):
        self.causes, self.labels = Counter(), Counter()
        self.cause_amounts, self.label_amounts = Counter(), Counter()
        self.softening = {chain.LIT: Fraction(0), chain.BLOCKED: Fraction(0)}
        self.unassigned = Fraction(0)
        self.checked = Counter()
        self.maps = cube_checks.MapTally()

    def add(self, pixel, cause, label):
        if pixel.is_wrong():
            self.causes[cause] += 1
            self.labels[label] += 1
        self.checked[cause] += 1
        self.checked[label] += 1
        parts = pixel.label_amounts(cause, label)
        self.cause_amounts[cause] += abs(pixel.verdict - pixel.truth)
        self.label_amounts.update(parts)
        if cause == chain.FILTER and pixel.settings.taps > 1:
            self.softening[pixel.truth] += parts[chain.EDGE]

    def differences(self, result):
        """A line for each sum of the JSON that differs."""
        members = {"shadow_softening": self.softening[chain.LIT], "light_softening": self.softening[chain.BLOCKED],
                   "softening": sum(self.softening.values()), "unassigned": self.unassigned}
        pairs = [(name, value, result[name]) for name, value in members.items()]
        for name, names in (("causes", chain.CAUSES), ("labels", chain.LABELS),
                            ("cause_amounts", chain.CAUSES), ("label_amounts", chain.LABELS)):
            pairs += [(f"{name}.{key}", getattr(self, name)[key], result[name][key]) for key in names]
        # Sums of whole taps, divided once, over at most 2560 pixels: roundings of a double.
        return [f"{name}: {float(mine)} here, {theirs} there" for name, mine, theirs in pairs
                if abs(float(mine) - theirs) > 1e-9]


def name_of(names, code):
    return next((name for name, value in names.items() if value == code), "none")


def check_receiver(oracle, pixel, x, y):
    """Compares P, the truth and the witness."""
    channels = oracle.run.pixels
    world = [Fraction(value, pixel.point[3] << oracle.mesh.shift) for value in pixel.point[:3]]
    for axis, value in zip("XYZ", world):
        if abs(float(value) - float(channels[f"P.{axis}"][y, x])) > 1e-6:
            yield f"P.{axis} is {float(value)} here, {channels[f'P.{axis}'][y, x]} there"
    found, _ = geometry.crossings(oracle.mesh, pixel.triangle, pixel.point, oracle.light, lambda _: True)
    if bool(found) != (pixel.truth == chain.BLOCKED):
        yield f"truth: crossed by {[triangle for _, triangle in found]} here, {pixel.truth} there"
    witness = int(channels["witness"][y, x])
    if found and witness not in {triangle for _, triangle in found}:
        yield f"witness {witness} does not cross, {[triangle for _, triangle in found]} do"


def check_lookup(pixel, x, y):
    """Compares GL's verdict and depth with those that follow from the stored depths."""
    mine = pixel.job_verdict()
    if mine != pixel.verdict:
        yield f"verdict {mine} here, {pixel.verdict} there"
    lookup = pixel.job_lookup
    if pixel.settings.filter != "linear":
        texel = lookup.resolve(lookup.centre())
        same = numpy.isnan(lookup.map_depth) if texel is None else lookup.map_depth == pixel.stored_depth(texel)
        if not same:
            yield f"map_depth {lookup.map_depth} is not that of texel {texel}"


def check_offset(oracle, pixel, x, y):
    """Checks that the normal offset is the job's, in texels, along the geometric normal towards the light."""
    texels = job_value(oracle.run.json, "bias.normal_texels")
    rows, point = oracle.rows[pixel.lookup.map_index], pixel.point
    world = [float(Fraction(value, point[3] << oracle.mesh.shift)) for value in point[:3]]
    a, b, c = oracle.triangles[pixel.triangle]
    normal = numpy.cross(numpy.subtract(b, a), numpy.subtract(c, a))
    to_light = numpy.subtract(oracle.light_place, world) if oracle.has_position else numpy.negative(oracle.light_place)
    normal *= (1 if normal.dot(to_light) >= 0 else -1) / numpy.linalg.norm(normal)
    width = 2 * numpy.dot(rows[3], [*world, 1]) / (oracle.settings.resolution * numpy.linalg.norm(rows[0][:3]))
    error = numpy.linalg.norm(texels * width * normal - [float(value) for value in pixel.offset])
    # A dozen float32 roundings of positions up to 4 times the light's distance: 2^-18 of the length.
    if error > 2 ** -18 * abs(texels * width):
        yield f"P' - P is {texels * width * normal} here, {pixel.offset} there"


def details(pixel, cause):
    """The pixel's verdicts and taps, for a report."""
    taps = [(tap, pixel.tap_is_lit_in_job(tap), pixel.sees_own_sheet(pixel.job_lookup.resolve(tap)))
            for tap in pixel.job_lookup.footprint()]
    return (f"truth {pixel.truth}, triangle {pixel.triangle}, r {pixel.lookup.depth}, bias {pixel.bias},"
            f" texel ({pixel.lookup.x}, {pixel.lookup.y}), V0 {pixel.verdict}, V1 {pixel.stored_verdict()},"
            f" V2 {pixel.exact_verdict(pixel.exact_lookup)}, V2n {pixel.single_verdict()}, V3 {pixel.fine_verdict()}, cause {cause};"
            f" taps (texel, lit in V0, self-shadowing surface) {taps}")


def check_pixel(oracle, x, y, tally):
    """The differences of one scored pixel."""
    pixel = oracle.pixel(x, y)
    yield from check_receiver(oracle, pixel, x, y)
    yield from check_lookup(pixel, x, y)
    yield from check_offset(oracle, pixel, x, y)
    if oracle.settings.is_cube:
        yield from cube_checks.check_lookups(oracle, pixel, x, y)
        tally.checked["over seams"] += cube_checks.reads_over_seam(pixel)
        tally.checked[oracle.run.map_names[pixel.job_lookup.map_index]] += 1
    theirs = (name_of(chain.CAUSES, oracle.run.pixels["cause"][y, x]),
              name_of(chain.LABELS, oracle.run.pixels["label"][y, x]))
    if not pixel.is_wrong() and not pixel.is_partial():
        tally.unassigned += abs(pixel.verdict - pixel.truth)
        tally.maps.add(pixel, None, None)
        if theirs != ("none", "none"):
            yield f"neither wrong nor partial here, {theirs} there"
        return
    cause = pixel.cause()
    label = pixel.label(cause)
    tally.add(pixel, cause, label)
    tally.maps.add(pixel, cause, label)
    if (cause, label) != theirs:
        yield f"{cause}, {label} here, {theirs[0]}, {theirs[1]} there; {details(pixel, cause)}"


def check_job(program, job, triangles, job_file):
    """Runs one job. Returns its differences as lines, and its tally."""
    job_file.write_text(small_scenes.job_text(job))
    run = Run(program, job_file)
    terms = [key for key in small_scenes.TERM_KEYS if job.get(key)]
    plain_run = Run(program, job_file, [f"{key}=0" for key in terms]) if terms else run
    oracle = Oracle(triangles, run, plain_run)
    tally, lines = Tally(), []
    classes = run.pixels["class"]
    for y, x in zip(*numpy.nonzero((classes == CLASS_LIT) | (classes == CLASS_BLOCKED))):
        tally.checked["scored"] += 1
        lines += [f"pixel ({x}, {y}): {line}" for line in check_pixel(oracle, x, y, tally)]
    lines += tally.differences(run.json)
    if oracle.settings.is_cube:
        lines += cube_checks.check_matrices(oracle.rows, run.json["exact_inputs"])
        lines += tally.maps.differences(run.json, oracle.settings.resolution)
    return lines, tally


def check_scene(program, index, seed, jobs, folder):
    """Runs all jobs of a scene and prints the differences. Returns the tally and their number."""
    source = random.Random(f"{seed} {index}")
    name = small_scenes.MESHES[index].__name__
    objects = small_scenes.build(index, source)
    (folder / f"{name}.obj").write_text(small_scenes.obj_text(objects))
    triangles = [triangle for part in objects.values() for triangle in part if small_scenes.has_area(triangle)]
    total, count = Counter(), 0
    for number in range(jobs):
        job = small_scenes.random_job(source, f"{name}.obj")
        lines, tally = check_job(program, job, triangles, folder / f"{name}_{number}.toml")
        total.update(tally.checked)
        count += len(lines)
        for line in lines[:20]:
            print(f"{name}_{number}: {line}")
        if len(lines) > 20:
            print(f"{name}_{number}: and {len(lines) - 20} more")
    return total, count


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--jobs", type=int, default=4, help="jobs of each scene")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int, action="append", help="a scene by its number, from 0")
    parser.add_argument("--keep", type=Path, help="a folder for job files and images")
    return parser.parse_args()


def check_all(options, folder):
    total, count = Counter(), 0
    for index in options.only or range(len(small_scenes.MESHES)):
        checked, differences = check_scene(options.program, index, options.seed, options.jobs, folder)
        total.update(checked)
        count += differences
    for name in ["scored", *chain.CAUSES, *sorted(LABELS_THAT_OCCUR)]:
        print(f"{name}: {total[name]} pixels")
    missing = [] if options.only else sorted((set(chain.CAUSES) | LABELS_THAT_OCCUR) - set(total))
    for name in missing:
        print(f"no pixel is {name}: the scenes do not test it")
    print(f"{count} differences")
    return 1 if count or missing else 0


def main():
    options = arguments()
    if options.keep:
        options.keep.mkdir(parents=True, exist_ok=True)
        return check_all(options, options.keep)
    with tempfile.TemporaryDirectory() as folder:
        return check_all(options, Path(folder))


if __name__ == "__main__":
    sys.exit(main())
