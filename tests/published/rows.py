"""The rows of docs/methods/published.md, in its order."""

import math

from row import ROOT, NotMeasured, Number, Row, Run, Verdict, compared, layers, settings

PLATES = str(ROOT / "examples" / "methods" / "three_plates.toml")
PANNING = 2  # in the layer `label`

# ---- the unit of polygon offset ------------------------------------------------------------------------------------

# A plane square to the light, at depth 3/4 of the map.
FLAT = settings(**{"scene.tilted-plane.angle_deg": 0}, image__width=32, image__height=18, shadow_map__resolution=64,
                shadow_map__near=-3, shadow_map__far=1, bias__polygon_offset_units=1)


def unit_run(depth_format):
    return Run(("--builtin", "tilted-plane"), (*FLAT, *settings(shadow_map__depth_format=depth_format)))


def unit(depth_format):
    """r, measured."""
    return compared(unit_run(depth_format))["polygon_offset"]["r"]["median"]


def unit_of_llvmpipe(depth_format):
    """log₂ r on the driver that the document's numbers are of."""
    renderer = compared(unit_run(depth_format))["environment"]["gl_renderer"]
    if "llvmpipe" not in renderer:
        raise NotMeasured(f"the row is of llvmpipe, and GL is {renderer}")
    return math.log2(unit(depth_format))


# The relative error of r is 2^-9 (raster_gl/map/raster_planes.cpp).
LEAST, MOST = 1 - 2**-9, 1 + 2**-9

UNIT = Row(
    name="unit",
    title="The unit of polygon offset",
    claim="One unit is at most 2 · 2⁻ⁿ in formats of n bits, and 2^(e − 23) in 32-bit floats, e the exponent of the "
          "depth.",
    source="VK-GL-CTS at c57d29f, `es3fPolygonOffsetTests.cpp`, `calcMinResolvableDiff`: one unit, slope 0; 2⁻ⁿ "
           "where the format is exact",
    ours="r as [`gnomon compare` measures it](biases.md#polygon-offset), on a plane at depth ¾, where e is −1",
    numbers=(
        Number("r of `d16` · 2¹⁶", "1 to 2", lambda: unit("d16") * 2**16, lambda: unit("d24") * 2**16,
               LEAST, 2 * MOST),
        Number("r of `d24` · 2²⁴", "1 to 2", lambda: unit("d24") * 2**24, lambda: unit("d16") * 2**24,
               LEAST, 2 * MOST),
        Number("r of `d32f` · 2²⁴", "1", lambda: unit("d32f") * 2**24, lambda: unit("d24") * 2**24, LEAST, MOST),
    ),
    verdict=Verdict.CONFIRMED,
    why="With evenly spaced depths a unit is two steps of the format, as much as the suite allows; with floats one.",
    differs="The suite sees whether one unit parts two triangles; here as many units as shift a plane by 1/64 are "
            "divided by their number.",
    run=unit_run("d24"),
)

UNITS_OF_DRIVERS = Row(
    name="drivers",
    title="The unit by driver",
    claim="r of `d16` is 2⁻¹⁵ on NVIDIA and 2⁻¹⁶ elsewhere, of `d24` 2⁻²³ and 2⁻²⁴.",
    source="dxvk#3501, its constants in the mode that is not exact",
    ours="the same measurement, on llvmpipe of Mesa",
    numbers=(
        Number("log₂ r of `d16`", "−16, NVIDIA −15", lambda: unit_of_llvmpipe("d16"),
               lambda: unit_of_llvmpipe("d24"), -15.01, -14.99, digits=4, spread=0.001),
        Number("log₂ r of `d24`", "−24, NVIDIA −23", lambda: unit_of_llvmpipe("d24"),
               lambda: unit_of_llvmpipe("d16"), -23.01, -22.99, digits=4, spread=0.001),
    ),
    verdict=Verdict.REFUTED,
    why="llvmpipe is no NVIDIA, and has NVIDIA's units. Who takes the smaller ones has half the offset there.",
    differs="The constants are of hardware's Vulkan drivers, none of which was measured here.",
    run=unit_run("d16"),
)

