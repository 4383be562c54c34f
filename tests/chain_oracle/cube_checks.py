"""Checks of point lights: the faces' matrices, the places of lookups on them, and each face's numbers."""

from collections import Counter, defaultdict
from fractions import Fraction

import cause_chain as chain
import cube_faces

# Receivers a few metres off, interpolated and moved in float32, have some tens of roundings of 2^-24.
POSITION_TOLERANCE_M = 1e-5
COUNTS = ("lit", "blocked", "false_shadow", "false_lit", "shadow_amount", "light_amount")


def check_matrices(rows_of_maps, inputs):
    """The rows of x, y and w equal the table's; near and far map to the ends of the depth range."""
    position, near_m, far_m = ([float.fromhex(text) for text in inputs["light_position"]],
                               float.fromhex(inputs["near"]), float.fromhex(inputs["far"]))
    if len(rows_of_maps) != len(cube_faces.NAMES):
        yield f"{len(rows_of_maps)} maps"
    for face, rows in enumerate(rows_of_maps):
        x_row, y_row, z_row, w_row = rows
        if [x_row, y_row, w_row] != cube_faces.exact_rows(face, position):
            yield f"face {cube_faces.NAMES[face]}: rows of x, y, w are {x_row}, {y_row}, {w_row}"
        ends = []
        for zeta_m in (near_m, far_m):
            point = [p + zeta_m * a for p, a in zip(position, cube_faces.FORWARD[face])]
            ends.append((cube_faces.dot(z_row, [*point, 1])) / zeta_m)
        if not any(max(abs(a - b) for a, b in zip(ends, expected)) < 1e-5 for expected in ((-1, 1), (1, 0))):
            yield f"face {cube_faces.NAMES[face]}: near and far have the depths {ends}"


def check_place(rows_of_maps, position, lookup, place, nearer=0.0):
    """The face is that of the greatest component, and texel and depth are those of the place on it."""
    offset = [a - b for a, b in zip(place, position)]
    distances = [cube_faces.dot(forward, offset) for forward in cube_faces.FORWARD]
    zeta_m = distances[lookup.map_index]
    if max(distances) - zeta_m > POSITION_TOLERANCE_M:
        yield f"face {lookup.map_index} has {zeta_m}, another {max(distances)}"
        return
    count = lookup.settings.resolution
    _, u, v = cube_faces.AXES[lookup.map_index]
    for axis, texel in ((u, lookup.x), (v, lookup.y)):
        expected = (cube_faces.dot(axis, offset) / zeta_m + 1) * count / 2
        if abs(expected - float(texel)) > POSITION_TOLERANCE_M / zeta_m * count or not 0 <= texel <= count:
            yield f"texel {expected} here, {texel} there"
    z_row = rows_of_maps[lookup.map_index][2]
    depth = cube_faces.dot(z_row, [*place, 1]) / zeta_m
    depth = depth + nearer if lookup.settings.is_reversed else (depth + 1) / 2 - nearer
    if lookup.settings.outside == "clamp":
        depth = min(max(depth, 0), 1)
    if abs(depth - float(lookup.depth)) > POSITION_TOLERANCE_M * max(1, *(abs(value) for value in z_row)) / zeta_m:
        yield f"receiver depth {depth} here, {lookup.depth} there"


def check_lookups(oracle, pixel, x, y):
    """The two lookups lie at the receiver, and where the normal offset moves it."""
    position = [value / (1 << oracle.mesh.shift) for value in oracle.light.position]
    place = [float(Fraction(value, pixel.point[3] << oracle.mesh.shift)) for value in pixel.point[:3]]
    yield from check_place(oracle.rows, position, pixel.lookup, place)
    zeta_m = max(abs(a - b) for a, b in zip(place, position))
    texels = float.fromhex(oracle.run.json["exact_inputs"]["bias_normal_texels"])
    step_m = texels * 2 * zeta_m / oracle.settings.resolution
    normal = [float(oracle.run.pixels[f"N.{axis}"][y, x]) for axis in "XYZ"]
    moved = [a + step_m * b for a, b in zip(place, normal)]
    yield from check_place(oracle.rows, position, pixel.job_lookup, moved, float(oracle.moved(x, y)[3]))


def reads_over_seam(pixel):
    """Whether a tap of the job's lookup reads another face."""
    texels = (pixel.job_lookup.resolve(tap) for tap in pixel.job_lookup.footprint())
    return any(texel is not None and texel[0] != pixel.job_lookup.map_index for texel in texels)


class MapTally:
    """The numbers of each map in `by_map`."""

    def __init__(self):
        self.counts = defaultdict(Counter)
        self.causes, self.labels = defaultdict(Counter), defaultdict(Counter)

    def add(self, pixel, cause, label):
        at = pixel.job_lookup.map_index
        is_lit = pixel.truth == chain.LIT
        self.counts[at]["lit" if is_lit else "blocked"] += 1
        self.counts[at]["shadow_amount" if is_lit else "light_amount"] += abs(pixel.verdict - pixel.truth)
        if pixel.is_wrong():
            self.counts[at]["false_shadow" if is_lit else "false_lit"] += 1
            self.causes[at][cause] += 1
            self.labels[at][label] += 1

    def expected(self, at, inputs, count):
        """Pairs of a name and a value for a map's entry."""
        mine = {name: Fraction(self.counts[at][name]) for name in COUNTS}
        lit, blocked = mine["lit"], mine["blocked"]
        yield from mine.items()
        yield from ((f"causes.{name}", self.causes[at][name]) for name in chain.CAUSES)
        yield from ((f"labels.{name}", self.labels[at][name]) for name in chain.LABELS)
        yield from (("near_m", float.fromhex(inputs["near"])), ("far_m", float.fromhex(inputs["far"])))
        yield "texel_m", 2 / count
        quotients = {"false_shadow_rate": (mine["false_shadow"], lit), "false_lit_rate": (mine["false_lit"], blocked),
                     "error_rate": (mine["false_shadow"] + mine["false_lit"], lit + blocked),
                     "shadow_amount_rate": (mine["shadow_amount"], lit),
                     "light_amount_rate": (mine["light_amount"], blocked),
                     "mean_abs_error": (mine["shadow_amount"] + mine["light_amount"], lit + blocked)}
        for name, (part, whole) in quotients.items():
            yield name, part / whole if whole else None

    def differences(self, result, count):
        """A line for each number of `by_map` that differs, or does not sum to the image's."""
        entries = result.get("by_map", [])
        if [entry["map"] for entry in entries] != list(cube_faces.NAMES):
            yield f"by_map has {[entry['map'] for entry in entries]}"
            return
        for at, entry in enumerate(entries):
            for name, value in self.expected(at, result["exact_inputs"], count):
                if not is_same(value, member(entry, name)):
                    yield f"by_map {entry['map']} {name}: {value} here, {member(entry, name)} there"
        totals = result | {name: result["pixels"][name] for name in ("lit", "blocked")}
        names = [*COUNTS, *(f"causes.{name}" for name in chain.CAUSES), *(f"labels.{name}" for name in chain.LABELS)]
        for name in names:
            whole = sum(member(entry, name) for entry in entries)
            if not is_same(whole, member(totals, name)):
                yield f"by_map sums to {whole} {name}, and the image has {member(totals, name)}"


def member(entry, path):
    for part in path.split("."):
        entry = entry[part]
    return entry


def is_same(mine, theirs):
    """Equal up to the rounding of sums of some thousand taps."""
    if mine is None or theirs is None:
        return mine is theirs
    return abs(float(mine) - theirs) <= 1e-9
