#include "light_fixture.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace gnomon::reference_rt::test {
namespace {

using renderers::HitDetail;
using scene::no_triangle;

/// Every triangle that casts but one.
TriangleScene without_triangle(const TriangleScene& all, std::uint32_t left_out)
{
    SceneBuilder builder;
    const std::array<std::array<std::uint32_t, 3>, 1> face{{{0, 1, 2}}};
    for (std::uint32_t t = 0; t < all.triangles.size(); ++t) {
        if (t != left_out && all.objects[all.object_of(t)].casts) {
            const auto corners = all.corners(t);
            const std::array<Vec3d, 3> points{Vec3d{corners[0]}, Vec3d{corners[1]},
                                              Vec3d{corners[2]}};
            builder.add(std::to_string(t), points, face);
        }
    }
    return builder.take();
}

/// The second hit is the first of the scene without the first hit's triangle, but where another
/// triangle is hit at the very same depth.
TEST(SecondDepths, AreTheFirstWithoutTheTriangleInFront)
{
    std::size_t tried = 0;
    std::size_t behind_nothing = 0;
    for (const LightCase& light : light_cases()) {
        for (const bool is_lattice : {false, true}) {
            SCOPED_TRACE(testing::Message() << light.name << ", lattice " << is_lattice);
            const LitScene lit{random_sheets(7, is_lattice), light.light, light.frustum};
            const auto texels = lit.all_texels();
            const auto exact = lit.light_queries();
            const auto hits = exact->first_hits(texels, HitDetail::bounded);
            const auto first = exact->texel_depths(texels, scene::texel_centre);
            const auto second = exact->second_depths(texels);
            const float farthest = lit.view.first_map().reversed ? 0.0F : 1.0F;
            std::map<std::uint32_t, std::vector<std::size_t>> by_triangle;
            for (std::size_t i = 0; i < texels.size(); ++i) {
                by_triangle[hits[i].triangle].push_back(i);
            }
            for (const auto& [triangle, places] : by_triangle) {
                if (triangle == no_triangle) {
                    for (const std::size_t i : places) {
                        EXPECT_EQ(second[i], farthest);
                    }
                    continue;
                }
                LitScene rest{without_triangle(lit.triangles, triangle), light.light,
                              light.frustum};
                rest.view.maps = lit.view.maps; // a fitted frustum's are those of all triangles
                const auto expected =
                    rest.light_queries()->texel_depths(texels, scene::texel_centre);
                for (const std::size_t i : places) {
                    if (expected[i] != first[i]) {
                        EXPECT_EQ(second[i], expected[i])
                            << "texel " << texels[i].x << ' ' << texels[i].y;
                        ++tried;
                        behind_nothing += second[i] == farthest ? 1U : 0U;
                    }
                }
            }
        }
    }
    EXPECT_GT(tried, 1000U);
    EXPECT_GT(behind_nothing, 50U);
    EXPECT_LT(behind_nothing, tried - 200);
}

/// Two squares in one plane are one surface, and a seam between two triangles is hit once.
TEST(SecondDepths, CountWhatLiesAtOneDepthOnce)
{
    SceneBuilder builder;
    add_ground(builder, 2, 2, 1);
    add_ground(builder, 2, 2, 1);
    add_ground(builder, 2, 2, 0);
    scene::LightSettings noon = directional({0, -1, 0});
    noon.position = Vec3d{0, 4, 0};
    const LitScene lit{builder.take(), noon, fixed_frustum(1, 1, 5)};
    const auto texels = lit.all_texels();
    for (const float depth : lit.light_queries()->second_depths(texels)) {
        EXPECT_EQ(depth, 0.75F); // 3 m of 4 behind the near plane
    }
}

} // namespace
} // namespace gnomon::reference_rt::test
