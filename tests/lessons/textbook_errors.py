"""Claims of the textbook lesson about errors in z, tolerances, and its notes."""

import numpy

from claim import Claim, Control, Lesson, Verdict
from quantities import (UNMATCHED, DepthErrors, best_errors, good_biases, is_beside_an_edge, is_beside_the_map,
                        is_wrong, scored)
from textbook import SCENES, THE_LIGHTS_CAMERA, THE_LOOKUP, THE_MAP, error_rate


def wrong_share_beside_the_map(job):
    layers = job.layers("clamp")
    beside = is_beside_the_map(layers)
    return numpy.count_nonzero(is_wrong(layers) & beside) / numpy.count_nonzero(beside)


def gap_between_scenes(job):
    """The largest bias that a scene needs, over the smallest that costs another scene shadows."""
    intervals = [good_biases(job.compare(scene)) for scene in SCENES]
    return max(low for low, _ in intervals) / min(high for _, high in intervals)


def growth(job):
    errors = DepthErrors(job.depth("perspective"))
    return errors.error_m[errors.is_last].max() / errors.error_m[errors.is_first].max()


def smallest_far_away(job):
    errors = DepthErrors(job.depth("d16"))
    return (errors.error_m / errors.envelope_m)[errors.is_last].min()


def growth_in_depth_units(job):
    errors = DepthErrors(job.depth("integers"))
    return errors.depth_error[errors.is_last].max() / errors.depth_error[errors.is_first].max()


def shadowed_share_at_edges(job):
    layers = job.layers("ids")
    return float((~layers.shows_lit())[is_beside_an_edge(layers) & layers.is_lit].mean())


def another_triangle_share(job):
    layers = job.layers()
    return float((layers["class"] == UNMATCHED)[is_beside_an_edge(layers)].mean())


def codes_near_over_far(job):
    theory = job.depth("integers")["theory"]
    return theory["codes_per_metre_at_near"] / theory["codes_per_metre_at_far"]


ERRORS = (
    Claim(
        job="beyond_the_edge",
        claim="Beyond the map's edges, its last values are typically wrong",
        number="pixels beyond the edges that are wrong with clamped lookups", unit="%",
        verdict=Verdict.REFUTED,
        why="It is right for three out of four: the edge's texels show the lit ground, as most pixels do.",
        measure=wrong_share_beside_the_map,
        # "Typically" would be more than half. Chance plays no part in 28,000 pixels.
        low=0.1, high=0.4,
        control=Control(instead={"clamp": "shadowed"})),
    Claim(
        job="tolerance_of_each_scene",
        claim="A simple tolerance gives reasonable results in many cases",
        number="errors in the worst of five scenes, each with its best constant bias", unit="%",
        verdict=Verdict.CONFIRMED,
        why="One or two pixels in a thousand, borders of shadows most of them.",
        measure=lambda job: max(best_errors(job.compare(s)) / scored(job.compare(s)) for s in SCENES),
        high=0.005,  # 75 of 35,471 pixels: chance moves it by a tenth
        control=Control(keys=("shadow_map.resolution=128",))),
    Claim(
        job="tolerance_elsewhere",
        claim="The tolerance that is right for one scene need not be right for another",
        number="the largest bias that a scene needs over the smallest that another bears",
        verdict=Verdict.CONFIRMED,
        why="The ball and the cube need 0.011, in the yard 0.0062 already costs shadows: "
            "no bias serves all five scenes.",
        measure=gap_between_scenes,
        low=1.2,  # both ends are critical biases of single pixels, known to a rounding
        control=Control(instead={"yard": "playground"})),
    Claim(
        job="stored_depth_formula",
        claim="(z/2 + ½)(2ⁿ − 1) is exactly what a depth buffer of n bits holds",
        number="32-bit codes that are the formula's", unit="%",
        verdict=Verdict.BOUNDED,
        why="Of 16-bit codes 99.7 % are, of 24-bit ones 55 %, of the lesson's 32 bits hardly any: GL's z is a float32.",
        measure=lambda job: DepthErrors(job.depth("d32")).is_formulas_code.mean(),
        # A float32 below 1 spans 256 codes of 32 bits, so one in 256 is equal by chance. It is 11 of 4096, and two
        # standard deviations are 0.6 of that.
        high=0.05, spread=0.6,
        control=Control(instead={"d32": "d16"})),
    Claim(
        job="nearer_is_finer",
        claim="Nearer values have more resolution",
        number="codes a metre at near over those at far, by formula",
        verdict=Verdict.CONFIRMED,
        why="(far/near)² times as many, of integers under a perspective; not under an orthographic sun, "
            "nor of reversed floats.",
        measure=codes_near_over_far,
        low=156.2, high=156.3,  # (50/4)² = 156.25
        control=Control(instead={"integers": "orthographic"})),
    Claim(
        job="error_grows",
        claim="The error grows with the distance",
        number="largest error of 16 bits in the last eighth of the range over that in the first",
        verdict=Verdict.CONFIRMED,
        why="As ζ²: (50/9.75)² = 26 between the ends of these eighths; of the lesson's 32 bits 37.",
        measure=growth,
        # 512 planes per eighth sample the envelope to a few per cent, and GL's transform adds as much.
        low=20, high=35,
        control=Control(instead={"perspective": "orthographic"})),
    Claim(
        job="error_near_zero",
        claim="Far away the error can be nearly zero, too",
        number="smallest error of 16 bits in the last eighth of the range over the largest that a code can have there",
        verdict=Verdict.BOUNDED,
        why="Where rounding to a code is the error, a sawtooth: next to a code's own distance nothing is lost. Of the "
            "lesson's 32 bits GL's least is 4.6 times that largest: its float32 keeps it from zero.",
        measure=smallest_far_away,
        # The smallest of 512 uniform shares of a tooth exceeds 0.02 once in 30,000 times. It depends on the driver.
        high=0.02, spread=0.85,
        control=Control(instead={"d16": "d32"})),
    Claim(
        job="one_tolerance",
        claim="No single tolerance can make up for errors that grow and are uneven",
        number="largest error of 16 bits in depth units in the last eighth of the range over that in the first",
        verdict=Verdict.BOUNDED,
        why="No tolerance in metres can; in depth units, which the lesson's shader adds it in, half a code of 16 bits "
            "is enough at every distance. Of the lesson's 32 bits GL errs by 295 codes near and 393 far: 1.33.",
        measure=growth_in_depth_units,
        # Both are half a code. 512 samples give it to 1 %, and GL may sometimes choose the other code.
        low=0.8, high=1.25,
        control=Control(instead={"integers": "half_floats"})),
)

