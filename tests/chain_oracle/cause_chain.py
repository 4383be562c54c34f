"""The cause chain and the labels of one pixel, by docs/causes.md, with exact geometry.

A `LightView` traces the texel rays of one map. A `Pixel` combines maps, truth and GL's lookup, and has a cause, a label
and amounts.
"""

from collections import Counter
from fractions import Fraction
from functools import cache

import numpy

import exact_geometry as geometry

LIT, BLOCKED = 1, 0
BIAS, PRECISION, RESOLUTION, COVERAGE, FILTER = "bias", "precision", "resolution", "coverage", "filter"
ACNE, PANNING, LEAK, EDGE, OVERSHADOW = "acne", "peter_panning", "leak", "edge", "overshadow"
CAUSES = {BIAS: 1, PRECISION: 2, RESOLUTION: 3, COVERAGE: 4, FILTER: 5}
LABELS = {ACNE: 1, PANNING: 2, LEAK: 3, EDGE: 4, OVERSHADOW: 5, "bleed": 6}
TOLERANCE = Fraction(1, 256)


class LightView:
    """The map's matrix, culling and texel rays, exactly."""

    def __init__(self, mesh, light, rows, resolution, cull, is_reversed):
        self.mesh = mesh
        self.light = light
        self.resolution = resolution
        self.is_reversed = is_reversed
        self.kept = [cull == "none" or light.faces_front(mesh, k) != (cull == "front")
                     for k in range(len(mesh.corners))]
        self.float_rows = rows
        self.shift = geometry.shift_of(value for row in rows for value in row)
        self.rows = [geometry.scaled(row, self.shift) for row in rows]
        # A row's last value multiplies w, and the world's coordinates are scaled by 2^shift.
        self.rows = [(*row[:3], row[3] << mesh.shift) for row in self.rows]
        self.look = cache(self._look)

    def is_kept(self, triangle):
        return self.kept[triangle]

    def moved(self, point, offset):
        """The point, moved by an offset in the world."""
        scale = point[3] << self.mesh.shift
        return (*(value + Fraction(float(by)) * scale for value, by in zip(point, offset)), point[3])

    def clip(self, point):
        return tuple(sum(a * b for a, b in zip(row, point)) for row in self.rows)

    def depth(self, point):
        _, _, z, w = self.clip(point)
        return Fraction(z, w) if self.is_reversed else Fraction(z + w, 2 * w)

    def light_distance(self, point):
        """A number that grows with the distance from the light's camera plane, affinely and alike for all maps."""
        _, _, z, w = self.clip(point)
        if self.light.position is not None:
            return Fraction(w, point[3] << self.shift)
        return Fraction(-z if self.is_reversed else z, point[3])

    def texel_position(self, point):
        """uv · resolution, from the lower left."""
        x, y, _, w = self.clip(point)
        return tuple(Fraction((value + w) * self.resolution, 2 * w) for value in (x, y))

    def _look(self, texel):
        """The TexelRay of a texel."""
        origin, direction = texel_ray(self.float_rows, texel, self.resolution, self.light.position is None,
                                      self.is_reversed)
        direction = geometry.scaled(direction, geometry.shift_of(direction))
        origin = self.mesh.point(origin) if self.light.position is None else self.light.position
        ray = geometry.TexelRay(origin, direction)
        geometry.trace(self.mesh, ray, self.is_kept, self.depth, only_forward=self.light.position is not None)
        return ray

    def seen_depth(self, texel):
        ray = self.look(texel)
        if ray.triangle is None:
            return Fraction(0 if self.is_reversed else 1)
        return ray.depth


def texel_ray(rows, texel, count, is_directional, is_reversed):
    """The ray of a texel's centre by the documented operations in double, which define its bits."""
    x_row, y_row, z_row, w_row = rows
    u = (2 * texel[0] + 1 - count) / count
    v = (2 * texel[1] + 1 - count) / count
    a = [x - u * w for x, w in zip(x_row, w_row)]
    b = [y - v * w for y, w in zip(y_row, w_row)]
    direction = geometry.cross(a, b)
    along = z_row if is_directional else w_row
    growth = geometry.dot(along, direction)
    if is_directional and is_reversed:
        growth = -growth
    origin = None
    if is_directional:
        near = [w - z if is_reversed else z + w for z, w in zip(z_row, w_row)]
        b_near, near_a = geometry.cross(b, near), geometry.cross(near, a)
        divisor = geometry.dot(a, b_near)
        origin = tuple(-((a[3] * b_near[k] + b[3] * near_a[k]) + near[3] * direction[k]) / divisor
                       for k in range(3))
    return origin, direction if growth > 0 else tuple(-value for value in direction)


