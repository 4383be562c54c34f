"""Claims of the OpenGL notes about the sun's map, acne and bias, the map's borders, and filters."""

import numpy

import gnomon_methods
from claim import Claim, Control, Lesson, Verdict
from quantities import is_beside_the_map, is_scored, ratio, recommended_amount, renderings


def moved_shadow(job):
    """Pixels on which sun and spot disagree, by exact rays, over those in the sun's shadow."""
    sun, spot = job.layers("sun"), job.layers("spot_50_m")
    both = is_scored(sun) & is_scored(spot)
    return numpy.count_nonzero((sun["class"] != spot["class"])[both]) / numpy.count_nonzero(sun.is_blocked)


def lit_share_beside_the_map(job, case):
    layers = job.layers(case)
    return float(layers.shows_lit()[is_beside_the_map(layers)].mean())


def false_shadow(job, case):
    return job.compare(case)["false_shadow"]


LESSON = Lesson("opengl_notes", "The OpenGL notes", (
    Claim(
        job="two_passes",
        claim="At least two passes are needed",
        number="renderings",
        verdict=Verdict.CONFIRMED,
        why="The map, and what the camera sees.",
        measure=lambda job: renderings(job.plan()),
        low=2, high=2,  # a count
        control=Control(job="textbook/three_lights")),
    Claim(
        job="orthographic_sun",
        claim="A sun needs an orthographic map: the rays must not fan out",
        number="pixels on which a spot light 50 m away and the sun differ, over those in the sun's shadow", unit="%",
        verdict=Verdict.CONFIRMED,
        why="By exact rays; from 1600 m away 1.4 % are left.",
        measure=moved_shadow,
        # The ball is 3.5 m beside the spot's axis, where rays differ by 3.6°: its shadow of 2 m moves by 0.1 m, and the
        # camera sees its rim.
        low=0.1,
        control=Control(instead={"spot_50_m": "spot_1600_m"})),
    Claim(
        job="acne_by_resolution",
        claim="Acne is a matter of resolution",
        number="acne with 2048² texels over that with 128², without a bias",
        verdict=Verdict.REFUTED,
        why="Finer texels make finer stripes: half of a slanted plane shadows itself, however many there are.",
        measure=lambda job: ratio(false_shadow(job, "fine"), false_shadow(job, "coarse")),
        # Both are half of 57,600 pixels. Sampling the stripes of 128 texels changes it by one or two per cent.
        low=0.9, high=1.1,
        control=Control(instead={"fine": "biased"})),
    Claim(
        job="bias_by_resolution",
        claim="The bias against acne is a matter of resolution",
        number="bias that ends acne with 128² texels over that with 2048²",
        verdict=Verdict.CONFIRMED,
        why="It is half a texel's slope, and texels are 16 times as wide.",
        measure=lambda job: job.compare("coarse")["bias_curve"]["acne_free"]
        / job.compare("fine")["bias_curve"]["acne_free"],
        # Pixels sample the texels' corners to 2 %.
        low=15.5, high=16.5,
        control=Control(instead={"coarse": "fine"})),
    Claim(
        job="slight_bias",
        claim="A slight bias cures acne",
        number="false shadow that a bias of 0.4 m leaves of that without one", unit="%",
        verdict=Verdict.BOUNDED,
        why="It cures: 31 of 18,551 pixels. But slight it is not: ten texels' width, for the sake of steep walls.",
        measure=lambda job: ratio(false_shadow(job, "slight"), false_shadow(job, "none")),
        high=0.01, spread=0.5,  # the borders of shadows; acne would be all of it
        control=Control(instead={"slight": "none"})),
    Claim(
        job="more_bias",
        claim="With more bias objects float above their shadows",
        number="longest gap between a wall and its shadow with a bias of 0.2 m", unit="m",
        verdict=Verdict.CONFIRMED,
        why="The gap is the bias, to a pixel.",
        measure=lambda job: job.compare()["peter_panning_gap_m"]["max"],
        # Half a texel, 0.7 mm, and a pixel's width over sin 45°, 14 mm · √2.
        low=0.18, high=0.22,
        control=Control(keys=("bias.constant_m=0.05",))),
    Claim(
        job="contact_shadows",
        claim="With a bias, shadows close to what casts them disappear",
        number="shadow of a ball on the floor that a bias of 1 m, its radius, loses", unit="%",
        verdict=Verdict.CONFIRMED,
        why="All that is lost lies within the bias of the ball, to a texel.",
        measure=lambda job: job.compare("large")["false_lit_rate"],
        low=0.2,  # without this bias 1 of 123 pixels is lost
        control=Control(instead={"large": "small"})),
    Claim(
        job="beyond_the_map",
        claim="What is beside the map is always in shadow",
        number="pixels beside the map that repeated edges shadow", unit="%",
        verdict=Verdict.REFUTED,
        why="They get what the edge's texels say; it depends on what stands there.",
        measure=lambda job: 1 - lit_share_beside_the_map(job, "repeated"),
        # "Always" would be all 28,078 pixels.
        high=0.9,
        control=Control(instead={"repeated": "zero"})),
    Claim(
        job="border_of_zeros",
        claim="A border of depth 0 leaves all beyond the map lit",
        number="pixels beside the map that a border of zeros lights", unit="%",
        verdict=Verdict.REFUTED,
        why="0 is the nearest depth there is, so that all is behind it: a border that lights holds 1.",
        measure=lambda job: lit_share_beside_the_map(job, "zero"),
        # No receiver behind near has r ≤ 0. Interpolation reaches half a texel into the map.
        high=0.01,
        control=Control(instead={"zero": "one"})),
    Claim(
        job="beyond_far",
        claim="What is beyond far is best left lit, too",
        number="errors with light beyond far over those with shadow",
        verdict=Verdict.CONFIRMED,
        why="Most of what a far plane amid the yard cuts off is lit; but 77 % of the shadow is gone.",
        measure=lambda job: job.compare("lit")["error_rate"] / job.compare("shadowed")["error_rate"],
        high=0.6,  # 2745 and 10,099 wrong pixels, by area
        control=Control(instead={"lit": "shadowed", "shadowed": "lit"})),
    Claim(
        job="pcf_mends_edges",
        claim="The mean over neighbouring texels mends pixelated edges",
        number="amount of error of 3 × 3 comparisons over that of one, each with its recommended bias",
        verdict=Verdict.REFUTED,
        why="Not towards the true edge: it softens jags that stay where they were, at both sides of them.",
        measure=lambda job: recommended_amount(job.compare("pcf3")) / recommended_amount(job.compare("nearest")),
        # For a straight edge it is 3: one step errs by a quarter of a texel on average, three steps of a third by a
        # quarter, one and one. 214 pixels of one comparison give a standard deviation of 0.2.
        low=1.5,
        control=Control(instead={"pcf3": "nearest"})),
    Claim(
        job="more_taps",
        claim="More samples make a better fade",
        number="amount of error of 9 × 9 comparisons over that of 3 × 3, each with its recommended bias",
        verdict=Verdict.BOUNDED,
        why="A finer and wider one, with 82 levels of light in place of 10; but a wider fade is farther from a light "
            "without extent, and needs more bias.",
        measure=lambda job: recommended_amount(job.compare("pcf9")) / recommended_amount(job.compare("pcf3")),
        low=1.5,  # of a straight edge 3, as above: (2(1 + 2 + 3 + 4) + ¼)/9 over (2 + ¼)/3
        control=Control(instead={"pcf9": "pcf3"})),
    Claim(
        job="nine_taps",
        claim="The eight neighbours make it nine times the work",
        number="texels that 3 × 3 comparisons read, by definition, over those that one reads",
        verdict=Verdict.BOUNDED,
        why="Nine reads by definition, but not nine times the time: a lookup pass of 1280 × 720 takes 38 ms in "
            "place of 28 in software, its readback included ([performance](performance.md#gls-passes)).",
        measure=lambda job: gnomon_methods.taps(job.settings("nine")["lookup"]["filter"])
        / gnomon_methods.taps(job.settings("one")["lookup"]["filter"]),
        low=9, high=9,  # a count
        control=Control(instead={"nine": "one"})),
))