# ---- a bias in depth units -----------------------------------------------------------------------------------------

PANNING_BIAS = 0.005
RANGES_M = (404, 412, 448, 665)
LENGTHS_M = (2.02, 4.12, 6.71, 13.29)
GAPS_M = (1.6, 3.2, 5.3, 10.4)
HEIGHT_M = 8  # of the picture, 180 pixels: each 0.044 m


def gap_run(cascade, angle_deg=52):
    """A wall, and the ground that it shades, seen from above."""
    keys = settings(
        scene__wall__light_angle_deg=angle_deg, scene__wall__height_m=10, scene__wall__width_m=20,
        bias__constant=PANNING_BIAS * (cascade + 1), shadow_map__near=-RANGES_M[cascade] / 2,
        shadow_map__far=RANGES_M[cascade] / 2, shadow_map__fit="fixed", shadow_map__half_extent=20,
        shadow_map__resolution=2048, shadow_map__depth_format="d32f", image__width=320, image__height=180,
        camera__eye="[6.4, 20, 0]", camera__target="[6.4, 0, 0]", camera__up="[0, 0, -1]",
        camera__orthographic_height=HEIGHT_M)
    return Run(("--builtin", "wall"), keys)


def longest_gap_m(run):
    return compared(run)["peter_panning_gap_m"]["max"]


def ground_gap_m(run):
    """How far on the ground the shadow begins from the wall, which stands at x = 0."""
    pixels = layers(run)
    return float(pixels["P.X"][pixels["label"] == PANNING].max())


def gap_numbers(cascade):
    length_m = PANNING_BIAS * (cascade + 1) * RANGES_M[cascade]
    pixel_m = HEIGHT_M / 180
    return (
        # The last pixel of the gap lies up to a pixel before its end, which is 1 / sin 52° longer along the light.
        Number(f"bias in cascade {cascade}, of {RANGES_M[cascade]} m", f"{LENGTHS_M[cascade]} m",
               lambda: longest_gap_m(gap_run(cascade)), lambda: longest_gap_m(gap_run((cascade + 1) % 4)),
               length_m - pixel_m / math.sin(math.radians(52)) - 0.01, length_m + 0.01, "m", spread=0.03),
        # The table has one decimal.
        Number(f"gap on the ground in cascade {cascade}", f"{GAPS_M[cascade]} m",
               lambda: ground_gap_m(gap_run(cascade)), lambda: ground_gap_m(gap_run(cascade, angle_deg=40)),
               GAPS_M[cascade] - pixel_m - 0.05, GAPS_M[cascade] + 0.09, "m", spread=0.03),
    )


GAPS = Row(
    name="gaps",
    title="A bias in depth units, in metres",
    claim="A bias of 0.005 depth units is 2.02, 4.12, 6.71 and 13.29 m in four cascades, and detaches shadows on the "
          "ground by 1.6, 3.2, 5.3 and 10.4 m.",
    source="OloEngineBase#1137: cascades with depth ranges of 404, 412, 448 and 665 m, a sun at 52°",
    ours="the built-in wall, 10 m high, under light 52° from the vertical, in a map with each range in turn; a bias "
         "of 0.005 times the cascade's number, from 1 on; the longest distance from a wrongly lit point to its "
         "blocker, and the farthest such point from the wall",
    numbers=tuple(number for cascade in range(4) for number in gap_numbers(cascade)),
    verdict=Verdict.CONFIRMED,
    why="Both follow from b · range and its sine; the lengths hold with the factor of the cascade's number, which "
        "the table does not state.",
    differs="Their scene was not available: a wall stands for it, and each cascade is a map of its own. The gaps fit "
            "an angle from the vertical. Pixels of 0.044 m end each gap up to one pixel too soon.",
    run=gap_run(0),
)

