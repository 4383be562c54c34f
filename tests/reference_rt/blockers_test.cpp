#include "exact_oracle.hpp"
#include "scene_fixture.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace gnomon::reference_rt::test {
namespace {

constexpr ImageSize blocked_image{40, 30};

/// Sheets above a ground, several of which cover a point.
TriangleScene layered_scene(std::mt19937& random)
{
    std::uniform_real_distribution<double> place{-1, 1};
    SceneBuilder builder;
    add_ground(builder, 2, 1, -1);
    for (int i = 0; i < 30; ++i) {
        std::vector<Vec3d> corners;
        for (int k = 0; k < 3; ++k) {
            corners.emplace_back(place(random), 0.5 * place(random), place(random));
        }
        builder.add("sheet", corners, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    }
    TriangleScene scene = builder.take();
    for (std::size_t i = 1; i < scene.objects.size(); ++i) {
        scene.objects[i].receives = false;
    }
    return scene;
}

/// The crossing farthest along the segment from P, by trying every triangle.
std::uint32_t exact_nearest_to_light(const TriangleScene& scene, const View& view,
                                     const RationalVec& point, std::uint32_t receiver)
{
    const RationalVec step = view.light.type == scene::LightType::directional
                                 ? RationalVec{-view.light.direction}
                                 : RationalVec{view.light.position} - point;
    std::uint32_t nearest = no_triangle;
    Rational farthest = 0;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        if (t == receiver ||
            exact_contact(point, view.light, scene.corners(t)) != ExactContact::cross) {
            continue;
        }
        const Rational distance = hit_of(point, step, scene.corners(t))->t;
        if (distance > farthest) {
            farthest = distance;
            nearest = t;
        }
    }
    return nearest;
}

TEST(NearestBlockers, AreThoseOfBruteForceInRationals)
{
    for (const unsigned seed : {41U, 42U}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random{seed};
        const TriangleScene scene = layered_scene(random);
        const View view = make_view({0.5, 3, 2}, {0, -1, 0}, blocked_image,
                                    seed == 41 ? directional({0.3, -1, 0.2})
                                               : spot({0, 2, 0.5}, {0, -1, 0}, 160));
        const auto receivers = brute_force_receivers(scene, view);
        const ReferenceScene reference{scene};
        const auto truth = compute_truth(reference, view, receivers, {});
        std::vector<std::size_t> pixels;
        for (std::size_t i = 0; i < receivers.pixel_count(); ++i) {
            if (scene::is_scored(truth.pixel_class[i])) {
                pixels.push_back(i);
            }
        }
        const auto blockers = nearest_blockers(reference, view, receivers, pixels, 2);
        ASSERT_EQ(blockers.size(), pixels.size());
        int other_than_witness = 0;
        for (std::size_t k = 0; k < pixels.size(); ++k) {
            const std::size_t i = pixels[k];
            const scene::Ray ray = scene::pixel_ray(view.camera, view.image,
                                                    static_cast<int>(i) % blocked_image.width_px,
                                                    static_cast<int>(i) / blocked_image.width_px);
            const RationalVec point = exact_point(ray, scene.corners(receivers[i]));
            EXPECT_EQ(blockers[k], exact_nearest_to_light(scene, view, point, receivers[i]))
                << "pixel " << i;
            EXPECT_EQ(blockers[k] == no_triangle, truth.witness[i] == no_triangle);
            other_than_witness += blockers[k] != truth.witness[i] ? 1 : 0;
        }
        EXPECT_GT(other_than_witness, 0);
    }
}

TEST(NearestBlockers, PreferTheLowestOfSeveralAtTheSamePoint)
{
    SceneBuilder builder;
    add_ground(builder, 2, 1);
    const std::vector<Vec3d> roof{{-2, 1, -2}, {2, 1, -2}, {0, 1, 3}};
    for (int i = 0; i < 3; ++i) {
        builder.add("roof", roof, std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}});
    }
    TriangleScene scene = builder.take();
    for (std::size_t i = 1; i < 4; ++i) {
        scene.objects[i].receives = false;
    }
    const View view = make_view({0, 3, 1}, {0, 0, 0}, {9, 9}, directional({0, -1, 0}));
    const auto receivers = brute_force_receivers(scene, view);
    const std::vector<std::size_t> centre{40};
    EXPECT_EQ(nearest_blockers(ReferenceScene{scene}, view, receivers, centre),
              std::vector<std::uint32_t>{2});
}

TEST(NearestBlockers, CountTheLowerTriangleOfASeam)
{
    SceneBuilder builder;
    add_ground(builder, 4, 1);
    builder.add("roof", std::vector<Vec3d>{{0, 1, -1}, {0, 1, 1}, {-1, 0.5, 0}, {1, 0.5, 0}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {1, 0, 3}});
    TriangleScene scene = builder.take();
    scene.objects.back().receives = false;
    // An odd width puts the centre column's pixels on x = 0, straight below the ridge.
    const View view = make_view({0, 2, 2}, {0, 0, 0}, {65, 49}, directional({0, -1, 0}));
    const auto receivers = brute_force_receivers(scene, view);
    const std::vector<std::size_t> ridge{24 * 65 + 32};
    EXPECT_EQ(nearest_blockers(ReferenceScene{scene}, view, receivers, ridge),
              std::vector<std::uint32_t>{2});
}

TEST(NearestBlockers, RejectPixelsWithoutReceiver)
{
    std::mt19937 random{1};
    const TriangleScene scene = layered_scene(random);
    const View view = make_view({0, 3, 2}, {0, 0, 0}, blocked_image, directional({0, -1, 0}));
    const Image<std::uint32_t> nothing{blocked_image, no_triangle};
    const std::vector<std::size_t> first{0};
    const std::vector<std::size_t> outside{blocked_image.pixel_count()};
    const ReferenceScene reference{scene};
    EXPECT_THROW((void)nearest_blockers(reference, view, nothing, first), std::invalid_argument);
    const Image<std::uint32_t> ground{blocked_image, 0};
    EXPECT_THROW((void)nearest_blockers(reference, view, ground, outside), std::invalid_argument);
    const ReferenceScene plain{scene, {0, false, true}};
    EXPECT_THROW((void)nearest_blockers(plain, view, ground, first), std::invalid_argument);
}

} // namespace
} // namespace gnomon::reference_rt::test
