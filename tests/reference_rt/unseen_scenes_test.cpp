#include "scene_fixture.hpp"
#include "shadowing_oracle.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <random>

/// Scenes full of exact contacts against brute force in rationals: no scored pixel may be wrong,
/// and every indeterminate one must touch something.
namespace gnomon::reference_rt::test {
namespace {

constexpr ImageSize unseen_image{32, 24};

struct Unseen {
    std::string_view name;
    TriangleScene (*make)(std::mt19937&);
    scene::LightSettings light;
    scene::Projection projection = scene::Projection::perspective;

    friend void PrintTo(const Unseen& shown, std::ostream* out) { *out << shown.name; }
};

/// Boxes on a lattice that share faces, edges and corners, on a ground of coplanar tiles.
TriangleScene touching_boxes(std::mt19937& random)
{
    std::uniform_int_distribution<int> place{-2, 1};
    SceneBuilder builder;
    add_ground(builder, 3, 2);
    for (int i = 0; i < 3; ++i) {
        const Vec3d lower{place(random), i == 2 ? 1 : 0, place(random)};
        add_box(builder, lower, lower + Vec3d{1, 1, 1});
    }
    return builder.take();
}

/// Rectangles in three parallel planes that overlap and abut: coplanar with each other.
TriangleScene coplanar_sheets(std::mt19937& random)
{
    std::uniform_int_distribution<int> place{-4, 2};
    SceneBuilder builder;
    for (int i = 0; i < 12; ++i) {
        const double x = 0.5 * place(random);
        const double z = 0.5 * place(random);
        const double y = 0.5 * (i % 3);
        // Tilted, so that no product vanishes: y rises by a quarter of x.
        const auto at = [&](double dx, double dz) {
            return Vec3d{x + dx, y + 0.25 * (x + dx), z + dz};
        };
        builder.add("sheet", std::vector<Vec3d>{at(0, 0), at(1.5, 0), at(1.5, 1), at(0, 1)},
                    std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}, {0, 3, 2}});
    }
    return builder.take();
}

/// A strip of folded quads: every edge is shared, ridges and valleys alternate.
TriangleScene folded_strip(std::mt19937& random)
{
    std::uniform_int_distribution<int> height{0, 3};
    SceneBuilder builder;
    add_ground(builder, 3, 1, -1);
    std::vector<Vec3d> corners;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 0; i < 9; ++i) {
        const double y = 0.25 * height(random);
        corners.emplace_back(0.5 * i - 2, y, -1);
        corners.emplace_back(0.5 * i - 2, y, 1);
        if (i > 0) {
            const std::uint32_t k = 2 * i;
            triangles.push_back({k - 2, k - 1, k});
            triangles.push_back({k - 1, k + 1, k});
        }
    }
    builder.add("strip", corners, triangles);
    return builder.take();
}