# ---- least biases of blurred maps ----------------------------------------------------------------------------------


def floor_run(method, size=1024, width=160, **keys):
    keys = {f"method__{key}": value for key, value in keys.items()}
    return Run(("--builtin", "yard"), settings(
        image__width=width, image__height=width * 9 // 16, bias__constant=0, shadow_map__resolution=size,
        method__name=method, **keys))


def error_px(run):
    """False shadow and false light by amount."""
    result = compared(run)
    return result["shadow_amount"] + result["light_amount"]


def ratio(first, second):
    return error_px(first) / error_px(second)


def best_of(values, run):
    """That of the values which has the least error."""
    return min(values, key=lambda value: error_px(run(value)))


EVSM_16 = {"bits": 16}
FLOORS = Row(
    name="floors",
    title="Least biases of blurred maps",
    claim="VSM and 32-bit EVSM need a bias of 1e-4, 16-bit EVSM up to 5e-3; MSM a moment bias of 1e-6 to 3e-6 with "
          "32 bits.",
    source="M. Pettineo, *A sampling of shadow techniques* (therealmjp.github.io, posts/shadow-maps): maps of 2048², "
           "cascades, PowerPlant",
    ours="`yard` without constant bias in one map of 1024²; `min_deviation` is the bias of EVSM. Each number is the "
         "amount of error with the lesser bias over that with the greater",
    numbers=(
        Number("16-bit EVSM, 1e-4 over 1e-3", "above 1",
               lambda: ratio(floor_run("evsm", min_deviation=1e-4, **EVSM_16),
                             floor_run("evsm", min_deviation=1e-3, **EVSM_16)),
               lambda: ratio(floor_run("evsm", min_deviation=1e-4), floor_run("evsm", min_deviation=1e-3)), low=1.25),
        Number("32-bit EVSM, 1e-4 over 1e-3", "about 1",
               lambda: ratio(floor_run("evsm", min_deviation=1e-4), floor_run("evsm", min_deviation=1e-3)),
               lambda: ratio(floor_run("evsm", min_deviation=1e-4, **EVSM_16),
                             floor_run("evsm", min_deviation=1e-3, **EVSM_16)), low=0.9, high=1.2),
        Number("32-bit MSM, 1e-6 over 3e-6", "above 1",
               lambda: ratio(floor_run("msm", moment_bias=1e-6), floor_run("msm", moment_bias=3e-6)),
               lambda: ratio(floor_run("msm", moment_bias=3e-6), floor_run("msm", moment_bias=1e-6)), low=1.05),
    ),
    verdict=Verdict.BOUNDED,
    why="16 bits need ten times as much as 32, or two thirds of the error are acne of rounding; moments want the upper end "
        "of their range. [MSM's page](msm.md#moment-bias) has more values of it.",
    differs="The unit of the bias is not stated; here it is the least standard deviation in depth units. One map, a "
            "smaller scene, and half the resolution.",
    run=floor_run("evsm", min_deviation=1e-4, **EVSM_16),
)

DEVIATIONS = (1e-6, 1e-5, 1e-4, 1e-3, 5e-3)
MOMENT_BIASES = (1e-7, 1e-6, 3e-6, 1e-5, 3e-5, 1e-4)


def full_floor(method, key, **more):
    return lambda value: floor_run(method, 2048, 320, **{key: value, **more})


def variance_floor(deviation):
    return floor_run("vsm", 2048, 320, min_variance=deviation**2)


