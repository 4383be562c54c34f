"""Claims of the textbook lesson about the map, the light's camera and the lookup."""

import numpy

from claim import Claim, Control, Verdict
from quantities import best_errors, ratio, renderings, share_with_equal_depths, spread, surface


def error_rate(job, case):
    return job.compare(case)["error_rate"]


def clamp_over_the_better_choice(job):
    others = min(error_rate(job, "lit"), error_rate(job, "shadowed"))
    return error_rate(job, "clamp") / others


SCENES = ("two_distances", "sphere_cube", "sphere_plane", "yard", "playground")
AIMS = ("middle", "left", "right", "behind")
SIDES = ("left", "right", "nearer", "farther")
TURNS = ("upright", "turned_15", "turned_30", "turned_45", "turned_60", "turned_75")


def best_errors_in_all_scenes(job, lookup):
    return sum(best_errors(job.compare(f"{lookup}_{scene}")) for scene in SCENES)


def unseen_beside_over_at_the_centre(job):
    """The surface that the best aim beside the centre leaves out, over that of the centre."""
    left_out = {case: job.compare(case)["pixels"]["out_of_light"] for case in (*SIDES, "centre")}
    return ratio(min(left_out[case] for case in SIDES), left_out["centre"])


def mixed_over_matched(job):
    """The errors of the other kind of camera over those of the light's own kind, for the worse light."""
    return max(error_rate(job, "mixed_sun") / error_rate(job, "orthographic_both"),
               error_rate(job, "mixed_spot") / error_rate(job, "perspective_both"))


THE_MAP = (
    Claim(
        job="unequal_distances",
        claim="Where a surface's distance from the light is not the one in the map, it is in shadow",
        number="lit pixels whose two depths differ", unit="%",
        verdict=Verdict.REFUTED,
        why="No lit pixel has the depth that its texel has: only farther by more than a tolerance can mean shadow.",
        measure=lambda job: 1 - share_with_equal_depths(job.layers("slanted")),
        # The depth of a slanted surface equals its texel's only at the texel's centre.
        low=0.9,
        control=Control(instead={"slanted": "facing"})),
    Claim(
        job="three_lights",
        claim="Three lights take four renderings and three maps",
        number="renderings",
        verdict=Verdict.CONFIRMED,
        why="One for the camera and one for each map: receivers serve all three.",
        measure=lambda job: renderings(job.plan()),
        low=4, high=4,  # a count
        control=Control(job="game/two_renderings")),
    Claim(
        job="bits_by_formula",
        claim="32-bit integers give depths the greatest resolution possible",
        number="largest error of the next best of d16, d24 and d32f over that of d32, by formula",
        verdict=Verdict.BOUNDED,
        why="By formula, at all distances up to 48.9 m; beyond it floats that count from far are finer still.",
        measure=lambda job: min(job.depth(c)["theory"]["max_error_m"] for c in ("d16", "d24", "d32f"))
        / job.depth("d32")["theory"]["max_error_m"],
        # (2^32 − 1)/(2^24 − 1) = 256 to 1e-7; the last tooth of the sawtooth costs 24 bits less than 1e-5.
        low=255.9, high=256.1,
        control=Control(instead={"d32": "d24"})),
    Claim(
        job="bits_in_gl",
        claim="A map of 32-bit integers is more accurate than one of 24 bits",
        number="GL's largest error with 32 bits over that with 24",
        verdict=Verdict.REFUTED,
        why="GL computes depths in 32-bit floats, which have 24 binary digits: eight more bits hold nothing.",
        measure=lambda job: job.depth("d32")["measured"]["max_error_m"]
        / job.depth("d24")["measured"]["max_error_m"],
        # If all bits counted it would be 1/256. The transform errs by some 50 µm, and half a code of 24 bits is 17 µm:
        # from (50 − 17)/50 to (50 + 17)/50.
        low=0.6, high=1.4,
        control=Control(instead={"d24": "d16"})),
    Claim(
        job="reversed_floats",
        claim="Nothing that GL stores is more accurate than 32-bit integers",
        number="GL's largest error with 32-bit integers over that with reversed floats",
        verdict=Verdict.REFUTED,
        why="Floats that count from far keep their digits where perspective needs them.",
        measure=lambda job: job.depth("integers")["measured"]["max_error_m"]
        / job.depth("reversed")["measured"]["max_error_m"],
        # The bound of the transform's error falls by ζ/n = 12.5 at far. Drivers may have a third of that.
        low=4,
        control=Control(instead={"reversed": "floats"})),
    Claim(
        job="power_of_two",
        claim="A map's sides must be powers of two",
        number="errors of 1023² and 1025² texels over those of 1024², the more different of the two",
        verdict=Verdict.REFUTED,
        why="Any side will do: a texel less or more changes the errors by chance alone.",
        measure=lambda job: max((error_rate(job, c) / error_rate(job, "power") for c in ("smaller", "larger")),
                                key=lambda r: abs(r - 1)),
        # 400 wrong pixels in each: three standard deviations of such a ratio are 3·√(2/400) = 0.21.
        low=0.79, high=1.21,
        control=Control(instead={"smaller": "half"})),
    Claim(
        job="linear_filter",
        claim="Lookups are most accurate with LINEAR, and very poor with NEAREST",
        number="errors of LINEAR over those of NEAREST, with the scene's own bias",
        verdict=Verdict.BOUNDED,
        why="Half as many errors with one and the same small bias, for interpolated depths need less of it.",
        measure=lambda job: error_rate(job, "linear") / error_rate(job, "nearest"),
        # 48 and 90 wrong pixels: one standard deviation is a fifth of the ratio.
        low=0.2, high=0.9,
        control=Control(instead={"linear": "nearest"})),
    Claim(
        job="linear_filter_at_its_best",
        claim="LINEAR is the more accurate whatever the bias",
        number="errors of LINEAR over those of NEAREST in five scenes, each with its best bias",
        verdict=Verdict.REFUTED,
        why="With the bias that each needs it leaves more, if few: borders of shadows, which no mean of depths mends.",
        measure=lambda job: best_errors_in_all_scenes(job, "linear") / best_errors_in_all_scenes(job, "nearest"),
        # 258 against 219: a standard deviation of a tenth. Below 1 LINEAR would be the more accurate.
        low=1, high=1.5,
        control=Control(instead={f"linear_{scene}": "linear_yard" for scene in SCENES})),
    Claim(
        job="clamp_to_edge",
        claim="Beyond the map's edges, repeating its last values is the least bad choice",
        number="errors with clamped lookups over those with light beyond the edges",
        verdict=Verdict.BOUNDED,
        why="Less bad than shadow: that leaves 62 % wrong, clamping 17 %. But light leaves 6 %, as most of a scene "
            "is lit. Repeating the whole map, mirrored or not, was not measured.",
        measure=clamp_over_the_better_choice,
        low=1.5,  # as bad would be 1; 7114 and 2454 wrong pixels leave chance no part
        control=Control(instead={"clamp": "lit"})),
)