NOTES = (
    Claim(
        job="matching_ids",
        claim="With triangles' IDs in the map, a pixel whose ID is the map's is lit",
        number="shadowed pixels that are lit so, with texels of 0.3 m", unit="%",
        verdict=Verdict.BOUNDED,
        why="A texel shows which triangle is lit somewhere in it: with texels of 18 mm it is 1.8 %.",
        measure=lambda job: job.compare("coarse")["false_lit_rate"],
        low=0.05,  # a texel is as wide as parts of the swing's shadow
        control=Control(instead={"coarse": "fine"})),
    Claim(
        job="edges_of_ids",
        claim="With triangles' IDs in the map all pixels on edges are in shadow",
        number="lit pixels beside an edge that are shadowed so", unit="%",
        verdict=Verdict.BOUNDED,
        why="One in six: those whose texel shows the other triangle; away from edges it is 3 of 13,721, and a finer "
            "map has fewer.",
        measure=shadowed_share_at_edges,
        # Half of the texels along an edge show the other triangle; all would be 1, none 0.
        low=0.05, high=0.5,
        control=Control(instead={"ids": "depths"})),
    Claim(
        job="shared_edges",
        claim="Pixels on a shared edge are drawn twice, and show either triangle",
        number="pixels beside edges that show another triangle than an exact ray meets", unit="%",
        verdict=Verdict.REFUTED,
        why="GL draws a pixel's centre for one of two triangles that share an edge; the few are those whose corners "
            "it snaps to 1/256 of a pixel.",
        measure=another_triangle_share,
        # Snapping moves an edge by up to 1/512 pixel: at most 1/256 of the pixels that it passes.
        high=0.004, spread=0.5,
        control=Control(keys=("scene.builtin=sphere-field",))),  # several edges to a pixel
    Claim(
        job="width_of_the_volume",
        claim="An arbitrarily wide volume costs accuracy",
        number="errors of a map eight times as wide over those of a close one",
        verdict=Verdict.CONFIRMED,
        why="Texels are eight times as wide.",
        measure=lambda job: error_rate(job, "wide") / error_rate(job, "small"),
        low=4,  # borders alone grow by 8; 279 and 3816 wrong pixels leave chance a few per cent
        control=Control(instead={"wide": "small"})),
)

LESSON = Lesson("textbook", "The textbook lesson",
                (*THE_MAP, *THE_LIGHTS_CAMERA, *THE_LOOKUP, *ERRORS, *NOTES))