TriangleScene soup(std::mt19937& random)
{
    std::uniform_real_distribution<double> place{-1.5, 1.5};
    SceneBuilder builder;
    for (int i = 0; i < 24; ++i) {
        const Vec3d centre{place(random), place(random), place(random)};
        std::vector<Vec3d> corners;
        for (int k = 0; k < 3; ++k) {
            corners.push_back(centre + 0.6 * Vec3d{place(random), place(random), place(random)});
        }
        builder.add("soup", corners, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    }
    return builder.take();
}

class UnseenScene : public testing::TestWithParam<Unseen> {};

TEST_P(UnseenScene, HasNoWrongPixel)
{
    for (const unsigned seed : {11U, 12U}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random{seed};
        const TriangleScene scene = GetParam().make(random);
        const View view = make_view({1, 2.5, 4}, {0, 0, 0}, unseen_image, GetParam().light,
                                    GetParam().projection);
        const Tally tally = check_every_pixel(scene, view);
        EXPECT_GT(tally.scored, 50);
        EXPECT_GT(tally.blocked, 5);
    }
}

TEST_P(UnseenScene, HasNoWrongPixelAHundredDiagonalsAway)
{
    std::mt19937 random{13};
    TriangleScene scene = GetParam().make(random);
    const double diagonal_m = scene.bounds().diagonal_m();
    // Along (2, −2, 1), in whole metres: vertices are rounded where they do not fit any more.
    const Vec3d shift = glm::round(100 * diagonal_m / 3) * Vec3d{2, -2, 1};
    for (scene::Vec3f& vertex : scene.vertices) {
        vertex = scene::Vec3f{Vec3d{vertex} + shift};
    }
    scene::LightSettings light = GetParam().light;
    if (light.position) {
        *light.position += shift;
        *light.target += shift;
    }
    const View view =
        make_view(Vec3d{1, 2.5, 4} + shift, shift, unseen_image, light, GetParam().projection);
    EXPECT_GT(check_every_pixel(scene, view).scored, 50);
}

/// Looks straight down in parallel rays whose points on the ground are odd multiples of 1/16.
View view_from_above(const scene::LightSettings& light)
{
    scene::CameraSettings camera;
    camera.eye = {0, 4, 0};
    camera.target = {0, 0, 0};
    camera.up = {0, 0, -1};
    camera.projection = scene::Projection::orthographic;
    camera.orthographic_height_m = 4;
    return View{scene::make_camera(camera), {32, 32}, scene::make_light(light), {}, {}};
}

class SceneOnTheSamplingLattice : public testing::TestWithParam<Unseen> {};

TEST_P(SceneOnTheSamplingLattice, HasNoWrongPixel)
{
    int indeterminate = 0;
    int tested = 0;
    for (const unsigned seed : {21U, 22U, 23U}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random{seed};
        TriangleScene scene = GetParam().make(random);
        for (scene::Vec3f& vertex : scene.vertices) {
            vertex += scene::Vec3f{0.0625F, 0, 0.0625F}; // edges now pass through pixel centres
        }
        const Tally tally = check_every_pixel(scene, view_from_above(GetParam().light));
        indeterminate += tally.indeterminate;
        tested += tally.scored;
    }
    EXPECT_GT(tested, 500);
    EXPECT_GT(indeterminate, 0);
}

/// Spots at degenerate positions: in a box, on its corners, edges and faces, and in the plane of
/// the ground; all aimed at one point.
std::vector<scene::LightSettings> awkward_lights()
{
    std::vector<scene::LightSettings> lights;
    for (const Vec3d& position : {Vec3d{0.5, 0.5, 0.5}, Vec3d{1, 1, 1}, Vec3d{0.5, 1, 0},
                                  Vec3d{0.25, 1, 0.5}, Vec3d{3, 0, 3}, Vec3d{-1.5, 0, 2}}) {
        lights.push_back(spot(position, {0.125, -0.25, 0.375}, 179));
    }
    return lights;
}

TEST(AwkwardLight, MakesNoPixelWrong)
{
    int scored = 0;
    for (const scene::LightSettings& light : awkward_lights()) {
        SCOPED_TRACE(testing::Message() << "light at " << light.position->x << ' '
                                        << light.position->y << ' ' << light.position->z);
        SceneBuilder builder;
        add_ground(builder, 3, 2);
        add_box(builder, {0, 0, 0}, {1, 1, 1});
        add_box(builder, {-1, 0, 1}, {0, 1, 2});
        const TriangleScene scene = builder.take();
        scored +=
            check_every_pixel(scene, make_view({1, 2.5, 4}, {0, 0, 0}, unseen_image, light)).scored;
        scored += check_every_pixel(scene, view_from_above(light)).scored;
    }
    EXPECT_GT(scored, 1000);
}

TEST(AwkwardCamera, MakesNoPixelWrong)
{
    std::mt19937 random{14};
    const TriangleScene scene = touching_boxes(random);
    int scored = 0;
    // Along a ground tile's edge and its plane's normal, from a vertex, and from within the ground.
    for (const auto& [eye, target] :
         {std::pair{Vec3d{0, 3, 2}, Vec3d{0, 0, 0}}, std::pair{Vec3d{3, 3, 3}, Vec3d{0, 0, 0}},
          std::pair{Vec3d{3, 0, 3}, Vec3d{0, 1, 0}},
          std::pair{Vec3d{0.5, 0, 2.5}, Vec3d{0, 0.5, 0}}}) {
        for (const auto projection :
             {scene::Projection::perspective, scene::Projection::orthographic}) {
            SCOPED_TRACE(testing::Message() << "eye at " << eye.x << ' ' << eye.y << ' ' << eye.z);
            View view = make_view(eye, target, {33, 25}, directional({-1, -1, -0.5}), projection);
            scored += check_every_pixel(scene, view).scored;
        }
    }
    EXPECT_GT(scored, 1000);
}

TEST(TinyScene, HasNoWrongPixel)
{
    // 1e-6 is no power of two: every vertex is rounded anew, and shared faces no longer coincide.
    for (const unsigned seed : {15U, 16U}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random{seed};
        for (TriangleScene scene : {touching_boxes(random), soup(random)}) {
            for (scene::Vec3f& vertex : scene.vertices) {
                vertex *= 1e-6F;
            }
            const auto light = spot({-1e-6, 3e-6, 1e-6}, {0, 0, 0}, 150);
            const View view = make_view({1e-6, 2.5e-6, 4e-6}, {0, 0, 0}, unseen_image, light);
            EXPECT_GT(check_every_pixel(scene, view).scored, 50);
        }
    }
}

const scene::LightSettings slanted = directional({-0.4, -1, -0.3});
const scene::LightSettings upright = directional({0, -1, 0});
const scene::LightSettings diagonal = directional({-1, -1, 0});
const scene::LightSettings positional = spot({-1, 3, 1}, {0, 0, 0}, 150);

INSTANTIATE_TEST_SUITE_P(Kinds, UnseenScene,
                         testing::Values(Unseen{"boxes, slanted", touching_boxes, slanted},
                                         Unseen{"boxes, upright", touching_boxes, upright},
                                         Unseen{"boxes, diagonal", touching_boxes, diagonal},
                                         Unseen{"boxes, orthographic", touching_boxes, diagonal,
                                                scene::Projection::orthographic},
                                         Unseen{"boxes, positional", touching_boxes, positional},
                                         Unseen{"sheets, slanted", coplanar_sheets, slanted},
                                         Unseen{"sheets, positional", coplanar_sheets, positional},
                                         Unseen{"strip, upright", folded_strip, upright},
                                         Unseen{"strip, positional", folded_strip, positional},
                                         Unseen{"soup, slanted", soup, slanted},
                                         Unseen{"soup, positional, orthographic", soup, positional,
                                                scene::Projection::orthographic}));

INSTANTIATE_TEST_SUITE_P(Kinds, SceneOnTheSamplingLattice,
                         testing::Values(Unseen{"boxes, diagonal", touching_boxes, diagonal},
                                         Unseen{"boxes, positional", touching_boxes,
                                                spot({0.0625, 3, 0.0625}, {0, 0, 0}, 150)},
                                         Unseen{"strip, diagonal", folded_strip, diagonal}));

} // namespace
} // namespace gnomon::reference_rt::test
