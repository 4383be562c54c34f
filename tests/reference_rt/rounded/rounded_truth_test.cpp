#include "reference_rt/rounded/rounded_truth.hpp"

#include "scene_fixture.hpp"
#include "shadowing_oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>
#include <random>

/// The truth of points known only by their float32 positions.
namespace gnomon::reference_rt::test {
namespace {

using scene::ClassReason;
using scene::RoundedReceivers;
using scene::RoundedTruth;
using scene::Vec3f;

constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();

RoundedReceivers receivers_at(const std::vector<Vec3f>& points)
{
    RoundedReceivers receivers;
    receivers.position = scene::Image<Vec3f>{{static_cast<int>(points.size()), 1}, Vec3f{nowhere}};
    for (std::size_t i = 0; i < points.size(); ++i) {
        receivers.position[i] = points[i];
    }
    return receivers;
}

RoundedTruth truth_at(const TriangleScene& scene, const scene::LightSettings& light,
                      const RoundedReceivers& receivers)
{
    return compute_rounded_truth(ReferenceScene{scene}, scene::make_light(light), receivers);
}

TEST(RoundedTruth, DecidesPointsAwayFromEveryEdge)
{
    const auto truth = truth_at(plate_over_ground(), directional({0, -1, 0}),
                                receivers_at({{0.25F, 0, 0.5F}, {-1, 0, 0.5F}, {nowhere, 0, 0}}));
    EXPECT_EQ(truth.truth.pixel_class[0], PixelClass::blocked);
    EXPECT_EQ(truth.truth.witness[0], 2U);
    EXPECT_EQ(truth.truth.pixel_class[1], PixelClass::lit);
    EXPECT_EQ(truth.truth.witness[1], no_triangle);
    EXPECT_EQ(truth.truth.pixel_class[2], PixelClass::background);
    EXPECT_EQ(truth.triangle[2], no_triangle);
}

TEST(RoundedTruth, IsIndeterminateWhereTheBoxReachesOverAShadowsBorder)
{
    // The plate's edge was rounded to float32, and so was the point under it: the same number.
    const auto edge = static_cast<float>(-1.0 / 3);
    const float inside = std::nextafter(edge, 1.0F);
    const float outside = std::nextafter(edge, -1.0F);
    const auto truth =
        truth_at(plate_over_ground(), directional({0, -1, 0}),
                 receivers_at({{edge, 0, 0.5F}, {inside, 0, 0.5F}, {outside, 0, 0.5F}}));
    EXPECT_EQ(truth.truth.pixel_class[0], PixelClass::indeterminate);
    EXPECT_EQ(truth.truth.reason[0], ClassReason::rounding);
    // Half a spacing farther, no point that rounds there is on the border.
    EXPECT_EQ(truth.truth.pixel_class[1], PixelClass::blocked);
    EXPECT_EQ(truth.truth.pixel_class[2], PixelClass::lit);
}

TEST(RoundedTruth, KnowsThatASeamBlocksOnBothSides)
{
    // Under the plate's diagonal, neither triangle alone blocks the whole box.
    const auto truth = truth_at(plate_over_ground(), directional({0, -1, 0}),
                                receivers_at({{0.3F, 0, 0.3F}, {0.7F, 0, 0.7F}}));
    for (const std::size_t pixel : {0U, 1U}) {
        EXPECT_EQ(truth.truth.pixel_class[pixel], PixelClass::blocked);
        EXPECT_EQ(truth.truth.witness[pixel], 2U);
    }
}

TEST(RoundedTruth, GrowsTheBoxUntilItMeetsThePlane)
{
    // 2^-10 above the ground: the box of y is half of 2^-33 high on each side.
    const auto truth = truth_at(plate_over_ground(), directional({0, -1, 0}),
                                receivers_at({{0.25F, 0x1p-10F, 0.5F}, {0.25F, 0, 0.5F}}));
    EXPECT_EQ(truth.truth.pixel_class[0], PixelClass::blocked);
    EXPECT_EQ(truth.growth_m[0], static_cast<float>(0x1p-10 - 0x1p-34));
    EXPECT_EQ(truth.distance_m[0], 0x1p-10F);
    EXPECT_EQ(truth.growth_m[1], 0);
}

TEST(RoundedTruth, GrownBoxesMakeMorePixelsIndeterminate)
{
    // A thousandth from the border: told apart if P is right, and not if it is 2^-9 off.
    const auto near_border = static_cast<float>(-1.0 / 3 - 0.001);
    const auto truth =
        truth_at(plate_over_ground(), directional({0, -1, 0}),
                 receivers_at({{near_border, 0, 0.5F}, {near_border, 0x1p-9F, 0.5F}}));
    EXPECT_EQ(truth.truth.pixel_class[0], PixelClass::lit);
    EXPECT_EQ(truth.truth.pixel_class[1], PixelClass::indeterminate);
}

TEST(RoundedTruth, KnowsAttachedShadowOnlyFromTheSideThatIsSeen)
{
    SceneBuilder builder;
    add_ground(builder, 4, 1);
    const TriangleScene scene = builder.take();
    RoundedReceivers receivers = receivers_at({{0.5F, 0, 0.25F}});
    EXPECT_EQ(truth_at(scene, directional({0, 1, 0}), receivers).truth.pixel_class[0],
              PixelClass::lit);
    receivers.eye = Vec3d{0, 5, 0};
    EXPECT_EQ(truth_at(scene, directional({0, 1, 0}), receivers).truth.pixel_class[0],
              PixelClass::attached);
    receivers.eye = Vec3d{0, -5, 0};
    EXPECT_EQ(truth_at(scene, directional({0, 1, 0}), receivers).truth.pixel_class[0],
              PixelClass::lit);
    receivers.eye.reset();
    receivers.normal = scene::Image<Vec3f>{{1, 1}, Vec3f{0.1F, 0.9F, 0}};
    EXPECT_EQ(truth_at(scene, directional({0, 1, 0}), receivers).truth.pixel_class[0],
              PixelClass::attached);
    receivers.normal[0] = Vec3f{0};
    EXPECT_EQ(truth_at(scene, directional({0, 1, 0}), receivers).truth.pixel_class[0],
              PixelClass::lit);
}

TEST(RoundedTruth, TakesThePixelsObjectWhereItIsKnown)
{
    // Half way between both, a little nearer to the ground.
    const TriangleScene scene = plate_over_ground();
    RoundedReceivers receivers = receivers_at({{0.25F, 0.49F, 0.5F}});
    EXPECT_LT(truth_at(scene, directional({0, -1, 0}), receivers).triangle[0], 2U);
    receivers.object = scene::Image<std::uint32_t>{{1, 1}, 1U};
    const auto truth = truth_at(scene, directional({0, -1, 0}), receivers);
    EXPECT_GE(truth.triangle[0], 2U);
    EXPECT_FLOAT_EQ(truth.distance_m[0], 0.51F);
    receivers.object[0] = scene::no_object;
    EXPECT_LT(truth_at(scene, directional({0, -1, 0}), receivers).triangle[0], 2U);
}

TEST(RoundedTruth, DecidesASpotsCone)
{
    // Half opening 45°, straight down from 2 m: a circle of 2 m around the origin.
    SceneBuilder builder;
    add_ground(builder, 4, 1);
    const auto truth = truth_at(builder.take(), spot({0, 2, 0}, {0, 0, 0}, 90),
                                receivers_at({{1.9F, 0, 0.25F}, {2.1F, 0, 0.25F}, {2, 0, 0}}));
    EXPECT_EQ(truth.truth.pixel_class[0], PixelClass::lit);
    EXPECT_EQ(truth.truth.pixel_class[1], PixelClass::out_of_light);
    EXPECT_EQ(truth.truth.pixel_class[2], PixelClass::indeterminate);
}

TEST(RoundedTruth, GivesAPointLightNoCone)
{
    scene::LightSettings light;
    light.type = scene::LightType::point;
    light.position = Vec3d{0, 2, 0};
    const auto truth =
        truth_at(plate_over_ground(), light, receivers_at({{3.5F, 0, 0.5F}, {0.25F, 0, 0.5F}}));
    EXPECT_EQ(truth.truth.pixel_class[0], PixelClass::lit);
    EXPECT_EQ(truth.truth.pixel_class[1], PixelClass::blocked);
}

TEST(RoundedTruth, RefusesImagesThatDoNotFit)
{
    const ReferenceScene reference{plate_over_ground()};
    const scene::Light light = scene::make_light(directional({0, -1, 0}));
    RoundedReceivers receivers = receivers_at({{0, 0, 0}});
    receivers.normal = scene::Image<Vec3f>{{2, 1}};
    EXPECT_THROW(static_cast<void>(compute_rounded_truth(reference, light, receivers)),
                 std::invalid_argument);
    receivers.normal = {};
    receivers.object = scene::Image<std::uint32_t>{{1, 1}, 2U};
    EXPECT_THROW(static_cast<void>(compute_rounded_truth(reference, light, receivers)),
                 std::invalid_argument);
}

TEST(RoundedTruth, LeavesPointsOpenThatAreTooFarFromTheirSurface)
{
    RoundedReceivers receivers = receivers_at({{0.25F, 0.125F, 0.5F}, {-1, 0, 0.5F}, {-1, 0, 0}});
    receivers.object = scene::Image<std::uint32_t>{{3, 1}, scene::no_object};
    receivers.object[2] = 1; // the plate, and it lies on the ground
    receivers.most_distance_m = 0.125;
    auto truth = truth_at(plate_over_ground(), directional({0, -1, 0}), receivers);
    EXPECT_EQ(truth.truth.pixel_class[0], PixelClass::blocked); // not beyond it
    receivers.most_distance_m = 0.0625;
    truth = truth_at(plate_over_ground(), directional({0, -1, 0}), receivers);
    EXPECT_EQ(truth.truth.pixel_class[0], PixelClass::indeterminate);
    EXPECT_EQ(truth.truth.reason[0], ClassReason::rounding);
    EXPECT_EQ(truth.distance_m[0], 0.125F);
    EXPECT_TRUE(std::isinf(truth.growth_m[0]));
    EXPECT_EQ(truth.truth.pixel_class[1], PixelClass::lit);
    EXPECT_EQ(truth.growth_m[1], 0);
    EXPECT_EQ(truth.truth.pixel_class[2], PixelClass::indeterminate);
    EXPECT_EQ(truth.distance_m[2], 0);
}

struct RoundedScene {
    std::string_view name;
    scene::LightSettings light;
    Vec3d shift{0.0};

