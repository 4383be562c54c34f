#include "scene/camera/clip.hpp"
#include "scene/light/fit_frustum.hpp"
#include "scene/light/frustum.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace gnomon::scene {
namespace {

constexpr int scene_count = 200;

/// Portable random numbers: std's distributions differ between libraries.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_{seed} {}
    double between(double low, double high)
    {
        return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
    }
    int below(int count) { return static_cast<int>(between(0, count)); }
    Vec3d in_cube(double half) // component by component: arguments have no order
    {
        Vec3d p;
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = between(-half, half);
        }
        return p;
    }

private:
    std::mt19937_64 engine_;
};

struct World {
    TriangleScene scene;
    LightSettings light;
    FrustumSettings frustum;
    CameraSettings camera;
    ImageSize image{320, 180};
};

TriangleScene random_scene(Dice& dice, const Vec3d& centre, double size_m)
{
    SceneBuilder builder;
    for (int i = 0; i < 24; ++i) {
        const Vec3d middle = centre + dice.in_cube(size_m);
        const double reach_m = size_m * std::exp(dice.between(-4, 1));
        std::vector<Vec3d> corners(3);
        for (Vec3d& corner : corners) {
            corner = middle + dice.in_cube(reach_m);
        }
        builder.add(fmt::format("triangle_{}", i), corners,
                    std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    }
    TriangleScene scene = builder.take();
    if (dice.below(2) == 0) {
        add_ground(scene);
    }
    return scene;
}

LightSettings random_light(Dice& dice, const Vec3d& centre, double size_m)
{
    LightSettings light;
    if (dice.below(3) > 0) {
        light.type = LightType::spot;
        light.cone_deg = dice.between(10, 150);
        light.position = centre + dice.in_cube(3 * size_m);
        light.target = centre + dice.in_cube(size_m);
        return light;
    }
    light.direction = dice.in_cube(1);
    if (dice.below(2) == 0) {
        light.position = centre + dice.in_cube(size_m);
    }
    return light;
}

World random_world(Dice& dice)
{
    const double size_m = std::exp(dice.between(-1, 4));
    // Some 20 km from the origin for scenes of 50 m; nearer for the smaller ones, whose sides
    // float32 could not place otherwise.
    const std::array<double, 4> away{0, 0, 10, 400};
    const double away_m = away.at(static_cast<std::size_t>(dice.below(4))) * size_m;
    const Vec3d centre = dice.in_cube(away_m);
    World world{.scene = random_scene(dice, centre, size_m),
                .light = random_light(dice, centre, size_m)};
    world.camera.eye = centre + dice.in_cube(3 * size_m);
    world.camera.target = centre + dice.in_cube(0.5 * size_m);
    world.camera.vertical_fov_deg = dice.between(5, 90);
    world.frustum.fit =
        std::array{Fit::scene, Fit::camera, Fit::fixed}.at(static_cast<std::size_t>(dice.below(3)));
    world.frustum.half_extent_m = size_m * dice.between(0.05, 1);
    world.frustum.fov_deg = dice.between(5, 120);
    world.frustum.roll_deg = dice.between(-180, 180);
    world.frustum.reversed = dice.below(2) == 0;
    return world;
}

LightFrustum map_of(const World& world)
{
    return fit_light_frustum(world.frustum, world.light, make_light(world.light), world.scene,
                             make_camera(world.camera), world.image);
}

/// The map with near and far around the ζ of all vertices (`camera`: up to the farthest visible
/// one), not only of those within the map's sides.
LightFrustum around_the_whole_scene(const World& world, LightFrustum frustum)
{
    double nearest_m = std::numeric_limits<double>::infinity();
    double farthest_m = -nearest_m;
    for (const Vec3f& vertex : world.scene.vertices) {
        nearest_m = std::min(nearest_m, frustum.light_distance_m(Vec3d{vertex}));
        farthest_m = std::max(farthest_m, frustum.light_distance_m(Vec3d{vertex}));
    }
    if (world.frustum.fit == Fit::camera) {
        double seen_m = -std::numeric_limits<double>::infinity();
        visit_visible_corners(
            world.scene, make_camera(world.camera), world.image,
            [&](const Vec3d& p) { seen_m = std::max(seen_m, frustum.light_distance_m(p)); });
        farthest_m = std::isfinite(seen_m) ? seen_m : farthest_m;
    }
    const bool is_spot = frustum.projection == Projection::perspective;
    const double diagonal_m = world.scene.bounds().diagonal_m();
    if (farthest_m - nearest_m < 1e-4 * diagonal_m) {
        const double centre_m = 0.5 * (nearest_m + farthest_m);
        nearest_m = centre_m - 0.5e-4 * diagonal_m;
        farthest_m = centre_m + 0.5e-4 * diagonal_m;
    }
    farthest_m = is_spot && farthest_m <= 0 ? diagonal_m : farthest_m;
    const double padding_m = 1e-4 * (farthest_m - nearest_m);
    frustum.far_m = farthest_m + padding_m;
    frustum.near_m = nearest_m - padding_m;
    if (is_spot) {
        frustum.near_m = std::max(frustum.near_m, 1e-3 * frustum.far_m);
    }
    compose_matrix(frustum);
    return frustum;
}

/// A row times a vertex in float32, as a vertex shader evaluates it.
Vec4f in_float32(const Mat4f& matrix, const Vec3f& p)
{
    Vec4f clip;
    for (int i = 0; i < 4; ++i) {
        clip[i] = matrix[0][i] * p.x + matrix[1][i] * p.y + matrix[2][i] * p.z + matrix[3][i];
    }
    return clip;
}

/// A triangle by one map's matrix: its clip positions, exactly but for double, and GL's.
struct ClipTriangle {
    std::array<Vec4d, 3> exact;
    std::array<Vec4d, 3> of_gl;
};

ClipTriangle clip_triangle(const LightFrustum& frustum, const std::array<Vec3f, 3>& corners)
{
    ClipTriangle result;
    for (std::size_t i = 0; i < 3; ++i) {
        const Mat4f& matrix = frustum.light_clip_from_world;
        result.exact.at(i) = Mat4d{matrix} * Vec4d{Vec3d{corners.at(i)}, 1};
        result.of_gl.at(i) = Vec4d{in_float32(matrix, corners.at(i))};
    }
    return result;
}

/// Barycentric coordinates are exact input here, so that corners are corners.
template <typename Vector>
Vector at(const std::array<Vector, 3>& corners, const Vec3d& weights)
{
    return weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
}

bool is_within_sides(const Vec4d& clip)
{
    return clip.w > 0 && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
}

bool is_within_planes(const Vec4d& clip, const LightFrustum& frustum)
{
    const double least = frustum.clip_range == ClipRange::zero_to_one ? 0 : -clip.w;
    return least <= clip.z && clip.z <= clip.w;
}

/// Whether a point of a triangle is in the map, in exact and in float32 arithmetic.
struct Held {
    bool exactly = false;
    bool by_gl = false;
};

Held held(const LightFrustum& map, const ClipTriangle& triangle, const Vec3d& weights)
{
    const Vec4d exact = at(triangle.exact, weights);
    const Vec4d of_gl = at(triangle.of_gl, weights);
    return {is_within_sides(exact) && is_within_planes(exact, map),
            is_within_sides(of_gl) && is_within_planes(of_gl, map)};
}

/// The point farthest from `inside` towards `outside` that GL still finds within the sides.
Vec3d last_within(const ClipTriangle& triangle, Vec3d inside, Vec3d outside)
{
    for (int i = 0; i < 60; ++i) {
        const Vec3d middle = 0.5 * (inside + outside);
        (is_within_sides(at(triangle.of_gl, middle)) ? inside : outside) = middle;
    }
    return inside;
}

/// Corners, points within, and for each the last one before a side on the way to another.
std::vector<Vec3d> sampled_weights(Dice& dice, const ClipTriangle& triangle)
{
    std::vector<Vec3d> weights{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 60; ++i) {
        const double a = dice.between(0, 1);
        const double b = i % 3 == 0 ? 0 : dice.between(0, 1 - a); // a third of them on an edge
        weights.emplace_back(a, b, 1 - a - b);
    }
    const std::size_t count = weights.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3d other = weights[static_cast<std::size_t>(dice.below(static_cast<int>(count)))];
        if (is_within_sides(at(triangle.of_gl, weights[i])) &&
            !is_within_sides(at(triangle.of_gl, other))) {
            weights.push_back(last_within(triangle, weights[i], other));
        }
    }
    return weights;
}

