"""Numbers of a job's runs that several claims use."""

import numpy

from measured_job import CLASSES

NO_TRIANGLE = 0xFFFFFFFF
UNMATCHED = CLASSES.index("unmatched")


def ratio(of, to):
    """A quotient; 0 / 0 is 1, and x / 0 is infinite."""
    if to == 0:
        return 1.0 if of == 0 else float("inf")
    return of / to


def spread(numbers):
    """The largest over the smallest."""
    return ratio(max(numbers), min(numbers))


def scored(result):
    return result["pixels"]["lit"] + result["pixels"]["blocked"]


def surface(result):
    """Pixels that show a surface."""
    return result["pixels"]["total"] - result["pixels"]["background"]


def wrong(result):
    return result["false_shadow"] + result["false_lit"]


def best_errors(result):
    """Wrong pixels with the best constant bias."""
    return result["bias_curve"]["best_errors"]


def recommended_amount(result):
    """Both amounts of error with the recommended bias [px]."""
    best = result["bias_curve"]["recommended"]
    return best["shadow_amount"] + best["light_amount"]


def good_biases(result):
    """The biases from which there is no acne, and up to which no shadow is lost, but for 0.1 % of the pixels."""
    limits = result["bias_curve"]["allowances"][1]
    return limits["acne_free"], limits["panning_free_beyond_zero"]


def renderings(plan):
    """The number of times that the scene is drawn."""
    return plan["receiver_passes"] + plan["shadow_maps"]


def is_scored(layers):
    return layers.is_lit | layers.is_blocked


def is_wrong(layers):
    shown = layers.shows_lit()
    return (layers.is_lit & ~shown) | (layers.is_blocked & shown)


def is_beside_the_map(layers):
    """(height, width) bool: scored pixels that lie beyond the map's edges."""
    size = layers.job["shadow_map.resolution"]
    u, v = layers["texel.X"], layers["texel.Y"]
    return is_scored(layers) & ((u < 0) | (u > size) | (v < 0) | (v > size))


def is_beside_an_edge(layers):
    """(height, width) bool: surface pixels next to a pixel of another triangle or of none."""
    triangle = layers["prim"]
    beside = numpy.zeros(triangle.shape, bool)
    for here, there in ((numpy.s_[1:, :], numpy.s_[:-1, :]), (numpy.s_[:, 1:], numpy.s_[:, :-1])):
        differs = triangle[here] != triangle[there]
        beside[here] |= differs
        beside[there] |= differs
    return beside & (triangle != NO_TRIANGLE)


def share_with_equal_depths(layers):
    """The share of lit pixels whose depth equals the map's, bit by bit."""
    return float(numpy.mean((layers["receiver_depth"] == layers["map_depth"])[layers.is_lit]))


def differing_verdicts(layers, others):
    """The number of scored pixels on which two maps disagree."""
    return int(numpy.count_nonzero((layers.shows_lit() != others.shows_lit())[is_scored(layers)]))


class DepthErrors:
    """The errors that `gnomon depth` measured on planes from near to far."""

    def __init__(self, result):
        self.near_m = result["frustum"]["near_m"]
        self.far_m = result["frustum"]["far_m"]
        self.is_perspective = result["frustum"]["projection"] == "perspective"
        samples = result["samples"]
        self.distance_m, self.depth, self.stored_m, error_m, self.envelope_m = (
            numpy.array([sample[name] for sample in samples])
            for name in ("zeta_m", "depth", "stored_zeta_m", "error_m", "envelope_m"))
        self.error_m = numpy.abs(error_m)
        self.is_formulas_code = numpy.array([s["code"] == s["formula_code"] for s in samples])
        eighth_m = (self.far_m - self.near_m) / 8
        self.is_first = self.distance_m < self.near_m + eighth_m
        self.is_last = self.distance_m > self.far_m - eighth_m

    def depth_of(self, distance_m):
        """The window depth of a distance."""
        depth = (distance_m - self.near_m) / (self.far_m - self.near_m)
        return depth * self.far_m / distance_m if self.is_perspective else depth

    @property
    def depth_error(self):
        """In depth units."""
        return numpy.abs(self.depth_of(self.stored_m) - self.depth_of(self.distance_m))
