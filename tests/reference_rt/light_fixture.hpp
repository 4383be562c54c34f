#pragma once

#include "lane.hpp"
#include "light_oracle.hpp"
#include "reference_rt/light/light_queries.hpp"
#include "scene/light/fit_frustum.hpp"
#include "scene_fixture.hpp"

#include <gtest/gtest.h>

#include <random>

namespace gnomon::reference_rt::test {

using renderers::ExactTap;
using renderers::HitDetail;
using renderers::LinearQuery;
using renderers::NearestQuery;
using renderers::SelfShadowingQuery;
using renderers::TexelHit;
using scene::Cull;
using scene::Texel;

/// A scene, its view with the light's frustum, and what the camera sees.
struct LitScene {
    LitScene(TriangleScene triangles_in, const scene::LightSettings& light,
             const scene::FrustumSettings& frustum, int resolution_in = 16,
             ImageSize image = {24, 18})
        : triangles{std::move(triangles_in)},
          view{make_view({0.4, 5, 3}, {0, 0, 0}, image, light)},
          reference{triangles},
          resolution{resolution_in}
    {
        view.maps = {scene::fit_light_frustum(frustum, light, view.light, triangles, view.camera,
                                              view.image)};
        receivers = brute_force_receivers(triangles, view);
    }
    LitScene(const LitScene&) = delete;
    LitScene& operator=(const LitScene&) = delete;

    [[nodiscard]] std::unique_ptr<renderers::LightQueries> light_queries(Cull cull = Cull::none,
                                                                         int threads = 0) const
    {
        return make_light_queries(reference, view, receivers, resolution, cull, threads);
    }
    [[nodiscard]] std::vector<Texel> all_texels() const
    {
        std::vector<Texel> texels;
        for (int y = 0; y < resolution; ++y) {
            for (int x = 0; x < resolution; ++x) {
                texels.push_back({x, y});
            }
        }
        return texels;
    }
    [[nodiscard]] scene::Ray texel_ray(Texel texel) const
    {
        return TexelRays{view.first_map(), view.light, resolution}.ray(texel);
    }
    /// Pixels that are lit or blocked.
    [[nodiscard]] std::vector<std::size_t> scored_pixels() const
    {
        const auto truth = compute_truth(reference, view, receivers, {});
        std::vector<std::size_t> pixels;
        for (std::size_t i = 0; i < receivers.pixel_count(); ++i) {
            if (scene::is_scored(truth.pixel_class[i])) {
                pixels.push_back(i);
            }
        }
        return pixels;
    }
    [[nodiscard]] RationalVec point(std::size_t pixel) const
    {
        const int width = view.image.width_px;
        return exact_point(scene::pixel_ray(view.camera, view.image,
                                            static_cast<int>(pixel) % width,
                                            static_cast<int>(pixel) / width),
                           triangles.corners(receivers[pixel]));
    }

    TriangleScene triangles;
    View view;
    ReferenceScene reference;
    Image<std::uint32_t> receivers;
    int resolution;
};

/// Triangles in the box [−2, 2]×[0, 2]×[−2, 2] above a ground of four: with corners anywhere, or on
/// a lattice of quarters, where edges and corners lie on the rays of an aligned texel grid.
inline TriangleScene random_sheets(unsigned seed, bool is_lattice)
{
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> place{-2, 2};
    const auto coordinate = [&] {
        const double x = place(random);
        return is_lattice ? 0.25 * std::round(4 * x) : x;
    };
    SceneBuilder builder;
    add_ground(builder, 4, 2, -0.5);
    for (int i = 0; i < 12; ++i) {
        std::vector<Vec3d> corners;
        for (int k = 0; k < 5; ++k) {
            corners.emplace_back(coordinate(), 0.5 * coordinate() + 1, coordinate());
        }
        builder.add("fan", corners,
                    std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {4, 0, 3}});
    }
    builder.add(
        "twin", std::vector<Vec3d>{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}},
        std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}, {0, 3, 2}, {0, 2, 1}, {0, 3, 2}});
    TriangleScene scene = builder.take();
    for (std::size_t i = 1; i < scene.objects.size(); ++i) {
        scene.objects[i].receives = i % 3 == 0;
        scene.objects[i].casts = i % 5 != 0;
    }
    return scene;
}

/// A light and its frustum, in words.
struct LightCase {
    const char* name;
    scene::LightSettings light;
    scene::FrustumSettings frustum;
};

inline scene::FrustumSettings fixed_frustum(double half_extent_m, double near_m, double far_m,
                                            bool reversed = false)
{
    scene::FrustumSettings frustum;
    frustum.fit = scene::Fit::fixed;
    frustum.half_extent_m = half_extent_m;
    frustum.fov_deg = 90;
    frustum.near_m = near_m;
    frustum.far_m = far_m;
    frustum.reversed = reversed;
    return frustum;
}

/// Upright and oblique, both types and depth directions; some planes cut through the scene.
inline std::vector<LightCase> light_cases()
{
    scene::LightSettings noon = directional({0, -1, 0});
    noon.position = Vec3d{0, 4, 0};
    scene::FrustumSettings fitted;
    fitted.roll_deg = 20;
    scene::FrustumSettings fitted_reversed = fitted;
    fitted_reversed.reversed = true;
    return {
        {"noon, aligned", noon, fixed_frustum(2, 1, 8)},
        {"noon, near plane through the scene", noon, fixed_frustum(2, 3, 4.5)},
        {"noon, reversed", noon, fixed_frustum(2, 3, 4.5, true)},
        {"oblique", directional({-0.4, -1, -0.3}), fitted},
        {"oblique, reversed", directional({-0.4, -1, -0.3}), fitted_reversed},
        {"spot above", spot({0, 4, 0}, {0, 0, 0}, 90), fixed_frustum(2, 1, 8)},
        {"spot above, reversed", spot({0, 4, 0}, {0, 0, 0}, 90), fixed_frustum(2, 3, 4.5, true)},
        {"oblique spot", spot({1, 3, 2}, {0, 0, 0}, 80), fitted}};
}

/// Runs `check` for every light over scenes at random and on a lattice.
template <typename Check>
void for_each_case(const Check& check)
{
    const unsigned seeds = tests::in_lane(2U, 40U);
    for (const LightCase& light : light_cases()) {
        for (unsigned seed = 1; seed <= seeds; ++seed) {
            const bool is_lattice = seed % 2 == 0;
            SCOPED_TRACE(testing::Message() << light.name << ", seed " << seed);
            check(LitScene{random_sheets(seed, is_lattice), light.light, light.frustum});
        }
    }
}

/// The exact depth of a tap.
inline Rational tap_depth(const LitScene& lit, const ExactTap& tap)
{
    if (tap.triangle == no_triangle) {
        return Rational{tap.depth};
    }
    const scene::Ray ray = lit.texel_ray(tap.texel);
    return *matrix_depth(lit.view.first_map(),
                         exact_point(ray, lit.triangles.corners(tap.triangle)));
}

} // namespace gnomon::reference_rt::test
