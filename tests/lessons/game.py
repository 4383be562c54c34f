"""Claims of the game developer's note about a sun over a game."""

import numpy

from claim import Claim, Control, Lesson, Verdict
from driver_trace import passes
from quantities import is_scored, ratio, wrong


def mean_of_squares(values, side):
    """The mean over squares of side × side."""
    rows, columns = (extent // side for extent in values.shape)
    return values.reshape(rows, side, columns, side).mean((1, 3))


def averaged_over_plain(job):
    """Errors of averaged verdicts over those of one sample per pixel, against the pixel's mean truth."""
    plain, sampled = job.layers("plain"), job.layers("sampled")
    side = len(sampled["class"]) // len(plain["class"])
    counted = is_scored(plain) & (mean_of_squares(is_scored(sampled).astype(float), side) == 1)
    truth = mean_of_squares(sampled.is_lit.astype(float), side)
    before = numpy.abs(plain["verdict"] - truth)[counted].sum()
    after = numpy.abs(mean_of_squares(sampled["verdict"], side) - truth)[counted].sum()
    return after / before


def passes_of_the_scene(job, case):
    """The triangle corners that each pass draws, without passes of a single full-screen triangle."""
    return [corners for corners in passes(job, case) if corners > 3]


def depth_before_the_middle(job):
    samples = job.depth("sun")["samples"]
    frustum = job.depth("sun")["frustum"]
    return float(numpy.interp((frustum["near_m"] + frustum["far_m"]) / 2,
                              [sample["zeta_m"] for sample in samples], [sample["depth"] for sample in samples]))


LESSON = Lesson("game", "The game developer's note", (
    Claim(
        job="depth_is_distance",
        claim="A depth is the distance from the near plane",
        number="depth half-way between near and far",
        verdict=Verdict.BOUNDED,
        why="Of an orthographic sun; a lamp of near 4 and far 50 has spent 0.93 by then.",
        measure=depth_before_the_middle,
        low=0.4999, high=0.5001,  # linear between float32 samples
        control=Control(instead={"sun": "lamp"})),
    Claim(
        job="two_renderings",
        claim="A shadow map takes two renderings",
        number="passes in which GL draws the scene",
        verdict=Verdict.CONFIRMED,
        why="The map, and what the camera sees; one triangle over the whole picture compares them.",
        measure=lambda job: len(passes_of_the_scene(job, "")),
        low=2, high=2,  # a count
        control=Control(job="textbook/three_lights")),
    Claim(
        job="renderings_of_volumes",
        claim="Shadow volumes take four renderings",
        number="passes in which GL draws the scene or volumes",
        verdict=Verdict.BOUNDED,
        why="What the camera sees, its depths, and the volumes with both their sides, which stencils for either side "
            "count at once (GL 2.0): it takes four where each side is drawn by itself. One triangle over the whole "
            "picture gives the verdict.",
        measure=lambda job: len(passes_of_the_scene(job, "volumes")),
        low=3, high=3,  # a count
        control=Control(instead={"volumes": "map"})),
    Claim(
        job="work_of_volumes",
        claim="Shadow maps are faster than shadow volumes",
        number="corners of triangles that GL draws with volumes over those with a map",
        verdict=Verdict.BOUNDED,
        why="By the corners that are drawn, which are not time: each face counts at all pixels that it covers. In "
            "software volumes take 4.3 times as long here, 1.2 times in the playground.",
        measure=lambda job: sum(passes(job, "volumes")) / sum(passes(job, "map")),
        low=1.2,  # a count; the scene's silhouettes are long
        control=Control(instead={"volumes": "map"})),
    Claim(
        job="parallel_light",
        claim="Under parallel light a shadow keeps its size, whatever the height of what casts it",
        number="shadow of a ball 3 m up over that of one 1.1 m up, by exact rays",
        verdict=Verdict.CONFIRMED,
        why="1600 and 1599 pixels of the floor; under a lamp 8 m up it is 1.9 times as large.",
        measure=lambda job: ratio(job.compare("sun_high")["pixels"]["blocked"],
                                  job.compare("sun_low")["pixels"]["blocked"]),
        # Chance moves some √140 of the 140 pixels on the outline: 1 % of 1600.
        low=0.97, high=1.03,
        control=Control(instead={"sun_low": "lamp_low", "sun_high": "lamp_high"})),
    Claim(
        job="box_of_all_vertices",
        claim="The box of all vertices is a good one for the sun's projection",
        number="pixels wrong because the map leaves them or their blockers out", unit="px",
        verdict=Verdict.CONFIRMED,
        why="It leaves nothing out; but a map fitted to what the camera sees has a quarter fewer errors.",
        measure=lambda job: job.compare("all")["causes"]["coverage"],
        high=0,  # exact
        control=Control(instead={"all": "third"})),
    Claim(
        job="near_and_far",
        claim="near and far are those of the vertices, sorted by their distance from the light's camera",
        number="pixels wrong because a plane cuts them or their blockers off", unit="px",
        verdict=Verdict.CONFIRMED,
        why="Nothing is beyond them; a far plane 3.8 m nearer costs 4866 pixels.",
        measure=lambda job: job.compare("sorted")["causes"]["coverage"],
        high=0,  # exact
        control=Control(instead={"sorted": "short"})),
    Claim(
        job="clip_range",
        claim="Depths have to be in [-1, 1] to be drawn",
        number="errors with depths from 1 down to 0 over those with depths from -1 to 1",
        verdict=Verdict.BOUNDED,
        why="So GL begins. Since glClipControl (GL 4.5) it can clip to [0, 1] instead, which serves as well, from "
            "far to near, too.",
        measure=lambda job: ratio(wrong(job.compare("zero_to_one")), wrong(job.compare("minus_one_to_one"))),
        # Rounding may turn a few of 76 wrong pixels.
        low=0.9, high=1.1,
        control=Control(instead={"zero_to_one": "unbiased"})),
    Claim(
        job="anti_aliasing",
        claim="Anti-aliasing will improve aliased shadows",
        number="errors of the mean of 4 × 4 samples a pixel over those of one sample, both against the truth's mean "
               "over the pixel",
        verdict=Verdict.BOUNDED,
        why="It cures the jags of pixels; those of texels that are wider than a pixel, 7 cm to 3 cm here, stay. With "
            "2048² texels it is 0.05.",
        measure=averaged_over_plain,
        # Jags of texels and of pixels add up. Those of texels are wider, and remain.
        low=0.4, high=0.85,
        control=Control(instead={"sampled": "plain"})),
))