THE_LIGHTS_CAMERA = (
    Claim(
        job="one_camera_for_a_point_light",
        claim="A camera at a point light, aimed as the scene camera is, will do for it",
        number="surface that a camera of 90° at the lamp does not see", unit="%",
        verdict=Verdict.REFUTED,
        why="A lamp in the room takes all six faces of a cube.",
        measure=lambda job: job.compare()["pixels"]["out_of_light"] / surface(job.compare()),
        low=0.5,  # of six faces one is seen: 5/6 would be left of a room that surrounds the lamp evenly
        control=Control(keys=("light.target=[0.2, 0, 0.3]", "light.cone_deg=179"))),
    Claim(
        job="aim_of_the_light",
        claim="Where exactly the light's camera looks is not critical",
        number="errors of the worst of four aims over those of the best, each with its best bias",
        verdict=Verdict.CONFIRMED,
        why="Aims that differ by up to 30° leave errors within a quarter, as long as all is in the picture.",
        measure=lambda job: spread([best_errors(job.compare(case)) for case in AIMS]),
        # 124 to 152 errors. By chance four counts of 140 range over 2.1·√140, a ratio of 1.19.
        high=1.5,
        control=Control(instead={"left": "coarse"})),
    Claim(
        job="all_in_the_picture",
        claim="It is critical that all that the scene camera sees is in the light's picture",
        number="shadow that is lost with a map of the yard's middle 12 m", unit="%",
        verdict=Verdict.CONFIRMED,
        why="What is not in the map cannot shadow anything; with all of the yard in it 0.8 % are lost.",
        measure=lambda job: job.compare("middle")["false_lit_rate"],
        low=0.3,  # two thirds of 3536 pixels, by area
        control=Control(instead={"middle": "all"})),
    Claim(
        job="aim_at_the_cameras_centre",
        claim="The light's camera had better look at what the scene camera looks at",
        number="surface left out by the best of four aims beside it over that left out there",
        verdict=Verdict.CONFIRMED,
        why="Two metres beside it a cone of 60° leaves out 1.3 to 4 times as much.",
        measure=unseen_beside_over_at_the_centre,
        low=1.1,  # areas, to a pixel in a thousand
        control=Control(instead={"centre": "right"})),
    Claim(
        job="up_of_the_light",
        claim="The light's camera had better have the scene camera's up",
        number="errors with that up over those with the best of six",
        verdict=Verdict.REFUTED,
        why="Upright is the worst of six: the map is fitted to the scene's box, whose diagonal it then lies across.",
        measure=lambda job: ratio(error_rate(job, "upright"), min(error_rate(job, case) for case in TURNS)),
        # Texels are 1.25 times as wide as at 45°. 250 wrong pixels: a standard deviation of 0.09.
        low=1.2,
        control=Control(instead={"upright": "turned_45"})),
    Claim(
        job="projection_of_the_camera",
        claim="An orthographic camera calls for an orthographic map, a perspective one for a perspective map",
        number="errors under the other kind of camera over those under the light's own, the worse of two lights",
        verdict=Verdict.REFUTED,
        why="The light decides: parallel rays or rays from a point. Either camera does with either.",
        measure=mixed_over_matched,
        # 291 and 322 wrong pixels: a standard deviation of 0.08.
        high=1.3,
        control=Control(instead={"mixed_sun": "perspective_both"})),
    Claim(
        job="depth_of_the_volume",
        claim="A clipping volume that is as deep as need be keeps errors of rounding small",
        number="pixels wrong by rounding with planes at 0.01 m and 1000 m, less those with close planes",
        unit="px",
        verdict=Verdict.BOUNDED,
        why="19 of 36,000 pixels, against none; with the bias that it needs either leaves 45 wrong, none by rounding.",
        measure=lambda job: job.compare("loose")["causes"]["precision"] - job.compare("close")["causes"]["precision"],
        low=5, spread=0.5,  # a count of 19: three standard deviations below
        control=Control(instead={"loose": "close"})),
    Claim(
        job="rounding_of_a_wide_volume",
        claim="A clipping volume that is as wide as need be keeps errors of rounding small",
        number="wrong pixels of a map eight times too wide that are rounding's", unit="px",
        verdict=Verdict.REFUTED,
        why="Width costs texels, not digits: all others of 3816 wrong pixels are the resolution's.",
        measure=lambda job: job.compare("wide")["causes"]["precision"],
        high=38, off_by=3,  # one in a hundred; one pixel, or a few
        control=Control(instead={"wide": "eight_bits"})),
)

