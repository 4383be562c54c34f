#include "scene_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::reference_rt::test {
namespace {

constexpr ImageSize truth_image{96, 72};

/// Ground and three boxes, one of them off the others' axes.
TriangleScene boxes_scene()
{
    SceneBuilder builder;
    add_ground(builder, 4, 4);
    add_box(builder, {-1, 0, -1}, {-0.25, 1, 0}, "tall");
    add_box(builder, {0.25, 0, -0.5}, {1, 0.5, 0.75}, "low");
    add_box(builder, {-0.5, 1.5, 0.25}, {0.5, 1.625, 1}, "floating");
    return builder.take();
}

View boxes_view(const scene::LightSettings& light)
{
    return make_view({1.5, 2.25, 3.5}, {0, 0.25, 0}, truth_image, light);
}

TEST(ComputeTruth, SeesOnlyBackgroundWhereThereIsNothing)
{
    const TriangleScene scene = boxes_scene();
    const View view = make_view({0, 2, 3}, {0, 4, 8}, truth_image, directional({0, -1, 0}));
    const auto truth = truth_of(scene, view);
    EXPECT_EQ(count(truth.pixel_class, PixelClass::background),
              static_cast<int>(truth_image.pixel_count()));
    EXPECT_EQ(count(truth.witness, no_triangle), static_cast<int>(truth_image.pixel_count()));
}

TEST(ComputeTruth, CallsAWallInTheLightsPlaneAttached)
{
    const TriangleScene scene = boxes_scene();
    const View view = boxes_view(directional({0, -1, 0}));
    const auto receivers = brute_force_receivers(scene, view);
    const auto truth = compute_truth(ReferenceScene{scene}, view, receivers, {});
    int walls = 0;
    for (std::size_t i = 0; i < receivers.pixel_count(); ++i) {
        if (receivers[i] == no_triangle) {
            continue;
        }
        const auto corner = scene.corners(receivers[i]);
        if (corner[0].y != corner[1].y || corner[0].y != corner[2].y) {
            ++walls;
            EXPECT_EQ(truth.pixel_class[i], PixelClass::attached) << "pixel " << i;
        } else {
            EXPECT_TRUE(scene::is_scored(truth.pixel_class[i])) << "pixel " << i;
        }
    }
    EXPECT_GT(walls, 200);
    EXPECT_EQ(count(truth.pixel_class, PixelClass::indeterminate), 0);
}

TEST(ComputeTruth, CallsTheSideAwayFromTheLightAttached)
{
    SceneBuilder builder;
    add_ground(builder, 4, 1);
    const TriangleScene scene = builder.take();
    const auto truth =
        truth_of(scene, make_view({0, 3, 1}, {0, 0, 0}, truth_image, directional({0.1, 1, 0})));
    EXPECT_EQ(count(truth.pixel_class, PixelClass::attached),
              static_cast<int>(truth_image.pixel_count()));
}

TEST(ComputeTruth, LightsADiscUnderASpot)
{
    SceneBuilder builder;
    add_ground(builder, 8, 8);
    const TriangleScene scene = builder.take();
    const View view = make_view({2, 4, 3}, {0, 0, 0}, truth_image, spot({0, 3, 0}, {0, 0, 0}, 60));
    const auto receivers = brute_force_receivers(scene, view);
    const auto truth = compute_truth(ReferenceScene{scene}, view, receivers, {});
    const auto points = receiver_points(scene, view, receivers);
    // From height 3 with half cone 30° the disc's radius is 3·tan 30° = sqrt 3. The points are
    // rounded to float32, so a ring of 1e-5 m is left out.
    const double radius_m = std::numbers::sqrt3;
    int inside = 0;
    for (std::size_t i = 0; i < points.pixel_count(); ++i) {
        const double distance_m = std::hypot(points[i].x, points[i].z);
        if (receivers[i] == no_triangle || std::abs(distance_m - radius_m) < 1e-5) {
            continue;
        }
        inside += distance_m < radius_m ? 1 : 0;
        EXPECT_EQ(truth.pixel_class[i],
                  distance_m < radius_m ? PixelClass::lit : PixelClass::out_of_light)
            << "pixel " << i;
    }
    EXPECT_GT(inside, 1000);
}

TEST(ComputeTruth, HonoursRoles)
{
    TriangleScene scene = boxes_scene();
    const View view = boxes_view(directional({-0.3, -1, -0.4}));
    const auto all = truth_of(scene, view);
    ASSERT_GT(count(all.pixel_class, PixelClass::blocked), 100);

    TriangleScene shadowless = scene;
    for (auto& object : shadowless.objects) {
        object.casts = false;
    }
    const auto lit = truth_of(shadowless, view);
    EXPECT_EQ(count(lit.pixel_class, PixelClass::blocked), 0);
    EXPECT_EQ(count(lit.pixel_class, PixelClass::attached),
              count(all.pixel_class, PixelClass::attached));

    // Boxes that the camera does not see still cast, and every pixel shows the ground.
    for (auto& object : scene.objects) {
        object.receives = object.name == "ground";
    }
    const auto ground_only = truth_of(scene, view);
    EXPECT_GT(count(ground_only.pixel_class, PixelClass::blocked),
              count(all.pixel_class, PixelClass::blocked));
    EXPECT_EQ(count(ground_only.pixel_class, PixelClass::attached), 0);
    EXPECT_EQ(count(ground_only.pixel_class, PixelClass::unmatched), 0);
}

TEST(ComputeTruth, BlocksAtAContactCloserThanFloatRaysResolve)
{
    // A slope y = 3/8·(x − 1000) and its copy 2^-23 m above it, both exact in float32. P rounded to
    // float32 is up to 3/8 of half an ulp of 1000, 1.1e-5 m, off the slope on either side.
    const std::vector<std::array<std::uint32_t, 3>> quad{{0, 1, 2}, {0, 2, 3}};
    std::vector<Vec3d> corners{{996, -1.5, -4}, {996, -1.5, 4}, {1004, 1.5, 4}, {1004, 1.5, -4}};
    SceneBuilder builder;
    builder.add("slope", corners, quad);
    for (Vec3d& corner : corners) {
        corner.y += 0x1p-23;
    }
    builder.add("film", corners, quad);
    TriangleScene scene = builder.take();
    scene.objects[1].receives = false;
    for (const Vec3d& direction : {Vec3d{0.3, -1, 0.2}, Vec3d{-1, -0.9, 0.4}}) {
        const View view =
            make_view({1000.5, 2.5, 0.75}, {1000, 0, 0}, truth_image, directional(direction));
        const auto receivers = brute_force_receivers(scene, view);
        const auto truth = compute_truth(ReferenceScene{scene}, view, receivers, {});
        const int background = count(truth.pixel_class, PixelClass::background);
        EXPECT_EQ(count(truth.pixel_class, PixelClass::blocked) + background,
                  static_cast<int>(truth_image.pixel_count()));
        EXPECT_LT(background, 1000);
    }
}

TEST(ComputeTruth, BlocksEverythingInsideAClosedSphere)
{
    // Every segment leaves the sphere through a triangle or exactly through a seam: never a gap.
    SceneBuilder builder;
    add_sphere(builder, {0, 0, 0}, 2, 16);
    const TriangleScene scene = builder.take();
    for (const Vec3d& direction : {Vec3d{0, -1, 0}, Vec3d{1, 0, 0}, Vec3d{0.3, -1, 0.2}}) {
        const View view =
            make_view({0, 0, 0.25}, {0.5, 0.5, -1}, truth_image, directional(direction));
        const auto truth = truth_of(scene, view);
        EXPECT_EQ(count(truth.pixel_class, PixelClass::lit), 0);
        EXPECT_EQ(count(truth.pixel_class, PixelClass::indeterminate), 0);
        EXPECT_EQ(count(truth.pixel_class, PixelClass::unmatched), 0);
    }
}

/// A roof over the origin whose ridge the segments meet exactly: all coordinates are short binary
/// fractions. `apex_x` is where the second slope ends.
scene::Truth truth_under_ridge(double apex_x)
{
    SceneBuilder builder;
    add_ground(builder, 4, 1);
    builder.add("roof", std::vector<Vec3d>{{0, 1, -1}, {0, 1, 1}, {-1, 0.5, 0}, {apex_x, 0.5, 0}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 0, 3}});
    TriangleScene scene = builder.take();
    scene.objects.back().receives = false;
    // An odd width puts the centre column's pixels on x = 0, straight below the ridge.
    const View view = make_view({0, 2, 2}, {0, 0, 0}, {65, 49}, directional({0, -1, 0}));
    return truth_of(scene, view);
}

