#include "light_fixture.hpp"
#include "reference_rt/light/critical_bias.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

/// The light's rays in scenes small enough to compute by hand: a sun at noon over x and z in [−2,
/// 2], ζ = 4 − y, near 1 and far 5, so that depth is (3 − y)/4; every number below is a short
/// binary fraction. Texels are 1 m wide: their centres are over odd multiples of 0.5 m, u towards
/// −x.
namespace gnomon::reference_rt::test {
namespace {

using Indices = std::vector<std::array<std::uint32_t, 3>>;

constexpr std::uint32_t table = 2;    ///< the table's triangle, after the ground's
constexpr Texel over_half_half{1, 2}; ///< its centre is over (0.5, 0.5)

TriangleScene built(const std::function<void(SceneBuilder&)>& build)
{
    SceneBuilder builder;
    build(builder);
    return builder.take();
}

struct Noon : LitScene {
    explicit Noon(const std::function<void(SceneBuilder&)>& build, bool reversed = false)
        : LitScene{built(build), light(), fixed_frustum(2, 1, 5, reversed), 4, {40, 40}}
    {
    }
    static scene::LightSettings light()
    {
        scene::LightSettings noon = directional({0, -1, 0});
        noon.position = Vec3d{0, 4, 0};
        return noon;
    }
    [[nodiscard]] TexelHit hit(Cull cull = Cull::none) const
    {
        return light_queries(cull)->first_hits({&over_half_half, 1},
                                               renderers::HitDetail::placed)[0];
    }
    [[nodiscard]] float bias(std::size_t pixel, const ExactTap& tap, bool clamps = false) const
    {
        const NearestQuery query{pixel, tap};
        return light_queries()->critical_biases(std::span{&query, 1}, {clamps})[0];
    }
    /// Pixels of the ground that lie under the table, seen through it.
    [[nodiscard]] std::vector<std::size_t> ground_below_the_table() const
    {
        std::vector<std::size_t> pixels;
        for (std::size_t i = 0; i < receivers.pixel_count(); ++i) {
            const RationalVec p = receivers[i] < table ? point(i) : RationalVec{Vec3d{-9, 0, 0}};
            if (p.x > Rational{0.25} && p.x < 1 && abs(p.z - Rational{0.5}) < Rational{0.125}) {
                pixels.push_back(i);
            }
        }
        return pixels;
    }
    /// A pixel that shows the triangle.
    [[nodiscard]] std::size_t pixel_of(std::uint32_t triangle) const
    {
        const auto found = std::find(receivers.begin(), receivers.end(), triangle);
        if (found == receivers.end()) {
            throw std::logic_error{"no pixel shows the triangle"};
        }
        return static_cast<std::size_t>(found - receivers.begin());
    }
};

/// A ground at y = 0, and a table at the given height over x and z in [0, 1].
std::function<void(SceneBuilder&)> table_at(double height)
{
    return [=](SceneBuilder& builder) {
        add_ground(builder, 2, 1);
        builder.add("table", std::vector<Vec3d>{{0, height, 0}, {0, height, 1}, {1.5, height, 0.5}},
                    Indices{{0, 1, 2}});
    };
}

TEST(TexelRays, StartOnTheNearPlaneOfADirectionalLight)
{
    for (const bool reversed : {false, true}) {
        const scene::Ray ray = Noon{table_at(1), reversed}.texel_ray({0, 3});
        EXPECT_EQ(ray.origin, Vec3d(1.5, 3, 1.5));
        EXPECT_EQ(ray.direction, Vec3d(0, -1, 0));
    }
}

TEST(TexelRays, StartAtASpot)
{
    const LitScene lit{built(table_at(1)), spot({0, 4, 0}, {0, 0, 0}, 90), fixed_frustum(2, 1, 8),
                       4};
    const scene::Ray ray = lit.texel_ray({0, 3});
    EXPECT_EQ(ray.origin, Vec3d(0, 4, 0));
    // 2^-22: the matrix has float32 tangents of half of 90°.
    EXPECT_NEAR(ray.direction.x / ray.direction.y, -0.75, 0x1p-22);
    EXPECT_NEAR(ray.direction.z / ray.direction.y, -0.75, 0x1p-22);
    EXPECT_LT(ray.direction.y, 0);
}

TEST(FirstHits, AreAtTheMatrixDepth)
{
    EXPECT_EQ(Noon{table_at(1)}.hit().triangle, table);
    EXPECT_EQ(Noon{table_at(1)}.hit().depth, 0.5);
    EXPECT_EQ(Noon(table_at(1), true).hit().depth, 0.5);
    EXPECT_EQ(Noon{table_at(2)}.hit().depth, 0.25);
    EXPECT_EQ(Noon(table_at(2), true).hit().depth, 0.75);
    EXPECT_EQ(Noon{table_at(2)}.hit().light_distance_m, 2);
}

TEST(FirstHits, BeginInTheNearPlane)
{
    for (const bool reversed : {false, true}) {
        EXPECT_EQ(Noon(table_at(3), reversed).hit().triangle, table);
        EXPECT_EQ(Noon(table_at(3), reversed).hit().depth, reversed ? 1 : 0);
        EXPECT_LT(Noon(table_at(3.0000005), reversed).hit().triangle, table);
        EXPECT_LT(Noon(table_at(3.5), reversed).hit().triangle, table) << "an occluder too near";
    }
}

TEST(FirstHits, EndInTheFarPlane)
{
    for (const bool reversed : {false, true}) {
        const auto ground_at = [&](double height) {
            return Noon([=](SceneBuilder& builder) { add_ground(builder, 2, 1, height); }, reversed)
                .hit();
        };
        EXPECT_EQ(ground_at(-1).depth, reversed ? 0 : 1);
        EXPECT_NE(ground_at(-1).triangle, no_triangle);
        EXPECT_EQ(ground_at(-1.0000002).triangle, no_triangle);
        EXPECT_EQ(ground_at(-1.0000002).depth, reversed ? 0 : 1);
    }
}

TEST(FirstHits, CullAsGlDoes)
{
    // The table's front, counter-clockwise, is up.
    EXPECT_EQ(Noon{table_at(1)}.hit(Cull::back).triangle, table);
    EXPECT_EQ(Noon{table_at(1)}.hit(Cull::front).triangle, no_triangle);
}

/// A ridge straight through the texel's centre; `apex_x` is where the second slope goes to.
std::function<void(SceneBuilder&)> ridge(double apex_x, bool is_turned = false)
{
    return [=](SceneBuilder& builder) {
        add_ground(builder, 2, 1);
        const std::vector<Vec3d> corners{
            {0.5, 1, 0}, {0.5, 1, 1}, {apex_x, 0.5, 0.5}, {0, 0.5, 0.5}};
        builder.add(
            "ridge", corners,
            Indices{{0, 1, 2}, is_turned ? std::array{0U, 1U, 3U} : std::array{1U, 0U, 3U}});
    };
}

TEST(FirstHits, PassNoSeam)
{
    const Noon noon{ridge(1)};
    EXPECT_EQ(noon.hit().triangle, 2);
    EXPECT_EQ(noon.hit().depth, 0.5);
    EXPECT_EQ(noon.hit(Cull::back).triangle, 2);
}

TEST(FirstHits, PassASilhouette)
{
    EXPECT_LT(Noon{ridge(0.25)}.hit().triangle, 2) << "both slopes on one side: a fold";
}

TEST(FirstHits, PassASeamOfWhichOneHalfIsCulled)
{
    const Noon noon{ridge(1, true)};
    EXPECT_EQ(noon.hit().triangle, 2);
    EXPECT_NE(noon.hit(Cull::back).triangle, 2);
    EXPECT_EQ(noon.hit(Cull::front).triangle, no_triangle);
}

TEST(FirstHits, PassAVertex)
{
    const Noon noon{[](SceneBuilder& builder) {
        add_ground(builder, 2, 1);
        builder.add("tip", std::vector<Vec3d>{{0.5, 1, 0.5}, {1, 1, 1}, {1, 1, 0}},
                    Indices{{0, 1, 2}});
    }};
    EXPECT_LT(noon.hit().triangle, 2);
}

TEST(FirstHits, PreferTheLowestOfSeveralAtOneDepth)
{
    const Noon noon{[](SceneBuilder& builder) {
        add_ground(builder, 2, 1);
        const std::vector<Vec3d> corners{{0, 1, 0}, {0, 1, 1}, {1.5, 1, 0.5}, {1.5, 1.25, 0.5}};
        builder.add("tables", corners, Indices{{0, 1, 2}, {1, 2, 0}, {2, 0, 1}});
    }};
    EXPECT_EQ(noon.hit().triangle, 2);
}

TEST(CriticalBiases, AreTheDifferenceOfDepths)
{
    for (const bool reversed : {false, true}) {
        const Noon noon{table_at(1), reversed};
        const std::size_t ground = noon.pixel_of(0);
        EXPECT_EQ(noon.bias(ground, {over_half_half, table, 1}), 0.25F);
        EXPECT_EQ(noon.bias(ground, {{0, 0}, 0, 1}), 0.0F);
        EXPECT_EQ(noon.bias(noon.pixel_of(table), {over_half_half, 0, 1}), -0.25F);
        EXPECT_EQ(noon.bias(ground, {{0, 0}, no_triangle, reversed ? 0.0F : 1.0F}), -0.25F);
    }
}

TEST(CriticalBiases, AreRoundedUp)
{
    const Noon noon{table_at(1)};
    // 0.75 − 0.1f has more than 24 bits.
    const float bias = noon.bias(noon.pixel_of(0), {{0, 0}, no_triangle, 0.1F});
    EXPECT_GE(static_cast<double>(bias), 0.75 - static_cast<double>(0.1F));
    EXPECT_LT(static_cast<double>(std::nextafter(bias, 0.0F)), 0.75 - static_cast<double>(0.1F));
}

TEST(CriticalBiases, ClampTheReceiverAlone)
{
    const Noon deep{[](SceneBuilder& builder) { add_ground(builder, 2, 1, -2); }};
    EXPECT_EQ(deep.bias(deep.pixel_of(0), {{0, 0}, no_triangle, 1}), 0.25F);
    EXPECT_EQ(deep.bias(deep.pixel_of(0), {{0, 0}, no_triangle, 1}, true), 0.0F);
    const Noon high{[](SceneBuilder& builder) { add_ground(builder, 2, 1, 3.5); }};
    EXPECT_EQ(high.bias(high.pixel_of(0), {{0, 0}, no_triangle, 0}), -0.125F);
    EXPECT_EQ(high.bias(high.pixel_of(0), {{0, 0}, no_triangle, 0}, true), 0.0F);
}

TEST(CriticalBiases, AreOfTheNearestTapFarBeyondThem)
{
    const Noon noon{table_at(1)};
    LinearQuery query{noon.pixel_of(0), {}, {}};
    query.taps = {ExactTap{over_half_half, table, 1}, ExactTap{{0, 0}, 0, 1},
                  ExactTap{{0, 3}, no_triangle, 0.5F}, ExactTap{{0, 3}, no_triangle, 0.625F}};
    const std::array<float, 4> expected{0.25F, 0, 0.25F, 0.125F};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        query.first = {i % 2 == 0 ? 40 : -40, i < 2 ? 40 : -40};
        EXPECT_EQ(noon.light_queries()->critical_biases(std::span{&query, 1}, {})[0], expected[i])
            << "tap " << i;
    }
}

TEST(SmallestBiasFrom, SkipsSubnormalNumbers)
{
    constexpr float smallest = std::numeric_limits<float>::min();
    EXPECT_EQ(smallest_bias_from(0), 0.0F);
    EXPECT_EQ(smallest_bias_from(1e-300), smallest);
    EXPECT_EQ(smallest_bias_from(static_cast<double>(smallest)), smallest);
    EXPECT_EQ(smallest_bias_from(-1e-300), 0.0F);
    EXPECT_EQ(smallest_bias_from(-static_cast<double>(smallest)), -smallest);
    EXPECT_EQ(smallest_bias_from(0.25), 0.25F);
    EXPECT_EQ(smallest_bias_from(0.1), 0.1F) << "0.1F is above 0.1";
    EXPECT_EQ(smallest_bias_from(0.7), std::nextafter(0.7F, 1.0F)) << "0.7F is below 0.7";
    EXPECT_EQ(smallest_bias_from(1e39), std::numeric_limits<float>::infinity());
}

TEST(AreCrossed, CountWhatIsBetweenNearAndFar)
{
    for (const bool reversed : {false, true}) {
        for (const auto& [height, expected] : {std::pair{1.0, 1}, {3.0, 1}, {3.25, 0}, {-0.5, 0}}) {
            const Noon noon{table_at(height), reversed};
            const auto pixels = noon.ground_below_the_table();
            ASSERT_FALSE(pixels.empty());
            const auto crossed = noon.light_queries()->occluded(pixels, {});
            EXPECT_EQ(std::ranges::count(crossed, expected), std::ssize(pixels)) << height;
        }
    }
}

TEST(AreCrossed, LeaveOutWhatIsCulled)
{
    const Noon noon{table_at(1)};
    const auto pixels = noon.ground_below_the_table();
    const auto count = [&](Cull cull) {
        return std::ranges::count(noon.light_queries(cull)->occluded(pixels, {}), 1);
    };
    EXPECT_EQ(count(Cull::none), std::ssize(pixels));
    EXPECT_EQ(count(Cull::back), std::ssize(pixels));
    EXPECT_EQ(count(Cull::front), 0);
}

TEST(FindBlockers, MeasureTheGapAndBothDistances)
{
    const Noon noon{table_at(2.5)};
    const auto pixels = noon.ground_below_the_table();
    for (const renderers::BlockerHit& blocker :
         noon.light_queries()->find_blockers(pixels, scene::Cull::none)) {
        EXPECT_EQ(blocker.triangle, table);
        // 8 ulp: P has the roundings of the camera's ray.
        EXPECT_NEAR(blocker.gap_m, 2.5, 0x1p-49);
        EXPECT_NEAR(blocker.light_distance_m, 1.5, 0x1p-49);
        EXPECT_NEAR(blocker.receiver_light_distance_m, 4, 0x1p-49);
    }
}

TEST(LightQueries, RejectsWhatIsOutsideTheMapAndTheScene)
{
    const Noon noon{table_at(1)};
    const auto light = noon.light_queries();
    for (const Texel outside : {Texel{4, 0}, Texel{0, 4}, Texel{-1, 0}, Texel{0, -1}}) {
        EXPECT_THROW((void)light->first_hits({&outside, 1}, renderers::HitDetail::placed),
                     std::invalid_argument);
        EXPECT_THROW((void)noon.bias(noon.pixel_of(0), {outside, 0, 1}), std::invalid_argument);
    }
    EXPECT_THROW((void)noon.bias(noon.pixel_of(0), {{0, 0}, 3, 1}), std::invalid_argument);
    const std::size_t background = noon.pixel_of(no_triangle);
    const std::vector<std::size_t> beyond{noon.receivers.pixel_count()};
    EXPECT_THROW((void)noon.bias(background, {{0, 0}, 0, 1}), std::invalid_argument);
    EXPECT_THROW((void)light->occluded({&background, 1}, {}), std::invalid_argument);
    EXPECT_THROW((void)light->find_blockers(beyond, scene::Cull::none), std::invalid_argument);
}

TEST(LightQueries, RejectsAMapWithoutSizeAndASceneThatServesNoTruth)
{
    const Noon noon{table_at(1)};
    for (const int resolution : {0, -1, 16385}) {
        EXPECT_THROW((void)make_light_queries(noon.reference, noon.view, noon.receivers, resolution,
                                              Cull::none),
                     std::invalid_argument);
    }
    EXPECT_THROW((void)make_light_queries(noon.reference, noon.view, {}, 4, Cull::none),
                 std::invalid_argument);
    const ReferenceScene plain{noon.triangles, {0, false, true}};
    EXPECT_THROW((void)make_light_queries(plain, noon.view, noon.receivers, 4, Cull::none),
                 std::invalid_argument);
}

} // namespace
} // namespace gnomon::reference_rt::test
