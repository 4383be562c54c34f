#include "lane.hpp"
#include "light_fixture.hpp"
#include "self_shadowing_oracle.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace gnomon::reference_rt::test {
namespace {

using Indices = std::vector<std::array<std::uint32_t, 3>>;

/// A point of the plane that the sun at noon and the camera look down upon.
struct Spot {
    double x = 0;
    double z = 0;
};

/// A scene under a sun at noon whose 8×8 texels are 0.5 m wide, u towards −x and v towards z, so
/// that their centres are over odd multiples of 0.25 m. The camera looks straight down.
struct NoonFromAbove : LitScene {
    explicit NoonFromAbove(SceneBuilder& builder)
        : LitScene{builder.take(), light(), fixed_frustum(2, 1, 8), 8, {32, 32}}
    {
        scene::CameraSettings camera;
        camera.eye = {0.0625, 9, 0.0625};
        camera.target = {0.0625, 0, 0.0625};
        camera.up = {0, 0, -1};
        camera.projection = scene::Projection::orthographic;
        camera.orthographic_height_m = 4; // pixel centres are exactly at multiples of 1/8 m
        view.camera = scene::make_camera(camera);
    }
    static scene::LightSettings light()
    {
        scene::LightSettings noon = directional({0, -1, 0});
        noon.position = Vec3d{0, 4, 0};
        return noon;
    }
    static Texel texel_over(Spot centre)
    {
        return {static_cast<int>(std::lround((1.75 - centre.x) / 0.5)),
                static_cast<int>(std::lround((1.75 + centre.z) / 0.5))};
    }
    /// Whether the surface of `receiver` at a multiple of 0.125 m leads to `seen` at the texel.
    bool leads(Spot from, std::uint32_t receiver, Spot texel_centre, std::uint32_t seen)
    {
        const auto column = static_cast<std::size_t>(15 + std::lround(8 * from.x));
        const auto row = static_cast<std::size_t>(15 + std::lround(8 * from.z));
        const std::size_t pixel = row * 32 + column;
        receivers[pixel] = receiver;
        const std::vector<SelfShadowingQuery> queries{{pixel, texel_over(texel_centre), seen}};
        return light_queries()->are_self_shadowing(queries)[0] == 1;
    }
};

TEST(SelfShadowingSurface, LeadsAcrossThePlaneOfTwoTriangles)
{
    SceneBuilder builder;
    add_ground(builder, 3, 1);
    NoonFromAbove noon{builder};
    EXPECT_TRUE(noon.leads({-1, 0.5}, 0, {-1.25, 0.75}, 0));
    EXPECT_TRUE(noon.leads({-1, 0.5}, 0, {1.25, -1.25}, 1));
    EXPECT_TRUE(noon.leads({1, -0.5}, 1, {-1.25, 1.25}, 0));
}

TEST(SelfShadowingSurface, LeadsAcrossManyTriangles)
{
    SceneBuilder builder;
    add_ground(builder, 3, 25);
    NoonFromAbove noon{builder};
    noon.receivers = brute_force_receivers(noon.triangles, noon.view);
    const auto texels = noon.all_texels();
    const auto hits = noon.light_queries()->first_hits(texels, HitDetail::placed);
    std::vector<SelfShadowingQuery> queries;
    for (std::size_t pixel = 0; pixel < noon.receivers.pixel_count(); pixel += 7) {
        for (std::size_t i = 0; i < texels.size(); ++i) {
            queries.push_back({pixel, texels[i], hits[i].triangle});
        }
    }
    const auto answers = noon.light_queries()->are_self_shadowing(queries);
    EXPECT_EQ(std::ranges::count(answers, 0), 0);
}

TEST(SelfShadowingSurface, DoesNotLeadBeyondTheTexel)
{
    SceneBuilder builder;
    builder.add("strip",
                std::vector<Vec3d>{{-2, 0, -1}, {-2, 0, 1}, {-0.5, 0, 1}, {0.5, 0, -1}, {2, 0, 1}},
                Indices{{0, 1, 2}, {0, 2, 3}, {3, 2, 4}});
    NoonFromAbove noon{builder};
    EXPECT_TRUE(noon.leads({-1.75, 0.125}, 0, {-0.25, 0.25}, 1));
    EXPECT_FALSE(noon.leads({-1.75, 0.125}, 0, {-0.25, 0.25}, 2));
    EXPECT_TRUE(noon.leads({-1.75, 0.125}, 0, {0.75, 0.25}, 2));
}

TEST(SelfShadowingSurface, EndsAtAFold)
{
    // The upper leaf lies over the lower one; both hang on the edge x = 1.
    SceneBuilder builder;
    builder.add("leaves", std::vector<Vec3d>{{1, 0, -2}, {1, 0, 2}, {-2, -0.5, 0}, {-2, 0.5, 0}},
                Indices{{0, 2, 1}, {0, 3, 1}});
    NoonFromAbove noon{builder};
    EXPECT_FALSE(noon.leads({0.5, 0}, 0, {0.75, -0.25}, 1));
    EXPECT_FALSE(noon.leads({0.5, 0}, 0, {1.75, -0.25}, 1)); // towards the edge and beyond
}

TEST(SelfShadowingSurface, DoesNotLeadToAnother)
{
    SceneBuilder builder;
    add_ground(builder, 3, 1);
    add_ground(builder, 1, 1, 1, "table");
    NoonFromAbove noon{builder};
    EXPECT_FALSE(noon.leads({1.25, 0.5}, 1, {0.75, -0.25}, 3));
    EXPECT_TRUE(noon.leads({0.5, 0.25}, 3, {-0.75, 0.25}, 2) &&
                noon.leads({-0.5, 0.25}, 2, {-0.25, -0.75}, 2));
}

TEST(SelfShadowingSurface, EndsAtABoundaryEvenIfItGoesOnBehind)
{
    // An L of two squares: the straight way between its ends leaves it.
    SceneBuilder builder;
    builder.add(
        "L",
        std::vector<Vec3d>{{-2, 0, -2}, {-1, 0, -2}, {-1, 0, 1}, {-2, 0, 2}, {2, 0, 1}, {2, 0, 2}},
        Indices{{0, 2, 1}, {0, 3, 2}, {3, 4, 2}, {3, 5, 4}});
    NoonFromAbove noon{builder};
    EXPECT_FALSE(noon.leads({-1.25, -1.5}, 0, {1.75, 1.25}, 2));
    EXPECT_TRUE(noon.leads({-1.75, 0.875}, 1, {0.25, 1.75}, 3)) << "this way stays inside";
}

TEST(SelfShadowingSurface, DoesNotJoinAtATJunction)
{
    // One triangle's long edge on x = 0 meets two short ones.
    SceneBuilder builder;
    builder.add("junction",
                std::vector<Vec3d>{{0, 0, -2}, {0, 0, 2}, {-2, 0, 0}, {0, 0, 0}, {2, 0, 0}},
                Indices{{0, 2, 1}, {0, 3, 4}, {3, 1, 4}});
    NoonFromAbove noon{builder};
    EXPECT_FALSE(noon.leads({-0.5, 0.5}, 0, {0.25, 0.25}, 2));
    EXPECT_TRUE(noon.leads({0.5, -0.25}, 1, {0.25, 0.25}, 2));
}

TEST(SelfShadowingSurface, LeadsThroughACorner)
{
    // Four triangles around the origin; the way from (−0.25, −0.25) to (0.25, 0.25) runs through
    // it.
    SceneBuilder builder;
    builder.add("fan", std::vector<Vec3d>{{0, 0, 0}, {-2, 0, 0}, {0, 0, 2}, {2, 0, 0}, {0, 0, -2}},
                Indices{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
    NoonFromAbove noon{builder};
    EXPECT_TRUE(noon.leads({-0.25, -0.25}, 3, {0.25, 0.25}, 1));
}

TEST(SelfShadowingSurface, LeadsFromACorner)
{
    SceneBuilder builder;
    builder.add("fan", std::vector<Vec3d>{{0, 0, 0}, {-2, 0, 0}, {0, 0, 2}, {2, 0, 0}, {0, 0, -2}},
                Indices{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
    NoonFromAbove noon{builder};
    EXPECT_TRUE(noon.leads({0, 0}, 3, {0.25, 0.25}, 1));
}

TEST(SelfShadowingSurface, LeadsAcrossAnEdgeThatTheWayRunsAlong)
{
    SceneBuilder builder;
    add_ground(builder, 2, 1); // the diagonal x = z
    NoonFromAbove noon{builder};
    EXPECT_TRUE(noon.leads({-1, -1}, 1, {0.25, 0.25}, 0));
    EXPECT_TRUE(noon.leads({0.25, 0.25}, 1, {0.25, 0.25}, 0)) << "P is on the texel's ray";
}

TEST(SelfShadowingSurface, LeadsAroundACornerOnlyWhereThereIsSurface)
{
    const std::vector<Vec3d> corners{{0, 0, 0}, {-2, 0, 0}, {0, 0, 2}, {2, 0, 0}, {0, 0, -2}};
    SceneBuilder one_way;
    one_way.add("fan", corners, Indices{{0, 1, 2}, {0, 2, 3}, {0, 4, 1}});
    EXPECT_TRUE(NoonFromAbove{one_way}.leads({-0.25, -0.25}, 2, {0.25, 0.25}, 1));
    SceneBuilder no_way;
    no_way.add("fan", corners, Indices{{0, 2, 3}, {0, 4, 1}});
    EXPECT_FALSE(NoonFromAbove{no_way}.leads({-0.25, -0.25}, 1, {0.25, 0.25}, 0));
}

TEST(SelfShadowingSurface, LeadsThroughANonManifoldEdgeToEveryContinuation)
{
    SceneBuilder builder;
    builder.add("book", std::vector<Vec3d>{{0, 0, -2}, {0, 0, 2}, {-2, 0, 0}, {2, 0, 0}, {2, 1, 0}},
                Indices{{0, 2, 1}, {0, 1, 3}, {0, 1, 4}});
    NoonFromAbove noon{builder};
    EXPECT_TRUE(noon.leads({-0.5, 0.125}, 0, {0.25, -0.25}, 1));
    EXPECT_TRUE(noon.leads({-0.5, 0.125}, 0, {0.25, -0.25}, 2));
    EXPECT_FALSE(noon.leads({0.5, 0.125}, 1, {0.25, -0.25}, 2))
        << "two pages on one side are a fold";
}

TEST(SelfShadowingSurface, DoesNotTurnBackAtANonManifoldEdgeUnderTheTexel)
{
    // Two pages to the left of the spine x = 0.25, one to the right; the texel's centre is on it.
    SceneBuilder builder;
    builder.add("book",
                std::vector<Vec3d>{{0.25, 0, -2}, {0.25, 0, 2}, {-2, 1, 0}, {-2, 0, 0}, {2, 0, 0}},
                Indices{{0, 2, 1}, {0, 3, 1}, {0, 1, 4}});
    NoonFromAbove noon{builder};
    EXPECT_TRUE(noon.leads({-0.5, 0.125}, 1, {0.25, 0.25}, 2));
    EXPECT_FALSE(noon.leads({-0.5, 0.125}, 1, {0.25, 0.25}, 0));
}

TEST(SelfShadowingSurface, JoinsPositionsWhateverTheirIndicesAndObjects)
{
    SceneBuilder builder;
    builder.add("left", std::vector<Vec3d>{{0, 0, -2}, {0, 0, 2}, {-2, 0, 0}}, Indices{{0, 2, 1}});
    builder.add("right", std::vector<Vec3d>{{2, 0, 0}, {0, 0, 2}, {0, 0, -2}}, Indices{{0, 2, 1}});
    NoonFromAbove noon{builder};
    EXPECT_TRUE(noon.leads({-0.5, 0.125}, 0, {0.25, -0.25}, 1));
}

/// A crumpled sheet that folds over itself, a ground below, and a fin that makes an edge shared by
/// three.
TriangleScene crumpled_sheet(unsigned seed, bool is_lattice)
{
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> shift{-0.6, 0.6};
    constexpr int n = 6;
    std::vector<Vec3d> vertices;
    for (int i = 0; i <= n; ++i) {
        for (int k = 0; k <= n; ++k) {
            const auto jitter = [&] {
                const double x = shift(random);
                return is_lattice ? 0.25 * std::round(2 * x) : x;
            };
            vertices.emplace_back(0.75 * i - 2.25 + jitter(), 0.5 + jitter(),
                                  0.75 * k - 2.25 + jitter());
        }
    }
    Indices triangles;
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t first = i * (n + 1) + k;
            triangles.push_back({first, first + 1, first + n + 2});
            triangles.push_back({first, first + n + 2, first + n + 1});
        }
    }
    triangles.push_back({24, 25, 10});
    SceneBuilder builder;
    builder.add("sheet", vertices, triangles);
    add_ground(builder, 3, 2, -0.5);
    return builder.take();
}

TEST(SelfShadowingSurface, IsThatOfPlaneGeometryInRationals)
{
    int own = 0;
    int other = 0;
    for (const LightCase& light : light_cases()) {
        for (const unsigned seed : {11U, 12U}) {
            SCOPED_TRACE(testing::Message() << light.name << ", seed " << seed);
            const LitScene lit{crumpled_sheet(seed, seed % 2 == 0), light.light, light.frustum, 8};
            const auto exact = lit.light_queries();
            const auto texels = lit.all_texels();
            const auto hits = exact->first_hits(texels, HitDetail::placed);
            const auto pixels = lit.scored_pixels();
            std::mt19937 random{seed};
            std::vector<SelfShadowingQuery> queries;
            while (queries.size() < tests::in_lane(50U, 150U)) {
                const std::size_t i = random() % texels.size();
                if (hits[i].triangle != no_triangle) {
                    queries.push_back(
                        {pixels[random() % pixels.size()], texels[i], hits[i].triangle});
                }
            }
            const auto answers = exact->are_self_shadowing(queries);
            for (std::size_t i = 0; i < queries.size(); ++i) {
                const auto& [pixel, texel, seen] = queries[i];
                const LightView view{lit.texel_ray(texel),
                                     lit.view.light.type == scene::LightType::spot};
                const SheetOracle oracle{lit.triangles, view, lit.point(pixel), {}};
                const bool expected = oracle.leads(lit.receivers[pixel], seen);
                EXPECT_EQ(answers[i] == 1, expected)
                    << "pixel " << pixel << ", texel " << texel.x << ' ' << texel.y;
                (expected ? own : other) += lit.receivers[pixel] != seen ? 1 : 0;
            }
        }
    }
    EXPECT_GT(own, tests::in_lane(33, 100));
    EXPECT_GT(other, tests::in_lane(33, 100));
}

TEST(SelfShadowingSurface, RejectsWhatIsNotInTheScene)
{
    SceneBuilder builder;
    add_ground(builder, 3, 1);
    NoonFromAbove noon{builder};
    noon.receivers[0] = 0;
    const auto light = noon.light_queries();
    for (const SelfShadowingQuery& query :
         {SelfShadowingQuery{0, {0, 8}, 0}, SelfShadowingQuery{0, {-1, 0}, 0},
          SelfShadowingQuery{0, {0, 0}, 2}, SelfShadowingQuery{32 * 32, {0, 0}, 0}}) {
        EXPECT_THROW((void)light->are_self_shadowing({&query, 1}), std::invalid_argument);
    }
}

} // namespace
} // namespace gnomon::reference_rt::test
