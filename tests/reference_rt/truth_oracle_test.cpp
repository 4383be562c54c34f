#include "exact_oracle.hpp"
#include "scene_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <random>

/// Compares the reference with an independent oracle in rationals, on random triangles.
namespace gnomon::reference_rt::test {
namespace {

constexpr ImageSize oracle_image{36, 27};

/// Triangles about as large as the cube [-1, 1]^3 in which their middles lie.
TriangleScene triangle_soup(std::mt19937& random, int triangle_count)
{
    std::uniform_real_distribution<double> place{-1, 1};
    std::uniform_real_distribution<double> size{-0.9, 0.9};
    SceneBuilder builder;
    for (int i = 0; i < triangle_count; ++i) {
        const Vec3d centre{place(random), place(random), place(random)};
        std::vector<Vec3d> corners;
        for (int k = 0; k < 3; ++k) {
            corners.push_back(centre + Vec3d{size(random), size(random), size(random)});
        }
        builder.add("soup", corners, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    }
    return builder.take();
}

View view_of_soup(std::mt19937& random, bool has_directional, scene::Projection projection)
{
    std::uniform_real_distribution<double> place{-1, 1};
    const Vec3d side{place(random), place(random), place(random)};
    const scene::LightSettings light =
        has_directional ? directional(side) : spot(Vec3d{0, 3, 0} + side, {0, 0, 0}, 170);
    return make_view(Vec3d{0, 0, 3} + 0.5 * side, {0, 0, 0}, oracle_image, light, projection);
}

/// Classes by brute force; the random soups hold no degenerate contact.
bool is_exactly_blocked(const TriangleScene& scene, const View& view, const RationalVec& point,
                        std::uint32_t receiver)
{
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const ExactContact contact =
            t == receiver ? ExactContact::none : exact_contact(point, view.light, scene.corners(t));
        EXPECT_NE(contact, ExactContact::boundary) << "triangle " << t;
        if (contact == ExactContact::cross) {
            return true;
        }
    }
    return false;
}

struct Judged {
    int blocked = 0;
    int lit = 0;
};

/// Checks every scored pixel and every witness.
Judged check_against_oracle(const TriangleScene& scene, const View& view,
                            const Image<std::uint32_t>& receivers, const scene::Truth& truth)
{
    Judged judged;
    for (int y = 0; y < view.image.height_px; ++y) {
        for (int x = 0; x < view.image.width_px; ++x) {
            SCOPED_TRACE(testing::Message() << "pixel " << x << ", " << y);
            const PixelClass pixel_class = truth.pixel_class(x, y);
            if (!scene::is_scored(pixel_class)) {
                EXPECT_EQ(truth.witness(x, y), no_triangle);
                continue;
            }
            const std::uint32_t receiver = receivers(x, y);
            const RationalVec point = exact_point(scene::pixel_ray(view.camera, view.image, x, y),
                                                  scene.corners(receiver));
            const bool is_blocked = pixel_class == PixelClass::blocked;
            EXPECT_EQ(is_blocked, is_exactly_blocked(scene, view, point, receiver));
            if (is_blocked) {
                ++judged.blocked;
                EXPECT_EQ(exact_contact(point, view.light, scene.corners(truth.witness(x, y))),
                          ExactContact::cross);
            } else {
                ++judged.lit;
                EXPECT_EQ(truth.witness(x, y), no_triangle);
            }
        }
    }
    return judged;
}

struct Soup {
    unsigned seed;
    bool has_directional;
    scene::Projection projection;

    friend void PrintTo(const Soup& soup, std::ostream* out) { *out << "seed " << soup.seed; }
};

class TriangleSoup : public testing::TestWithParam<Soup> {};

TEST_P(TriangleSoup, IsJudgedAsByRationals)
{
    std::mt19937 random{GetParam().seed};
    const TriangleScene scene = triangle_soup(random, 24);
    const View view = view_of_soup(random, GetParam().has_directional, GetParam().projection);
    const auto receivers = brute_force_receivers(scene, view);
    const auto truth = compute_truth(ReferenceScene{scene}, view, receivers, {});
    const Judged judged = check_against_oracle(scene, view, receivers, truth);
    EXPECT_GT(judged.blocked, 0) << "seed " << GetParam().seed;
    EXPECT_GT(judged.lit, 0) << "seed " << GetParam().seed;
    EXPECT_GT(judged.blocked + judged.lit, 50) << "seed " << GetParam().seed;
    EXPECT_EQ(count(truth.pixel_class, PixelClass::unmatched), 0);
}

TEST_P(TriangleSoup, KeepsItsClassesWhenTrianglesArePermuted)
{
    std::mt19937 random{GetParam().seed};
    const TriangleScene scene = triangle_soup(random, 200);
    const View view = view_of_soup(random, GetParam().has_directional, GetParam().projection);
    const auto receivers = brute_force_receivers(scene, view);
    const auto truth = compute_truth(ReferenceScene{scene}, view, receivers, {});

    TriangleScene permuted = scene;
    std::vector<std::uint32_t> order(scene.triangles.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::ranges::shuffle(order, random);
    std::vector<std::uint32_t> place_of(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        permuted.triangles[i] = scene.triangles[order[i]];
        place_of[order[i]] = i;
    }
    Image<std::uint32_t> renamed = receivers;
    for (std::size_t i = 0; i < renamed.pixel_count(); ++i) {
        renamed[i] = renamed[i] == no_triangle ? no_triangle : place_of[renamed[i]];
    }
    const auto again = compute_truth(ReferenceScene{permuted}, view, renamed, {});
    EXPECT_TRUE(std::ranges::equal(truth.pixel_class, again.pixel_class))
        << "seed " << GetParam().seed;
}

INSTANTIATE_TEST_SUITE_P(Seeds, TriangleSoup,
                         testing::Values(Soup{1, true, scene::Projection::perspective},
                                         Soup{2, true, scene::Projection::orthographic},
                                         Soup{3, false, scene::Projection::perspective},
                                         Soup{4, false, scene::Projection::orthographic},
                                         Soup{5, true, scene::Projection::perspective}));

} // namespace
} // namespace gnomon::reference_rt::test