THE_LOOKUP = (
    Claim(
        job="clip_space",
        claim="Shadows must be computed in clip space, for that is what a map holds",
        number="errors with distances in the map over those with clip-space depths, each with its best bias",
        verdict=Verdict.BOUNDED,
        why="Of a map that holds clip-space depths. One of distances to the light does as well; with the lesson's own "
            "bias, as long everywhere then, better.",
        measure=lambda job: best_errors(job.compare("distance")) / best_errors(job.compare("depth")),
        high=1.5,  # 50 against 52 wrong pixels: a standard deviation of 0.2
        control=Control(instead={"distance": "coarse"})),
    Claim(
        job="interpolated_positions",
        claim="Positions in light clip space, interpolated from the vertices, tell each pixel where it is",
        number="largest difference of a depth from the one computed at the pixel", unit="depth units",
        verdict=Verdict.CONFIRMED,
        why="A few roundings of float32: no verdict of 22,170 differs.",
        measure=lambda job: float(numpy.max(numpy.abs(
            job.layers("vertex")["receiver_depth"] - job.layers("pixel")["receiver_depth"])[
                job.layers("vertex").is_lit])),
        # A dozen roundings of numbers below 1, 2^-24 each, are 7e-7; drivers may interpolate more coarsely.
        high=1e-5, spread=0.75,
        control=Control(instead={"pixel": "other_near"})),
)