BEST_FLOORS = Row(
    name="best-floors",
    title="The best of several biases of blurred maps",
    claim="The floors above; with 16 bits MSM needs a moment bias of 3e-5.",
    source="the same",
    ours="`yard` at 320 × 180 pixels in one map of 2048²: which of 1e-6, 1e-5, 1e-4, 1e-3 and 5e-3, for moments of "
         "1e-7, 1e-6, 3e-6, 1e-5, 3e-5 and 1e-4, has the least error by amount",
    numbers=(
        Number("VSM, least standard deviation", "1e-4", lambda: best_of(DEVIATIONS, variance_floor),
               lambda: best_of((1e-6, 1e-5), variance_floor), 9e-4, 1.1e-3),
        Number("32-bit EVSM", "1e-4", lambda: best_of(DEVIATIONS, full_floor("evsm", "min_deviation")),
               lambda: best_of((1e-6, 1e-5), full_floor("evsm", "min_deviation")), 9e-4, 1.1e-3),
        Number("16-bit EVSM", "up to 5e-3", lambda: best_of(DEVIATIONS, full_floor("evsm", "min_deviation", **EVSM_16)),
               lambda: best_of((1e-6, 1e-5), full_floor("evsm", "min_deviation", **EVSM_16)), 9e-4, 5.1e-3),
        Number("32-bit MSM", "1e-6 to 3e-6", lambda: best_of(MOMENT_BIASES, full_floor("msm", "moment_bias")),
               lambda: best_of((1e-7, 1e-4), full_floor("msm", "moment_bias")), 9e-7, 3.1e-6),
        Number("16-bit MSM", "3e-5", lambda: best_of(MOMENT_BIASES, full_floor("msm", "moment_bias", **EVSM_16)),
               lambda: best_of((1e-7, 1e-4), full_floor("msm", "moment_bias", **EVSM_16)), 9e-6, 3.1e-5),
    ),
    verdict=Verdict.BOUNDED,
    why="Of moments they are right, within a factor of three. VSM and EVSM want 1e-3 in this scene: with 1e-4 nearly "
        "all of the acne remains that there is without any.",
    differs="As above. The published floors end what the eye sees; here light that they let in counts as much as "
            "acne.",
    run=floor_run("msm", 2048, 320, moment_bias=3e-6),
    slow=True,
)

# ---- bleeding ------------------------------------------------------------------------------------------------------


def bleed_run(method, bits, reduction):
    return Run((PLATES,), settings(
        image__width=240, image__height=240, shadow_map__resolution=2048, method__name=method, method__bits=bits,
        method__samples=4, method__mips="true", method__anisotropy=16, method__bleeding_reduction=reduction))


def bleed_px(method, bits, reduction=0):
    return compared(bleed_run(method, bits, reduction))["label_amounts"]["bleed"]


BLEEDING = Row(
    name="bleeding",
    title="EVSM and MSM: bleeding",
    claim="With 16 bits MSM bleeds less than EVSM, 32-bit EVSM has the least; pictures with a reduction of 0.25.",
    source="M. Pettineo, *Shadow sample update* (therealmjp.github.io, posts/shadow-sample-update): 2048², 4 × MSAA, "
           "16 × anisotropy, mips",
    ours="[`three_plates.toml`](../../examples/methods/three_plates.toml) at 240 × 240 pixels with the same "
         "resolution, samples, anisotropy and mips; light by amount that is labelled `bleed`",
    numbers=(
        Number("16-bit MSM over 16-bit EVSM", "below 1", lambda: bleed_px("msm", 16) / bleed_px("evsm", 16),
               lambda: bleed_px("evsm", 16) / bleed_px("msm", 16), high=0.5),
        Number("32-bit EVSM over 16-bit MSM", "below 1", lambda: bleed_px("evsm", 32) / bleed_px("msm", 16),
               lambda: bleed_px("evsm", 16) / bleed_px("msm", 16), high=0.95),
        Number("16-bit EVSM with a reduction of 0.25", "less", lambda: bleed_px("evsm", 16, 0.25),
               lambda: bleed_px("evsm", 16), high=1, unit="px"),
        Number("16-bit MSM with a reduction of 0.25", "less", lambda: bleed_px("msm", 16, 0.25),
               lambda: bleed_px("msm", 16), high=1, unit="px"),
    ),
    verdict=Verdict.CONFIRMED,
    why="The order is theirs. A reduction of 0.25 ends bleeding here with either, at the price of wider shadows.",
    differs="Three plates in place of their scenes, one map in place of cascades, a blur of 9 texels, which they do "
            "not give. [At equal memory](msm.md#at-equal-memory) has more.",
    run=bleed_run("msm", 16, 0),
    slow=True,
)