/// What a step of d16 is worth at ζ [m]: with q = 1/(2^16 − 1), q (far − near); for a spot
/// A q ζ²/(1 + A q ζ) with A = 1/near − 1/far, which is the same at either end, reversed or not.
double d16_step_m(const LightFrustum& frustum, double light_distance_m)
{
    constexpr double q = 1.0 / 65535;
    if (frustum.projection == Projection::orthographic) {
        return q * frustum.range_m();
    }
    const double a = 1 / frustum.near_m - 1 / frustum.far_m;
    return a * q * light_distance_m * light_distance_m / (1 + a * q * light_distance_m);
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

struct Samples {
    std::vector<double> step_before_m; ///< d16's, where both maps hold a receiver
    std::vector<double> step_after_m;
    std::size_t lost_count = 0; ///< points that only the map with wider planes holds
};

void sample_triangle(Dice& dice, const LightFrustum& before, const LightFrustum& after,
                     const std::array<Vec3f, 3>& corners, Samples& samples)
{
    const ClipTriangle of_before = clip_triangle(before, corners);
    const ClipTriangle of_after = clip_triangle(after, corners);
    const std::array<Vec3d, 3> points{Vec3d{corners[0]}, Vec3d{corners[1]}, Vec3d{corners[2]}};
    for (const Vec3d& weights : sampled_weights(dice, of_after)) {
        // The wider planes, whose far may be 1000 near, give a matrix with larger errors. Points
        // that it holds only because of its error do not count.
        const double light_distance_m = after.light_distance_m(at(points, weights));
        if (light_distance_m < before.near_m || light_distance_m > before.far_m) {
            continue;
        }
        const Held was = held(before, of_before, weights);
        const Held is = held(after, of_after, weights);
        samples.lost_count += (was.exactly && !is.exactly) || (was.by_gl && !is.by_gl) ? 1U : 0U;
        if (was.exactly && is.exactly) {
            samples.step_before_m.push_back(d16_step_m(before, light_distance_m));
            samples.step_after_m.push_back(d16_step_m(after, light_distance_m));
        }
    }
}

void sample_world(std::uint64_t seed, Samples& samples)
{
    Dice dice{seed};
    const World world = random_world(dice);
    const LightFrustum after = map_of(world);
    const LightFrustum before = around_the_whole_scene(world, after);
    for (std::uint32_t i = 0; i < world.scene.triangles.size(); ++i) {
        sample_triangle(dice, before, after, world.scene.corners(i), samples);
    }
}

TEST(RandomAutoPlanes, ClipNothingWithinTheSidesThatPlanesAroundTheWholeSceneHold)
{
    for (std::uint64_t seed = 1; seed <= scene_count; ++seed) {
        Samples samples;
        sample_world(seed, samples);
        EXPECT_EQ(samples.lost_count, 0U) << "seed " << seed;
    }
}

/// A floor, and above it a needle along the light on the side of a map of 4 m, up to the 2 mm
/// between float32 numbers 20 km from the origin.
World needle_on_a_side(Dice& dice)
{
    const Vec3d centre = dice.in_cube(20000);
    World world;
    world.light.direction = dice.in_cube(1);
    world.light.position = centre;
    world.frustum = {.fit = Fit::fixed, .half_extent_m = 2};
    const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 1, 2}};
    SceneBuilder floor;
    floor.add("floor",
              std::vector<Vec3d>{centre, centre + dice.in_cube(1), centre + dice.in_cube(1)},
              triangle);
    world.scene = floor.take();
    const LightFrustum frustum = map_of(world);
    std::vector<Vec3d> corners;
    for (const double light_distance_m : {-5.0, -6.0, -7.0}) {
        corners.push_back(frustum.origin + light_distance_m * frustum.forward +
                          2.0 * frustum.right + dice.in_cube(0.004));
    }
    SceneBuilder both;
    both.add("needle", corners, triangle);
    const auto [a, b, c] = world.scene.corners(0);
    both.add("floor", std::vector<Vec3d>{Vec3d{a}, Vec3d{b}, Vec3d{c}}, triangle);
    world.scene = both.take();
    return world;
}

