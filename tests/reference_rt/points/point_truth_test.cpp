#include "reference_rt/points/point_truth.hpp"

#include "scene/error.hpp"
#include "scene_fixture.hpp"
#include "shadowing_oracle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

/// Compares the truth of given points with an independent oracle in rationals.
namespace gnomon::reference_rt::test {
namespace {

using scene::Light;
using scene::LightType;
using scene::PointSide;
using scene::SurfacePoints;

/// Points on triangles, which `SurfacePoints` only refers to.
struct OwnedPoints {
    std::vector<std::uint32_t> triangles;
    std::vector<Vec2d> barycentrics;

    [[nodiscard]] SurfacePoints points(PointSide side = PointSide::to_light) const
    {
        return {triangles, barycentrics, side};
    }
    void add(std::uint32_t triangle, Vec2d place)
    {
        triangles.push_back(triangle);
        barycentrics.push_back(place);
    }
};

Light sun(const Vec3d& direction)
{
    return {LightType::directional, direction, Vec3d{0.0}, -1};
}

Light lamp(const Vec3d& position)
{
    return {LightType::point, Vec3d{0.0}, position, -1};
}

RationalVec exact_place(const TriangleScene& scene, std::uint32_t triangle, const Vec2d& place)
{
    const Triangle corners = scene.corners(triangle);
    const RationalVec a = exact(corners[0]);
    return a + Rational{place.x} * (exact(corners[1]) - a) +
           Rational{place.y} * (exact(corners[2]) - a);
}

/// Small triangles around the origin, and a few large ones.
TriangleScene soup(std::mt19937& random, int count)
{
    std::uniform_real_distribution<double> place{-1, 1};
    SceneBuilder builder;
    for (int i = 0; i < count; ++i) {
        const double size = i % 4 == 0 ? 1.5 : 0.4;
        const Vec3d centre{place(random), place(random), place(random)};
        std::vector<Vec3d> corners;
        for (int k = 0; k < 3; ++k) {
            corners.push_back(centre + size * Vec3d{place(random), place(random), place(random)});
        }
        builder.add("soup", corners, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    }
    return builder.take();
}

/// A light whose numbers are not float32 values.
Light random_light(std::mt19937& random, int kind)
{
    std::uniform_real_distribution<double> place{-1, 1};
    const Vec3d v{place(random), place(random), place(random)};
    if (kind == 0) {
        return sun(v);
    }
    if (kind == 1) {
        return lamp(2.0 * v);
    }
    const Vec3d position = Vec3d{0, 3, 0} + v;
    return {LightType::spot, -position, position, std::cos(0.3)};
}

/// The class by trying every triangle in rationals.
PixelClass class_by_rationals(const TriangleScene& scene, const Light& light,
                              const RationalVec& point, std::uint32_t receiver)
{
    if (light.type == LightType::spot) {
        const RationalVec axis{light.direction};
        const RationalVec offset = point - RationalVec{light.position};
        const Rational along = dot(offset, axis);
        const Rational cosine{light.cos_half_cone};
        if (along <= 0 || along * along < cosine * cosine * dot(offset, offset) * dot(axis, axis)) {
            return PixelClass::out_of_light;
        }
    }
    View view;
    view.light = light;
    return exact_shadowing(scene, view, point, receiver);
}

struct Counts {
    int lit = 0;
    int blocked = 0;

    void add(PixelClass point_class)
    {
        lit += scene::is_lit(point_class) ? 1 : 0;
        blocked += scene::is_blocked(point_class) ? 1 : 0;
    }
};

/// A blocked point's witness crosses its segment, or is half of a seam.
void expect_witness(const TriangleScene& scene, const Light& light, const RationalVec& point,
                    PixelClass point_class, std::uint32_t witness)
{
    if (!scene::is_blocked(point_class)) {
        EXPECT_EQ(witness, no_triangle);
        return;
    }
    ASSERT_LT(witness, scene.triangles.size());
    EXPECT_NE(exact_contact(point, light, scene.corners(witness)), ExactContact::none);
}

class PointTruthOfSoup : public testing::TestWithParam<unsigned> {};

TEST_P(PointTruthOfSoup, OnTrianglesIsThatOfRationals)
{
    std::mt19937 random{GetParam()};
    std::uniform_real_distribution<double> share{0, 1};
    const TriangleScene scene = soup(random, 40);
    const ReferenceScene reference{scene};
    Counts counts;
    for (int kind = 0; kind < 3; ++kind) {
        const Light light = random_light(random, kind);
        OwnedPoints points;
        for (std::uint32_t i = 0; i < 130; ++i) {
            const double u = i % 7 == 0 ? 0 : share(random); // some on an edge
            points.add(i % 40, {u, i % 11 == 0 ? 1 - u : (1 - u) * share(random)});
        }
        const auto truth = find_point_truth(reference, light, points.points());
        for (std::size_t i = 0; i < points.triangles.size(); ++i) {
            SCOPED_TRACE(testing::Message()
                         << "seed " << GetParam() << ", light " << kind << ", point " << i);
            const RationalVec point =
                exact_place(scene, points.triangles[i], points.barycentrics[i]);
            EXPECT_EQ(truth.point_class[i],
                      class_by_rationals(scene, light, point, points.triangles[i]));
            expect_witness(scene, light, point, truth.point_class[i], truth.witness[i]);
            counts.add(truth.point_class[i]);
        }
    }
    EXPECT_GT(counts.lit, 20);
    EXPECT_GT(counts.blocked, 20);
}

TEST_P(PointTruthOfSoup, InSpaceIsThatOfRationalsHoweverFarAway)
{
    std::mt19937 random{GetParam() + 1000};
    std::uniform_real_distribution<double> place{-1, 1};
    const TriangleScene scene = soup(random, 40);
    const ReferenceScene reference{scene};
    Counts counts;
    for (int kind = 0; kind < 3; ++kind) {
        const Light light = random_light(random, kind);
        std::vector<Vec3d> points;
        for (int i = 0; i < 130; ++i) {
            Vec3d point{place(random), place(random), place(random)};
            if (i % 3 == 0) { // before the scene, seen from the light
                const Vec3d way = kind == 0 ? light.direction : -light.position;
                point += std::pow(10.0, i % 14) * way;
            }
            points.push_back(point);
        }
        const auto truth = find_point_truth(reference, light, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            SCOPED_TRACE(testing::Message()
                         << "seed " << GetParam() << ", light " << kind << ", point " << i);
            const RationalVec point{points[i]};
            EXPECT_EQ(truth.point_class[i], class_by_rationals(scene, light, point, no_triangle));
            expect_witness(scene, light, point, truth.point_class[i], truth.witness[i]);
            counts.add(truth.point_class[i]);
        }
    }
    EXPECT_GT(counts.lit, 20);
    EXPECT_GT(counts.blocked, 20);
}

TEST_P(PointTruthOfSoup, IsTheSameInAnyOrderInAnyBatchByAnyNumberOfThreads)
{
    std::mt19937 random{GetParam() + 2000};
    std::uniform_real_distribution<double> place{-1, 1};
    const TriangleScene scene = soup(random, 40);
    const ReferenceScene reference{scene};
    const Light light = random_light(random, 0);
    std::vector<Vec3d> points;
    for (int i = 0; i < 200; ++i) {
        points.emplace_back(place(random), place(random), place(random));
    }
    const auto truth = find_point_truth(reference, light, points, {.threads = 1});
    EXPECT_EQ(find_point_truth(reference, light, points, {.threads = 4}).point_class,
              truth.point_class);
    std::vector<Vec3d> turned{points.rbegin(), points.rend()};
    auto of_turned = find_point_truth(reference, light, turned).point_class;
    std::ranges::reverse(of_turned);
    EXPECT_EQ(of_turned, truth.point_class) << "seed " << GetParam();
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto alone = find_point_truth(reference, light, std::span{&points[i], 1});
        EXPECT_EQ(alone.point_class.front(), truth.point_class[i]) << "seed " << GetParam();
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, PointTruthOfSoup, testing::Range(0U, 12U));

/// Integer coordinates, on which edges, corners and planes are met exactly.
TEST(PointTruth, OfATangleOfDegenerateContactsIsThatOfRationals)
{
    std::mt19937 random{7};
    std::uniform_int_distribution<int> place{-2, 2};
    for (int run = 0; run < 20; ++run) {
        SceneBuilder builder;
        for (int i = 0; i < 14; ++i) {
            std::vector<Vec3d> corners;
            for (int k = 0; k < 3; ++k) {
                corners.emplace_back(place(random), place(random), place(random));
            }
            builder.add("soup", corners, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
        }
        const TriangleScene scene = builder.take();
        const ReferenceScene reference{scene};
        const Light light = run % 2 == 0 ? sun({place(random), -1, place(random)})
                                         : lamp({place(random), 3, place(random)});
        std::vector<Vec3d> points;
        for (int i = 0; i < 60; ++i) {
            points.emplace_back(place(random), place(random), place(random));
        }
        const auto truth = find_point_truth(reference, light, points);
        for (std::size_t i = 0; i < points.size(); ++i) {
            SCOPED_TRACE(testing::Message() << "run " << run << ", point " << i);
            EXPECT_EQ(truth.point_class[i],
                      class_by_rationals(scene, light, RationalVec{points[i]}, no_triangle));
        }
    }
}

TEST(PointTruth, OfAPointOnItsTriangleIsNeverItsOwnShadow)
{
    // A tenth is no double: in space the point lies off the plane, on the triangle it does not.
    SceneBuilder builder;
    builder.add("slope", std::vector<Vec3d>{{0, 0, 0}, {1, 0.1, 0}, {0, 0.3, 1}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}});
    const TriangleScene scene = builder.take();
    const ReferenceScene reference{scene};
    OwnedPoints points;
    std::vector<Vec3d> rounded;
    std::mt19937 random{3};
    std::uniform_real_distribution<double> share{0, 0.5};
    for (int i = 0; i < 500; ++i) {
        const Vec2d place{share(random), share(random)};
        points.add(0, place);
        const auto corner = scene.corners(0);
        rounded.push_back(Vec3d{corner[0]} + place.x * (Vec3d{corner[1]} - Vec3d{corner[0]}) +
                          place.y * (Vec3d{corner[2]} - Vec3d{corner[0]}));
    }
    const Light light = sun({0.3, -1, 0.2});
    const auto on_triangle = find_point_truth(reference, light, points.points());
    EXPECT_EQ(std::ranges::count(on_triangle.point_class, PixelClass::lit), 500);
    const auto in_space = find_point_truth(reference, light, rounded);
    EXPECT_GT(std::ranges::count(in_space.point_class, PixelClass::blocked), 50);
}

TEST(PointTruth, OfTheOtherSideAndOfALightInThePlaneIsAttached)
{
    const TriangleScene scene = plate_over_ground();
    const ReferenceScene reference{scene};
    OwnedPoints points;
    points.add(2, {0.25, 0.25});
    const auto class_of = [&](const Light& light, PointSide side) {
        return find_point_truth(reference, light, points.points(side)).point_class.front();
    };
    const Light above = sun({0, -1, 0});
    const bool faces_up = class_of(above, PointSide::front) == PixelClass::lit;
    EXPECT_EQ(class_of(above, PointSide::to_light), PixelClass::lit);
    EXPECT_EQ(class_of(above, faces_up ? PointSide::back : PointSide::front), PixelClass::attached);
    for (const PointSide side : {PointSide::to_light, PointSide::front, PointSide::back}) {
        EXPECT_EQ(class_of(sun({1, 0, 0}), side), PixelClass::attached);
    }
    EXPECT_EQ(find_point_truth(reference, sun({1, 0, 0}), points.points()).share(0),
              (scene::LightShare{0, 0}));
}

TEST(PointTruth, OfPointsAtAndBehindThePlateIsByHand)
{
    const TriangleScene scene = plate_over_ground(); // a plate at y = 1, x and z from −1/3 to 1
    const ReferenceScene reference{scene};
    const std::vector<Vec3d> points{
        {0.5, 0.5, 0.25},                      // under it
        {0.5, 1, 0.25},                        // in it: met at P only
        {0.5, std::nextafter(1.0, 0.0), 0.25}, // the next below it
        {0.5, 1.5, 0.25},                      // over it
        {1, 0.5, 0.25},                        // under its border
        {1, 0.5, 1},                           // under its corner
        {std::nextafter(1.0, 2.0), 0.5, 0.25}, // beside it
        {0.5, 0.5, 0.5},                       // under its diagonal
        {0.5, -1e15, 0.25},                    // through the ground too
        {-8, std::numeric_limits<double>::denorm_min(), std::numbers::pi}}; // beside the ground
    const auto truth = find_point_truth(reference, sun({0, -1, 0}), points);
    const std::vector<PixelClass> expected{PixelClass::blocked,       PixelClass::lit,
                                           PixelClass::blocked,       PixelClass::lit,
                                           PixelClass::indeterminate, PixelClass::indeterminate,
                                           PixelClass::lit,           PixelClass::blocked,
                                           PixelClass::blocked,       PixelClass::lit};
    EXPECT_EQ(truth.point_class, expected);
    EXPECT_EQ(truth.reason[4], scene::ClassReason::silhouette);
    EXPECT_EQ(truth.reason[5], scene::ClassReason::vertex);
}

/// Directions with components that Embree replaces: below 1e-18, and of both signs.
TEST(PointTruth, IsTheSameWhateverPointsAreBesideInItsPacket)
{
    std::mt19937 random{1};
    std::uniform_real_distribution<double> place{-2, 2};
    SceneBuilder builder; // its middle is the origin, so that what is tiny stays so
    for (const double corner : {-3, 3}) {
        builder.add("corner",
                    std::vector<Vec3d>{Vec3d{corner}, Vec3d{corner, corner, 0.9 * corner},
                                       Vec3d{corner, 0.9 * corner, corner}},
                    std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    }
    for (int i = 0; i < 40; ++i) {
        std::vector<Vec3d> corners;
        for (int k = 0; k < 3; ++k) {
            corners.emplace_back(place(random), place(random), place(random));
        }
        builder.add("soup", corners, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    }
    const TriangleScene scene = builder.take();
    const ReferenceScene reference{scene};
    std::vector<Vec3d> points;
    for (int i = 0; i < 400; ++i) {
        const double tiny = (i % 2 == 0 ? 1 : -1) * std::pow(10.0, -16 - i % 8);
        points.push_back(i % 3 == 0 ? Vec3d{tiny, place(random), place(random)}
                                    : Vec3d{place(random), place(random), tiny});
    }
    for (const Light& light : {lamp({0, 3, 0}), sun({1e-20, -1, -1e-19})}) {
        const auto together = find_point_truth(reference, light, points);
        int blocked = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(together.point_class[i],
                      class_by_rationals(scene, light, RationalVec{points[i]}, no_triangle))
                << i;
            blocked += scene::is_blocked(together.point_class[i]) ? 1 : 0;
        }
        EXPECT_GT(blocked, 50);
    }
}

TEST(PointTruth, OfSubnormalCoordinatesIsTheSameForAnyNumberOfThreads)
{
    SceneBuilder builder; // its edge is at x = 0
    builder.add("plate", std::vector<Vec3d>{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
    const TriangleScene scene = builder.take();
    const ReferenceScene reference{scene};
    const std::vector<Vec3d> points(100, Vec3d{1e-310, 0, 0.25});
    for (const int threads : {0, 1, 2}) {
        const auto truth =
            find_point_truth(reference, sun({0, -1, 0}), points, {.threads = threads});
        EXPECT_EQ(std::ranges::count(truth.point_class, PixelClass::blocked), 100) << threads;
    }
}

TEST(PointTruth, OfTinyScenesSeenFromVeryFarIsThatOfRationals)
{
    std::mt19937 random{4};
    std::uniform_real_distribution<double> place{-1, 1};
    SceneBuilder builder;
    for (int i = 0; i < 20; ++i) {
        std::vector<Vec3d> corners;
        for (int k = 0; k < 3; ++k) {
            corners.push_back(0x1p-78 * Vec3d{place(random), place(random), place(random)});
        }
        builder.add("soup", corners, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    }
    const TriangleScene scene = builder.take();
    const ReferenceScene reference{scene};
    const Light light = sun({0.25, -1, 0.5});
    std::vector<Vec3d> points;
    for (int i = 0; i < 200; ++i) {
        // Upstream and downstream of the scene, on lines that come near it, from 2^-70 to 2^49
        // away.
        const double away = std::ldexp(i % 2 == 0 ? 1.0 : -1.0, -70 + i % 120);
        points.push_back(away * light.direction);
    }
    const auto truth = find_point_truth(reference, light, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(truth.point_class[i],
                  class_by_rationals(scene, light, RationalVec{points[i]}, no_triangle))
            << i;
    }
}

TEST(PointTruth, EndsWhereItIsInterrupted)
{
    const TriangleScene scene = plate_over_ground();
    const ReferenceScene reference{scene};
    struct Interruption {};
    const std::vector<Vec3d> points(200'000, Vec3d{0.5, 0.5, 0.25});
    int calls = 0;
    const PointOptions options{.check_interruption = [&] {
        if (++calls == 2) {
            throw Interruption{};
        }
    }};
    EXPECT_THROW((void)find_point_truth(reference, sun({0, -1, 0}), points, options), Interruption);
    calls = 0;
    EXPECT_THROW((void)project_points(reference, points, options), Interruption);
}

TEST(PointTruth, NamesTheIndexOfAnyBadPoint)
{
    const TriangleScene scene = plate_over_ground();
    const ReferenceScene reference{scene};
    std::vector<Vec3d> points(150'000, Vec3d{0.5, 0.5, 0.25});
    points[140'000].y = std::numeric_limits<double>::quiet_NaN();
    try {
        (void)find_point_truth(reference, sun({0, -1, 0}), points);
        ADD_FAILURE();
    } catch (const scene::InputError& error) {
        EXPECT_THAT(error.what(), testing::StartsWith("points[140000]: y is nan"));
    }
}

TEST(PointTruth, OfAPointAtTheLightIsLit)
{
    const TriangleScene scene = plate_over_ground();
    const ReferenceScene reference{scene};
    const std::vector<Vec3d> points{{0.5, 2, 0.5}, {0.5, 1, 0.25}};
    EXPECT_EQ(find_point_truth(reference, lamp(points[0]), points).point_class[0], PixelClass::lit);
    // Inside the plate's plane, as the light is.
    EXPECT_EQ(find_point_truth(reference, lamp(points[1]), points).point_class[1], PixelClass::lit);
}

TEST(PointTruth, FarFromTheOriginKeepsItsClasses)
{
    // A power of two away, the float32 vertices are the same but for the translation.
    const Vec3d away{0x1p20, -0x1p20, 0x1p21};
    const auto scene_at = [](const Vec3d& origin) {
        SceneBuilder builder;
        builder.add("plate",
                    std::vector<Vec3d>{origin + Vec3d{-4, 4, -4}, origin + Vec3d{-4, 4, 4},
                                       origin + Vec3d{4, 4, 4}},
                    std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
        return builder.take();
    };
    std::mt19937 random{11};
    std::uniform_int_distribution<int> place{-64, 64};
    std::vector<Vec3d> points;
    std::vector<Vec3d> moved;
    for (int i = 0; i < 400; ++i) {
        points.push_back(Vec3d{place(random), place(random), place(random)} / 8.0);
        moved.push_back(points.back() + away);
    }
    const Light light = sun({0.25, -1, 0.5});
    EXPECT_EQ(find_point_truth(ReferenceScene{scene_at(Vec3d{0.0})}, light, points).point_class,
              find_point_truth(ReferenceScene{scene_at(away)}, light, moved).point_class);
}

TEST(PointTruth, OfProjectedPointsIsFreeOfTheirOwnSurface)
{
    SceneBuilder builder;
    add_sphere(builder, {0, 0, 0}, 1, 24);
    const TriangleScene scene = builder.take();
    const ReferenceScene reference{scene};
    std::mt19937 random{5};
    std::normal_distribution<double> normal;
    std::vector<Vec3d> points;
    for (int i = 0; i < 300; ++i) {
        points.push_back(1.02 * glm::normalize(Vec3d{normal(random), normal(random), 0} +
                                               Vec3d{0, 0, normal(random)}));
    }
    const auto projected = project_points(reference, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto corner = scene.corners(projected.triangles[i]);
        const Vec3d a{corner[0]};
        const Vec3d on_triangle = a + projected.barycentrics[i].x * (Vec3d{corner[1]} - a) +
                                  projected.barycentrics[i].y * (Vec3d{corner[2]} - a);
        // Rounding moves it along the triangle, a few units of the last place of 1.
        EXPECT_NEAR(glm::length(on_triangle - points[i]), projected.distance_m[i], 1e-14);
        // Between the radius and the middle of a facet, 1 − cos(π/24)² = 0.017 below it at most.
        EXPECT_LT(projected.distance_m[i], 0.04);
    }
    const Light light = sun({0, -1, 0});
    const auto truth = find_point_truth(reference, light,
                                        SurfacePoints{projected.triangles, projected.barycentrics});
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].y > 0.2) {
            EXPECT_EQ(truth.point_class[i], PixelClass::lit) << i;
        } else if (points[i].y < -0.2) {
            EXPECT_EQ(truth.point_class[i], PixelClass::blocked) << i;
        }
    }
}

struct BadInput {
    std::function<void(const ReferenceScene&)> ask;
    std::string words;
};

TEST(PointTruth, RejectsBadInputByArgumentAndIndex)
{
    const TriangleScene scene = plate_over_ground();
    const ReferenceScene reference{scene};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    const auto in_space = [](const Vec3d& point) {
        return [point](const ReferenceScene& of) {
            (void)find_point_truth(of, sun({0, -1, 0}), std::vector<Vec3d>{Vec3d{0.0}, point});
        };
    };
    const auto on_triangle = [](std::uint32_t triangle, Vec2d place) {
        return [triangle, place](const ReferenceScene& of) {
            OwnedPoints points;
            points.add(triangle, place);
            (void)find_point_truth(of, sun({0, -1, 0}), points.points());
        };
    };
    const auto by = [](const Light& light) {
        return [light](const ReferenceScene& of) {
            (void)find_point_truth(of, light, std::vector<Vec3d>{Vec3d{0.0}});
        };
    };
    const std::vector<BadInput> inputs{
        {in_space({0, nan, 0}), "points[1]: y is nan"},
        {in_space({0, 0, infinite}), "points[1]: z is inf"},
        {in_space({-2e15, 0, 0}), "points[1]: x is -2000000000000000"},
        {on_triangle(4, {0, 0}), "triangles[0] is 4: the scene has 4 triangles"},
        {on_triangle(no_triangle, {0, 0}), "triangles[0] is 4294967295"},
        {on_triangle(0, {nan, 0}), "barycentrics[0] is (nan, 0)"},
        {on_triangle(0, {0.75, 0.5}), "barycentrics[0] is (0.75, 0.5)"},
        {on_triangle(0, {-infinite, 0}), "barycentrics[0] is (-inf, 0)"},
        {by(sun({0, 0, 0})), "light.direction is 0"},
        {by(sun({0, nan, 0})), "light.direction: y is nan"},
        {by(sun({1, 1e-40, 0})), "light.direction: y is 1e-40"},
        {by(lamp({1e16, 0, 0})), "light.position: x is 1e+16"}};
    for (const BadInput& input : inputs) {
        try {
            input.ask(reference);
            ADD_FAILURE() << "accepted: " << input.words;
        } catch (const scene::InputError& error) {
            EXPECT_EQ(std::string{error.what()}.substr(0, input.words.size()), input.words);
        }
    }
}

TEST(PointTruth, OfNoPointsIsEmpty)
{
    const TriangleScene scene = plate_over_ground();
    const auto truth =
        find_point_truth(ReferenceScene{scene}, sun({0, -1, 0}), std::vector<Vec3d>{});
    EXPECT_TRUE(truth.point_class.empty());
}

} // namespace
} // namespace gnomon::reference_rt::test