# ---- normal bias ---------------------------------------------------------------------------------------------------


def biased_run(scene, **keys):
    keys = {f"bias__{key}": value for key, value in keys.items()}
    return Run(("--builtin", scene),
               settings(image__width=240, image__height=135, shadow_map__depth_format="d32f", **keys))


def best_px(run):
    """The error by amount with the recommended constant bias."""
    recommended = compared(run)["bias_curve"]["recommended"]
    return recommended["shadow_amount"] + recommended["light_amount"]


def of_normal(scene, texels, of=0):
    return best_px(biased_run(scene, normal_texels=texels)) / best_px(biased_run(scene, normal_texels=of))


NORMAL = Row(
    name="normal",
    title="A normal bias of half a texel",
    claim="Typically values between 0.3 and 0.7 texels work well as a normal bias.",
    source="Unity, scripting reference of `Light.shadowNormalBias`; directional lights",
    ours="three built-in scenes at 240 × 135 pixels in their own maps, d32f: the error by amount with 0.5 texels and "
         "the constant bias that is [recommended](../bias_curve.md#what-is-recommended) beside it, over that without "
         "a normal offset and with its own",
    numbers=(
        Number("`yard`", "below 1", lambda: of_normal("yard", 0.5), lambda: of_normal("yard", 2), 0.9, 1.05),
        Number("`columns`", "below 1", lambda: of_normal("columns", 0.5), lambda: of_normal("columns", 0), low=1.15),
        Number("`terrain`", "below 1", lambda: of_normal("terrain", 0.5), lambda: of_normal("terrain", 0), low=1.5),
        Number("`yard`, 0.5 texels over 2", "below 1", lambda: of_normal("yard", 0.5, of=2),
               lambda: of_normal("yard", 2, of=0.5), high=0.9),
    ),
    verdict=Verdict.BOUNDED,
    why="On `yard` half a texel costs nothing; on `columns` and, worst, under grazing light, the right constant bias "
        "does better alone, for the offset lets light in along every border. Two texels are worse than half a one.",
    differs="Unity moves casters inwards, less where they face the light; here lookups move outwards by the whole "
            "offset.",
    run=biased_run("yard", normal_texels=0.5),
)


def of_polygon_offset(scene, factor=1):
    offset = biased_run(scene, polygon_offset_factor=factor, polygon_offset_units=1)
    others = [best_px(biased_run(scene, normal_texels=texels)) for texels in (0, 0.5)]
    return best_px(offset) / min(others)


OFFSET = Row(
    name="offset",
    title="Polygon offset against bias and normal bias",
    claim="No scene could be made in which polygon offset gives significantly better results than bias and normal "
          "bias.",
    source="three.js#18413, a maintainer's comment; large scenes and cascades included",
    ours="the error by amount with a factor of 1, a unit and the constant bias that is recommended beside them, over "
         "the lesser of those with a normal offset of 0 and of 0.5 texels and their own constants",
    numbers=(
        Number("`columns`", "1 or more", lambda: of_polygon_offset("columns"), lambda: of_polygon_offset("columns", 0),
               high=0.85),
        Number("`yard`", "1 or more", lambda: of_polygon_offset("yard"), lambda: of_polygon_offset("columns"), low=0.9),
    ),
    verdict=Verdict.REFUTED,
    why="`columns` is such a scene. [The table](biases.md#side-by-side) has five scenes with eight views each, and "
        "says where the maintainer is right.",
    differs="They judged by eye; one view of each scene here.",
    run=biased_run("columns", polygon_offset_factor=1, polygon_offset_units=1),
)

ROWS = (UNIT, UNITS_OF_DRIVERS, GAPS, FLOORS, BEST_FLOORS, BLEEDING, NORMAL, OFFSET)