TEST(ComputeTruth, BlocksAtASeam)
{
    const auto truth = truth_under_ridge(1);
    EXPECT_EQ(truth.pixel_class(32, 24), PixelClass::blocked);
    EXPECT_EQ(truth.witness(32, 24), 2U); // the lower of the two
    EXPECT_EQ(truth.pixel_class(31, 24), PixelClass::blocked);
    EXPECT_EQ(truth.pixel_class(33, 24), PixelClass::blocked);
}

TEST(ComputeTruth, CallsAFoldASilhouette)
{
    const auto truth = truth_under_ridge(-0.5);
    EXPECT_EQ(truth.pixel_class(32, 24), PixelClass::indeterminate);
    EXPECT_EQ(truth.reason(32, 24), scene::ClassReason::silhouette);
    EXPECT_EQ(truth.witness(32, 24), no_triangle);
    EXPECT_EQ(truth.pixel_class(31, 24), PixelClass::blocked);
    EXPECT_EQ(truth.pixel_class(33, 24), PixelClass::lit);
}

TEST(ComputeTruth, IsTheSameForAnyNumberOfThreads)
{
    const TriangleScene scene = boxes_scene();
    const View view = boxes_view(spot({2, 3, 1}, {0, 0, 0}, 90));
    const auto receivers = brute_force_receivers(scene, view);
    const ReferenceScene reference{scene};
    const auto one = compute_truth(reference, view, receivers, {}, {TruthMethod::exact, 1});
    for (const int threads : {2, 7}) {
        const auto many =
            compute_truth(reference, view, receivers, {}, {TruthMethod::exact, threads});
        EXPECT_TRUE(std::ranges::equal(one.pixel_class, many.pixel_class));
        EXPECT_TRUE(std::ranges::equal(one.reason, many.reason));
        EXPECT_TRUE(std::ranges::equal(one.witness, many.witness));
    }
}