TEST(RandomAutoPlanes, HoldWhatOnlyTheRoundingOfGlPutsWithinASide)
{
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
        Dice dice{seed};
        const World world = needle_on_a_side(dice);
        const LightFrustum frustum = map_of(world);
        const ClipTriangle needle = clip_triangle(frustum, world.scene.corners(0));
        if (std::ranges::any_of(needle.exact, is_within_sides)) {
            continue;
        }
        for (const Vec4d& corner : needle.of_gl) {
            found += is_within_sides(corner) ? 1 : 0;
            EXPECT_TRUE(!is_within_sides(corner) || is_within_planes(corner, frustum))
                << "seed " << seed;
        }
    }
    EXPECT_GT(found, 50);
}

TEST(RandomAutoPlanes, MakeTheMedianStepOfA16BitMapFinerThanPlanesAroundTheWholeScene)
{
    Samples samples;
    for (std::uint64_t seed = 1; seed <= scene_count; ++seed) {
        sample_world(seed, samples);
    }
    ASSERT_GT(samples.step_before_m.size(), 10000U);
    const double before_m = median(samples.step_before_m);
    const double after_m = median(samples.step_after_m);
    fmt::print("median d16 step at {} receivers in {} scenes: {:.3g} m around the whole scene, "
               "{:.3g} m around what the map holds\n",
               samples.step_before_m.size(), scene_count, before_m, after_m);
    EXPECT_LT(after_m, before_m);
}

} // namespace
} // namespace gnomon::scene