    friend void PrintTo(const RoundedScene& shown, std::ostream* out) { *out << shown.name; }
};

class RoundedSceneTest : public testing::TestWithParam<RoundedScene> {
protected:
    static TriangleScene make()
    {
        SceneBuilder builder;
        const Vec3d shift = GetParam().shift;
        add_ground(builder, 3, 3);
        add_sphere(builder, {0, 0.9, 0}, 0.8, 8);
        add_box(builder, {0.9, 0, -0.4}, {1.4, 1, 0.6});
        TriangleScene scene = builder.take();
        for (Vec3f& vertex : scene.vertices) {
            vertex = Vec3f{Vec3d{vertex} + shift};
        }
        return scene;
    }

    static View view(ImageSize image)
    {
        scene::LightSettings light = GetParam().light;
        if (light.position) {
            *light.position += GetParam().shift;
        }
        if (light.target) {
            *light.target += GetParam().shift;
        }
        return make_view(Vec3d{1, 2.5, 4} + GetParam().shift, GetParam().shift, image, light);
    }

    static RoundedReceivers rounded(const TriangleScene& scene, const View& view,
                                    const Image<std::uint32_t>& receivers)
    {
        RoundedReceivers given;
        given.position = receiver_points(scene, view, receivers);
        given.eye = view.camera.eye;
        return given;
    }
};

TEST_P(RoundedSceneTest, SaysWhatIsTrueOfTheUnroundedPoints)
{
    const TriangleScene scene = make();
    const View seen = view({160, 120});
    const auto receivers = brute_force_receivers(scene, seen);
    const ReferenceScene reference{scene};
    const auto exact = compute_truth(reference, seen, receivers, {});
    const auto found =
        compute_rounded_truth(reference, seen.light, rounded(scene, seen, receivers));
    int indeterminate = 0;
    int scored = 0;
    for (std::size_t i = 0; i < receivers.pixel_count(); ++i) {
        const PixelClass truth = exact.pixel_class[i];
        if (truth == PixelClass::background || truth == PixelClass::unmatched) {
            continue;
        }
        ++scored;
        if (found.truth.pixel_class[i] == PixelClass::indeterminate) {
            ++indeterminate;
        } else {
            EXPECT_EQ(found.truth.pixel_class[i], truth) << "pixel " << i;
        }
    }
    EXPECT_GT(scored, 8000);
    RecordProperty("indeterminate", indeterminate);
    // Coordinates of size s make boxes s·2^-23 wide at most, some pixel's footprint of 0.03 m: that
    // share of the thousand pixels, or fewer, along which borders of shadows run.
    const double size_m = 5 + glm::length(GetParam().shift);
    EXPECT_LE(indeterminate, 1 + 1000 * size_m * 0x1p-23 / 0.03);
}

/// A random point of plane(T) in the box of P: where a line along an axis meets the plane.
std::optional<RationalVec> random_point(const TriangleScene& scene, std::uint32_t triangle,
                                        const Vec3f& p, double growth_m, std::mt19937& random)
{
    std::uniform_real_distribution<double> share{-1, 1};
    const auto half = [&](float x) {
        return growth_m + 0.5 * (static_cast<double>(std::nextafter(std::abs(x), 1e30F)) -
                                 static_cast<double>(std::abs(x)));
    };
    const Vec3d spread{half(p.x), half(p.y), half(p.z)};
    const Vec3d start =
        Vec3d{p} + Vec3d{share(random), share(random), share(random)} * 0.99 * spread;
    const int axis = std::uniform_int_distribution<int>{0, 2}(random);
    Vec3d direction{0.0};
    direction[axis] = 1;
    const auto hit = hit_of(RationalVec{start}, RationalVec{direction}, scene.corners(triangle));
    if (!hit) {
        return std::nullopt;
    }
    const RationalVec point = RationalVec{start} + hit->t * RationalVec{direction};
    const std::array<Rational, 3> away{point.x - Rational{static_cast<double>(p.x)},
                                       point.y - Rational{static_cast<double>(p.y)},
                                       point.z - Rational{static_cast<double>(p.z)}};
    for (int k = 0; k < 3; ++k) {
        if (abs(away[static_cast<std::size_t>(k)]) > Rational{spread[k]}) {
            return std::nullopt;
        }
    }
    return point;
}

/// As a renderer does that computes positions in float32.
void shift_by_spacings(Vec3f& position, std::mt19937& random)
{
    std::uniform_int_distribution<int> steps{-6, 6};
    for (int axis = 0; axis < 3; ++axis) {
        const int count = steps(random);
        for (int i = 0; i < std::abs(count); ++i) {
            position[axis] = std::nextafter(position[axis], count < 0 ? -1e30F : 1e30F);
        }
    }
}

TEST_P(RoundedSceneTest, HoldsForRandomPointsOfTheBox)
{
    std::mt19937 random{41};
    const TriangleScene scene = make();
    const View seen = view({12, 9});
    const auto receivers = brute_force_receivers(scene, seen);
    RoundedReceivers given = rounded(scene, seen, receivers);
    for (std::size_t i = 0; i < receivers.pixel_count(); i += 2) {
        shift_by_spacings(given.position[i], random);
    }
    const auto found = compute_rounded_truth(ReferenceScene{scene}, seen.light, given);
    int tested = 0;
    for (std::size_t i = 0; i < receivers.pixel_count(); ++i) {
        const PixelClass pixel_class = found.truth.pixel_class[i];
        if (!scene::is_scored(pixel_class)) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            const auto point = random_point(scene, found.triangle[i], given.position[i],
                                            static_cast<double>(found.growth_m[i]), random);
            if (point) {
                ++tested;
                EXPECT_EQ(pixel_class, exact_shadowing(scene, seen, *point, found.triangle[i]))
                    << "pixel " << i << ", try " << k;
            }
        }
    }
    EXPECT_GT(tested, 40);
}

INSTANTIATE_TEST_SUITE_P(
    All, RoundedSceneTest,
    testing::Values(
        RoundedScene{"sun", directional({-0.4, -1, -0.3})},
        RoundedScene{"grazing_sun", directional({-1, -0.05, -0.3})},
        RoundedScene{"spot", spot({2, 3, 1}, {0, 0, 0}, 100)},
        RoundedScene{"far_away", directional({-0.4, -1, -0.3}), {300, -200, 100}},
        RoundedScene{"spot_far_away", spot({2, 3, 1}, {0, 0, 0}, 100), {300, -200, 100}},
        RoundedScene{"farthest_away", directional({-0.4, -1, -0.3}), {30000, -20000, 10000}}),
    [](const auto& shown) { return std::string{shown.param.name}; });

} // namespace
} // namespace gnomon::reference_rt::test