TEST(ComputeTruth, ByPlainRaysAgreesAwayFromContacts)
{
    const TriangleScene scene = boxes_scene();
    const View view = boxes_view(directional({-0.3, -1, -0.4}));
    const auto judged = truth_of(scene, view);
    const auto plain = truth_of(scene, view, {TruthMethod::plain, 0});
    int different = 0;
    for (std::size_t i = 0; i < judged.pixel_class.pixel_count(); ++i) {
        different += judged.pixel_class[i] != plain.pixel_class[i] ? 1 : 0;
    }
    // Its rays start 1e-4 of the diagonal off P, 1 mm or a tenth of a pixel: only pixels at a foot
    // or at a border, some 500 here, can differ, a tenth of them at most.
    EXPECT_LE(different, 50);
    EXPECT_EQ(count(plain.witness, no_triangle), static_cast<int>(truth_image.pixel_count()));
}

TEST(ComputeTruth, RejectsForeignReceivers)
{
    const TriangleScene scene = boxes_scene();
    const View view = boxes_view(directional({0, -1, 0}));
    const ReferenceScene reference{scene};
    const Image<std::uint32_t> narrow{ImageSize{95, 72}, no_triangle};
    EXPECT_THROW((void)compute_truth(reference, view, narrow, {}), std::invalid_argument);
    Image<std::uint32_t> foreign{truth_image, no_triangle};
    foreign(3, 3) = static_cast<std::uint32_t>(scene.triangles.size());
    EXPECT_THROW((void)compute_truth(reference, view, foreign, {}), std::invalid_argument);
    EXPECT_THROW((void)receiver_points(scene, view, foreign), std::invalid_argument);
}

TEST(ReceiverPoints, LieOnTheTriangleUnderThePixel)
{
    SceneBuilder builder;
    add_ground(builder, 4, 1, 0.5);
    const TriangleScene scene = builder.take();
    const View view = make_view({0, 2.5, 0.5}, {0, 0.5, -1}, {9, 7}, directional({0, -1, 0}));
    auto receivers = brute_force_receivers(scene, view);
    receivers(0, 0) = no_triangle;
    const auto points = receiver_points(scene, view, receivers);
    EXPECT_TRUE(std::isnan(points(0, 0).x));
    // The centre pixel's ray is the forward axis, from (0, 2.5, 0.5) to (0, 0.5, −1); one rounding.
    EXPECT_FLOAT_EQ(points(4, 3).y, 0.5F);
    EXPECT_FLOAT_EQ(points(4, 3).z, -1.0F);
}

TEST(EmbreeVersion, NamesTheLibrary)
{
    EXPECT_TRUE(embree_version().starts_with("Embree ")) << embree_version();
}

TEST(ReferenceScene, OutlivesTheSceneItWasMadeFrom)
{
    const View view = boxes_view(directional({-0.3, -1, -0.4}));
    auto scene = std::make_unique<TriangleScene>(boxes_scene());
    const auto receivers = brute_force_receivers(*scene, view);
    ReferenceScene first{*scene};
    const auto before = compute_truth(first, view, receivers, {});
    scene.reset();
    const ReferenceScene moved = std::move(first);
    const auto after = compute_truth(moved, view, receivers, {});
    EXPECT_TRUE(std::ranges::equal(before.pixel_class, after.pixel_class));
}

} // namespace
} // namespace gnomon::reference_rt::test
