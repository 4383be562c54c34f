"""Claims of the lecture about the depth map as a texture, a sphere and a cube."""

from claim import Claim, Control, Lesson, Verdict
from quantities import share_with_equal_depths, wrong


def acne_of_the_floor_over_the_balls(job):
    share = {row["object"]: row["false_shadow_rate"] for row in job.compare()["by_object"]}
    return share["plane"] / share["sphere"]


LESSON = Lesson("lecture", "The lecture", (
    Claim(
        job="cleared_to_one",
        claim="A map starts out as all 1, so that what falls where nothing was drawn is lit",
        number="wrong pixels of a scene that casts no shadow", unit="px",
        verdict=Verdict.CONFIRMED,
        why="No depth is greater than 1, without any bias.",
        measure=lambda job: wrong(job.compare()),
        high=0,  # r ≤ 1 holds of every receiver before far
        control=Control(keys=("scene.no_cast=[]",))),
    Claim(
        job="nothing_nearer",
        claim="A point is lit if nothing is nearer to the light at the same x and y",
        number="wrong pixels without a bias that an infinitely fine map makes right", unit="%",
        verdict=Verdict.BOUNDED,
        why="Exactly so of points; a texel is an area, and 35 % of the pixels are wrong for that alone.",
        measure=lambda job: job.compare()["causes"]["resolution"] / wrong(job.compare()),
        low=0.99,  # d32f rounds depths by 2^-25, texels differ by some 2^-10
        control=Control(keys=("shadow_map.depth_format=u8",))),
    Claim(
        job="floor",
        claim="A body casts shadow on itself; just the floor would not be as big a deal",
        number="acne of the floor over that of the ball, per lit pixel, without a bias",
        verdict=Verdict.BOUNDED,
        why="Half of each shadows itself; but a bias of 0.001 clears the floor, and leaves 27 % of the ball.",
        measure=acne_of_the_floor_over_the_balls,
        # Both are one half; 1541 pixels of the ball: a standard deviation of 0.026.
        low=0.9, high=1.1,
        control=Control(keys=("bias.constant=0.001",))),
    Claim(
        job="lone_convex_object",
        claim="Convex objects cannot cast a shadow on themselves",
        number="shadowed pixels of a ball by itself that faces the light, by exact rays", unit="px",
        verdict=Verdict.CONFIRMED,
        why="Its triangles either face away from the light or see it.",
        measure=lambda job: job.compare()["pixels"]["blocked"],
        high=0,  # exact
        control=Control(keys=("scene.no_receive=[]",))),
    Claim(
        job="lone_convex_object_in_a_map",
        claim="It takes two convex objects to see shadows in a map",
        number="lit pixels of a ball by itself that a map without a bias shadows", unit="%",
        verdict=Verdict.BOUNDED,
        why="Without a bias a ball by itself shadows half of itself in a map; with the lecture's epsilon of 0.1 no "
            "pixel.",
        measure=lambda job: job.compare()["false_shadow_rate"],
        low=0.4, high=0.6,  # one half; 3576 pixels: a standard deviation of 0.01
        control=Control(keys=("bias.constant=0.1",))),
    Claim(
        job="equal_depths",
        claim="Rounding forbids to expect equal depths of what the light sees",
        number="lit pixels whose depth is the map's, bit by bit", unit="%",
        verdict=Verdict.BOUNDED,
        why="None of 13,721 has one, but not for rounding: texels see other points than pixels do. Where both see "
            "one depth, as of a plane that faces a parallel light, rounding leaves it equal.",
        measure=lambda job: share_with_equal_depths(job.layers("slanted")),
        high=0.01,  # depths of a texel's area differ by hundreds of codes
        control=Control(instead={"slanted": "facing"})),
    Claim(
        job="epsilon",
        claim="An epsilon of 0.1 tells light from shadow",
        number="errors with it in the yard over those in the lecture's scene",
        verdict=Verdict.BOUNDED,
        why="In the lecture's scene 0.06 % of the pixels are wrong, and anything from 0.018 to 0.28 does as well. "
            "In the yard it is 8.6 %, all of the shadow; in the textbook's scene 4.4 %, in the playground 3.4 %, with "
            "the ball over its plane 0.16 %.",
        measure=lambda job: job.compare("yard")["error_rate"] / job.compare("lectures")["error_rate"],
        # 3536 and 9 wrong pixels: a standard deviation of a third. If the epsilon served elsewhere, it would be about 1.
        low=20, spread=0.6,
        control=Control(instead={"yard": "ball_over_plane"})),
))
