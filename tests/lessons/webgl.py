"""Claims of the WebGL lesson, which has a depth texture of 512², near 0.5 and far 10."""

from claim import Claim, Control, Lesson, Verdict
from quantities import best_errors, differing_verdicts, ratio, wrong

LESSON = Lesson("webgl", "The WebGL lesson", (
    Claim(
        job="range_test",
        claim="A pixel that is within the map by x and y can be compared",
        number="lit pixels that such a test shadows if far is 4.5", unit="%",
        verdict=Verdict.BOUNDED,
        why="In the lesson's scene, all of which is before far; what is beyond far is deeper than 1 and "
            "shadowed, whatever is before it.",
        measure=lambda job: job.compare("short")["false_shadow_rate"],
        low=0.1,  # with the lesson's far it is 0.1 %
        control=Control(instead={"short": "lessons"})),
    Claim(
        job="quantised_depths",
        claim="Acne comes from depths that were quantised",
        number="wrong pixels without a bias that exact depths in the texels' centres make right", unit="%",
        verdict=Verdict.REFUTED,
        why="What is coarse is the grid of texels, which the lesson names, too; with 8 bits it would be half.",
        measure=lambda job: job.compare("d24")["causes"]["precision"] / wrong(job.compare("d24")),
        high=0.01,  # d24 rounds depths by 2^-25, texels differ by some 2^-10
        control=Control(instead={"d24": "u8"})),
    Claim(
        job="bias_slider",
        claim="Moving a bias removes the pattern",
        number="acne that is left with a bias of 0.05", unit="px",
        verdict=Verdict.CONFIRMED,
        why="From 0.023 on none of 11,604 pixels; the 52 that stay wrong are borders of shadows.",
        measure=lambda job: job.compare("moved")["labels"]["acne"],
        high=0,  # the bias is twice the one that ends acne
        control=Control(instead={"moved": "at_lessons"})),
    Claim(
        job="resolution_of_the_map",
        claim="A map's resolution limits its shadows",
        number="errors of 512² texels over those of 2048², each with its best bias",
        verdict=Verdict.CONFIRMED,
        why="Borders of shadows are off by a share of a texel: a quarter as wide, a quarter as wrong or less.",
        measure=lambda job: ratio(best_errors(job.compare("lessons")), best_errors(job.compare("fine"))),
        low=2,  # 52 and 9 wrong pixels: a third of the ratio is one standard deviation
        spread=0.5,
        control=Control(instead={"lessons": "fine"})),
    Claim(
        job="position_of_the_sun",
        claim="Since a map is only so large, a sun has to have a position after all",
        number="pixels whose verdict changes with its position", unit="px",
        verdict=Verdict.REFUTED,
        why="A map fitted to the scene needs its direction alone: the camera's place moves near and far, no texel.",
        measure=lambda job: differing_verdicts(job.layers("near"), job.layers("far")),
        high=40, off_by=10,  # matrices of other numbers round otherwise: a pixel in a thousand
        control=Control(instead={"far": "lower"})),
    Claim(
        job="colour_attachment",
        claim="A framebuffer for depths needs a colour texture beside them, if unused",
        number="pixels whose verdict differs between a depth texture alone and depths written as colours", unit="px",
        verdict=Verdict.REFUTED,
        why="Desktop GL takes a depth texture alone, and its map says what one in a colour texture says; that the "
            "lesson's browser did not take one is its own rule.",
        measure=lambda job: differing_verdicts(job.layers("depth_alone"), job.layers("with_colour")),
        high=0,  # both hold the same float32
        control=Control(instead={"with_colour": "packed"})),
))