class Pixel:
    """A scored pixel: its exact receiver, truth, GL's verdict, and the lookups with and without a normal offset.

    `views` and `stored` hold all maps; `view` is the map that the receiver reads. `moved` has the effects of the other
    bias terms: the offset of the point looked up, and the depth that brings it nearer to the light."""

    def __init__(self, views, settings, stored, triangle, point, truth, verdict, lookups, bias, moved):
        self.views = views
        self.settings = settings
        self.stored = stored
        self.triangle = triangle
        self.point = point
        self.truth = truth
        self.verdict = verdict
        self.job_lookup, self.lookup = lookups
        self.view = views[self.lookup.map_index]
        self.bias = bias
        self.sees_own_sheet = cache(self._sees_own_sheet)
        # The point and the depth of V2. A lit pixel keeps its bias terms.
        self.offset = moved[:3]
        self.exact_lookup = self.job_lookup if truth == LIT else self.lookup
        self.exact_view = views[self.exact_lookup.map_index]
        self.exact_point = self.exact_view.moved(point, moved[:3]) if truth == LIT else point
        nearer = Fraction(float(moved[3])) if truth == LIT else Fraction(0)
        self.exact_depth = self.exact_view.depth(self.exact_point) + (nearer if settings.is_reversed else -nearer)
        if settings.outside == "clamp":
            self.exact_depth = min(max(self.exact_depth, Fraction(0)), Fraction(1))

    def _sees_own_sheet(self, texel):
        """Whether a walk over the surface from P to the texel's centre reaches the triangle seen there."""
        if texel is None:
            return False
        ray = self.look(texel)
        return geometry.Walk(self.view.mesh, self.view.light, self.triangle, self.point, ray).reaches(ray.triangle)

    def look(self, texel):
        return self.views[texel[0]].look(texel[1:])

    def seen_depth(self, texel):
        return self.views[texel[0]].seen_depth(texel[1:])

    def stored_depth(self, texel):
        return self.stored[texel[0]][self.settings.resolution - 1 - texel[2], texel[1]]

    def tap_is_lit_in_job(self, texel):
        """Whether V0 lights a texel by itself."""
        looked_up = self.job_lookup.resolve(texel)
        compared = self.settings.biased_float(self.job_lookup.depth, self.bias)
        if looked_up is not None:
            return self.settings.is_lit(compared, self.stored_depth(looked_up))
        if self.settings.filter == "linear" and not self.job_lookup.is_decided_by_border():
            return self.settings.is_lit(compared, self.settings.border_depth())
        return self.settings.border_is_lit

    def shadowing_taps(self):
        return [texel for texel in self.job_lookup.footprint() if not self.tap_is_lit_in_job(texel)]

    def job_verdict(self):
        """V0 from the stored depths. The depth that linear interpolates is GL's."""
        if self.settings.filter == "linear":
            if self.job_lookup.is_decided_by_border():
                return Fraction(self.settings.border_is_lit)
            compared = self.settings.biased_float(self.job_lookup.depth, self.bias)
            return Fraction(self.settings.is_lit(compared, numpy.float32(self.job_lookup.map_depth)))
        taps = self.job_lookup.footprint()
        return 1 - Fraction(len(self.shadowing_taps()), len(taps))

    def mean_of_taps(self, lookup, compare):
        """V1 or V2. The border decides first, then a blocked pixel's own surface, then the depths."""
        lit = 0
        taps = lookup.footprint()
        for tap in taps:
            texel = lookup.resolve(tap)
            if texel is None:
                lit += self.settings.border_is_lit
            else:
                lit += (self.truth == BLOCKED and self.sees_own_sheet(texel)) or compare(texel)
        return Fraction(lit, len(taps))

    def compare_stored(self, texel):
        return self.settings.is_lit(self.lookup.depth, self.stored_depth(texel))

    def compare_exact(self, texel):
        return self.settings.is_lit(self.exact_compared(), self.seen_depth(texel))

    def exact_compared(self):
        """The exact depth that V2 compares. A lit pixel keeps the job's bias."""
        if self.truth == LIT:
            return self.settings.biased_exactly(self.exact_depth, self.bias)
        return self.exact_depth

    def centre_sees_own_sheet(self, lookup):
        return self.sees_own_sheet(lookup.resolve(lookup.centre()))

    def stored_verdict(self):
        """V1."""
        if self.settings.filter != "linear":
            return self.mean_of_taps(self.lookup, self.compare_stored)
        if self.lookup.is_decided_by_border():
            return Fraction(self.settings.border_is_lit)
        return Fraction(self.settings.is_lit(self.lookup.depth, numpy.float32(self.lookup.map_depth)))

    def exact_verdict(self, lookup):
        """V2 with the taps of a lookup."""
        if self.settings.filter != "linear":
            return self.mean_of_taps(lookup, self.compare_exact)
        if lookup.is_decided_by_border():
            return Fraction(self.settings.border_is_lit)
        return Fraction(self.settings.is_lit(self.exact_compared(), self.interpolated_depth(lookup)))

    def displaced_lookup(self):
        """V2's lookup at the exact position."""
        return self.exact_lookup.at(self.exact_view.texel_position(self.exact_point))

    def interpolated_depth(self, lookup):
        uv = self.exact_view.texel_position(self.exact_point)
        place = (min(max(value - Fraction(1, 2) - base, Fraction(0)), Fraction(1))
                 for value, base in zip(uv, lookup.corner()))
        total = Fraction(0)
        for tap, weight in lookup.bilinear(*place).items():
            texel = lookup.resolve(tap)
            depth = self.settings.border_depth() if texel is None else self.seen_depth(texel)
            total += weight * depth
        return total

    def single_verdict(self):
        """V2n."""
        texel = self.exact_lookup.resolve(self.exact_lookup.centre())
        if texel is None:
            return Fraction(self.settings.border_is_lit)
        own = self.sees_own_sheet(texel)
        if self.truth == BLOCKED:
            return Fraction(own or self.compare_exact(texel))
        cured = own and not any(self.sees_own_sheet(self.job_lookup.resolve(tap)) for tap in self.shadowing_taps())
        return Fraction(cured or self.compare_exact(texel))

    def fine_verdict(self):
        """V3."""
        outside = self.lookup.texel_at(self.lookup.centre()) is None
        if self.settings.outside == "clamp":
            if outside or self.lookup.is_at_far:
                return self.single_verdict()
        elif outside or self.lookup.is_beyond_far:
            return Fraction(self.settings.border_is_lit)
        found, _ = geometry.crossings(self.view.mesh, self.triangle, self.point, self.view.light, self.view.is_kept)
        depths = (self.view.depth(geometry.point_on_way(self.point, self.view.light, s)) for s, _ in found)
        return Fraction(not any(0 <= depth <= 1 for depth in depths))

    def is_wrong(self):
        return (self.verdict >= Fraction(1, 2)) != bool(self.truth)

    def is_partial(self):
        return not self.is_wrong() and abs(self.verdict - self.truth) > TOLERANCE

    def repairs(self, verdict):
        if self.is_wrong():
            return (verdict >= Fraction(1, 2)) == bool(self.truth)
        return abs(verdict - self.truth) <= TOLERANCE

    def repairs_by_map(self, lookup, verdict):
        """Whether V1 or V2 repairs the pixel. With linear, a blocked pixel's own surface is no repair."""
        if self.settings.filter == "linear" and self.truth == BLOCKED and not lookup.is_decided_by_border() \
                and self.centre_sees_own_sheet(lookup):
            return False
        return self.repairs(verdict)

    def repairs_exactly(self, lookup):
        return self.repairs_by_map(lookup, self.exact_verdict(lookup))

    def cause(self):
        if self.repairs_by_map(self.lookup, self.stored_verdict()):
            return BIAS
        if self.repairs_exactly(self.exact_lookup) or self.repairs_exactly(self.displaced_lookup()):
            return PRECISION
        if self.settings.filter != "nearest" and self.repairs(self.single_verdict()):
            return FILTER
        return RESOLUTION if self.repairs(self.fine_verdict()) else COVERAGE

    def map_lost_the_blocker(self):
        """Whether no texel in reach sees anything nearer to the light than halfway to the blocker."""
        found, _ = geometry.crossings(self.view.mesh, self.triangle, self.point, self.view.light, lambda _: True)
        s, _ = max(found, key=lambda hit: (hit[0], -hit[1]))
        blocker = geometry.point_on_way(self.point, self.view.light, s)
        midpoint = (self.view.light_distance(self.point) + self.view.light_distance(blocker)) / 2
        for tap in self.lookup.ring():
            texel = self.lookup.texel_at(tap)
            if texel is None or self.sees_own_sheet(texel):
                continue
            ray = self.look(texel)
            if ray.triangle is not None and self.views[texel[0]].light_distance(ray.point) < midpoint:
                return False
        return True

    def label(self, cause):
        if self.truth == BLOCKED:
            if cause == BIAS:
                return PANNING
            lost = cause in (PRECISION, COVERAGE) or (cause == RESOLUTION and self.map_lost_the_blocker())
            return LEAK if lost else EDGE
        shadowing = self.shadowing_taps()
        if cause in (BIAS, COVERAGE) or (cause == FILTER and not shadowing):
            return OVERSHADOW
        if not shadowing:
            return EDGE
        return ACNE if 2 * self.weight_of(self.own_taps(shadowing)) >= self.weight_of(shadowing) else EDGE

    def weight_of(self, taps):
        return sum((self.job_lookup.weight(tap) for tap in taps), Fraction(0))

    def own_taps(self, taps):
        return [tap for tap in taps if self.sees_own_sheet(self.job_lookup.resolve(tap))]

    def label_amounts(self, cause, label):
        """The pixel's amount by label. A lit pixel's amount is divided among its shadowing taps."""
        amount = abs(self.verdict - self.truth)
        if self.truth == BLOCKED or cause in (BIAS, COVERAGE) or self.settings.filter == "linear":
            return Counter({label: amount})
        shadowing = self.shadowing_taps()
        own = Fraction(len(self.own_taps(shadowing)), len(shadowing))
        return Counter({ACNE: amount * own, EDGE: amount * (1 - own)})
