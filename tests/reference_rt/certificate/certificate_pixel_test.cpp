#include "reference_rt/certificate/pixel.hpp"

#include "scene/light/light.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

/// One pixel whose ray runs down the z axis, onto (0, 0, 0) of the ground, under a light from
/// (1, 0, 1): what stands around (1, 0, 1) decides.
namespace gnomon::reference_rt::certificate {
namespace {

using scene::ClassReason;
using scene::Light;
using scene::LightType;
using scene::no_triangle;
using scene::PixelClass;
using scene::Projection;
using scene::Vec3d;
using testing::HasSubstr;
using testing::IsEmpty;

using Corners = std::array<Vec3d, 3>;
using Indices = std::array<std::uint32_t, 3>;
constexpr std::uint32_t ground = 0;

Light directional_from(const Vec3d& direction)
{
    Light light;
    light.direction = -direction;
    return light;
}
Light spot_at(const Vec3d& position, const Vec3d& axis, double cosine)
{
    return {LightType::spot, axis, position, cosine};
}

/// The ground, triangle 0, is below z = 0's plane through nothing else: (0, 0, 0) is inside it.
class OnePixel {
public:
    explicit OnePixel(const std::vector<Corners>& others,
                      const Light& light = directional_from({1, 0, 1}),
                      Projection projection = Projection::perspective)
    {
        scene::SceneBuilder builder;
        add(builder, "ground", {Vec3d{-4, -4, 0}, Vec3d{4, -4, 0}, Vec3d{0, 6, 0}});
        for (std::size_t i = 0; i < others.size(); ++i) {
            add(builder, "object " + std::to_string(i + 1), others[i]);
        }
        scene = builder.take();
        scene::CameraSettings camera;
        camera.eye = {0, 0, 4};
        camera.target = {0, 0, 0};
        camera.projection = projection;
        view.camera = scene::make_camera(camera);
        view.image = {1, 1};
        view.light = light;
    }

    [[nodiscard]] Finding decide(std::uint32_t receiver = ground) const
    {
        return BruteForce{scene, view}.decide(0, 0, receiver);
    }
    [[nodiscard]] PixelClass pixel_class(std::uint32_t receiver = ground) const
    {
        return decide(receiver).pixel_class;
    }
    [[nodiscard]] WitnessVerdict check(std::uint32_t witness, std::uint32_t receiver = ground) const
    {
        return BruteForce{scene, view}.check_witness(0, 0, receiver, witness);
    }

    scene::TriangleScene scene;
    scene::View view;

private:
    static void add(scene::SceneBuilder& builder, const std::string& name, const Corners& corners)
    {
        builder.add(name, corners, std::array<Indices, 1>{Indices{0, 1, 2}});
    }
};

const Corners crossing{Vec3d{0.5, -1, 1}, Vec3d{2, -1, 1}, Vec3d{1, 2, 1}};
const Corners left_of_edge{Vec3d{1, -1, 1}, Vec3d{1, 1, 1}, Vec3d{0.5, 0, 1}};
const Corners right_of_edge{Vec3d{1, 1, 1}, Vec3d{1, -1, 1}, Vec3d{2, 0, 1}};
const Corners folded_back{Vec3d{1, 1, 1}, Vec3d{1, -1, 1}, Vec3d{3, 0, 2}};
const Corners in_light_plane{Vec3d{1, 1, 1}, Vec3d{1, -1, 1}, Vec3d{2, 0, 2}};
const Corners at_corner{Vec3d{1, 0, 1}, Vec3d{2, -1, 1}, Vec3d{2, 1, 1}};
const Corners standing{Vec3d{1, 0, 0.5}, Vec3d{1, 0, 2}, Vec3d{2, 0, 1}};

TEST(BruteForce, FindsTheGroundLit)
{
    EXPECT_EQ(OnePixel{{}}.pixel_class(), PixelClass::lit);
    EXPECT_EQ(OnePixel({}, directional_from({1, 0, 1}), Projection::orthographic).pixel_class(),
              PixelClass::lit);
}

TEST(BruteForce, FindsACrossing)
{
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        const OnePixel pixel{{crossing}, directional_from({1, 0, 1}), projection};
        const Finding finding = pixel.decide();
        EXPECT_EQ(finding.pixel_class, PixelClass::blocked);
        EXPECT_EQ(finding.triangle, 1U);
        EXPECT_THAT(pixel.check(1).fault, IsEmpty());
        EXPECT_FALSE(pixel.check(1).is_seam);
    }
}

TEST(BruteForce, FindsASpotsCrossingOnlyUpToItsPosition)
{
    const Vec3d axis{-1, 0, -1};
    EXPECT_EQ(OnePixel({crossing}, spot_at({2, 0, 2}, axis, 0.5)).pixel_class(),
              PixelClass::blocked);
    EXPECT_EQ(OnePixel({crossing}, spot_at({0.75, 0, 0.75}, axis, 0.5)).pixel_class(),
              PixelClass::lit);
    EXPECT_EQ(OnePixel({crossing}, spot_at({1, 0, 1}, axis, 0.5)).pixel_class(), PixelClass::lit);
}

TEST(BruteForce, FindsASeamFromItsLowerTriangle)
{
    const OnePixel pixel{{left_of_edge, right_of_edge}};
    EXPECT_EQ(pixel.pixel_class(), PixelClass::blocked);
    EXPECT_TRUE(pixel.check(1).is_seam);
    EXPECT_THAT(pixel.check(1).fault, IsEmpty());
    EXPECT_THAT(pixel.check(2).fault, HasSubstr("upper triangle"));
}

TEST(BruteForce, FindsASilhouetteAtAFoldABoundaryAndInTheLightsPlane)
{
    const std::vector<std::vector<Corners>> scenes{
        {right_of_edge, folded_back}, {right_of_edge}, {left_of_edge, in_light_plane}};
    for (const auto& others : scenes) {
        const OnePixel pixel{others};
        const Finding finding = pixel.decide();
        EXPECT_EQ(finding.pixel_class, PixelClass::indeterminate);
        EXPECT_EQ(finding.reason, ClassReason::silhouette);
        EXPECT_THAT(finding.signs.edge, testing::Contains(0));
        EXPECT_THAT(pixel.check(1).fault, HasSubstr("does not block"));
    }
}

TEST(BruteForce, FindsAVertex)
{
    const Finding finding = OnePixel{{at_corner}}.decide();
    EXPECT_EQ(finding.pixel_class, PixelClass::indeterminate);
    EXPECT_EQ(finding.reason, ClassReason::vertex);
}

TEST(BruteForce, FindsAGrazeOnlyWhereTheSegmentMeetsTheTriangle)
{
    const Finding finding = OnePixel{{standing}}.decide();
    EXPECT_EQ(finding.pixel_class, PixelClass::indeterminate);
    EXPECT_EQ(finding.reason, ClassReason::graze);
    const Corners beside{Vec3d{3, 0, 0.5}, Vec3d{4, 0, 0.5}, Vec3d{4, 0, 1}};
    EXPECT_EQ(OnePixel{{beside}}.pixel_class(), PixelClass::lit);
    const Corners at_p_only{Vec3d{0, 0, 0}, Vec3d{1, 0, -1}, Vec3d{-1, 0, -2}};
    EXPECT_EQ(OnePixel{{at_p_only}}.pixel_class(), PixelClass::lit);
}

TEST(BruteForce, LetsACrossingPrevailOverDegenerateContacts)
{
    const Corners higher{Vec3d{1, -1, 2}, Vec3d{3, -1, 2}, Vec3d{2, 2, 2}};
    const Finding finding = OnePixel{{standing, at_corner, higher}}.decide();
    EXPECT_EQ(finding.pixel_class, PixelClass::blocked);
    EXPECT_EQ(finding.triangle, 3U);
    EXPECT_EQ(OnePixel({standing, at_corner}).decide().reason, ClassReason::vertex);
}

TEST(BruteForce, FindsAttachedBehindAndExactlyInThePlane)
{
    EXPECT_EQ(OnePixel({crossing}, directional_from({1, 0, -1})).pixel_class(),
              PixelClass::attached);
    EXPECT_EQ(OnePixel({crossing}, directional_from({1, 0, 0})).pixel_class(),
              PixelClass::attached);
    EXPECT_EQ(OnePixel({}, directional_from({1, 0, 0x1p-100})).pixel_class(), PixelClass::lit);
    const Vec3d axis{-1, 0, 0};
    EXPECT_EQ(OnePixel({}, spot_at({3, 0, 0}, axis, 0.5)).pixel_class(), PixelClass::attached);
}

TEST(BruteForce, FindsTheConesBoundaryInside)
{
    // P − L = (−1, 0, −1) is 60° from the axis, and cos 60° is a double.
    const Vec3d axis{-1, -1, 0};
    EXPECT_EQ(OnePixel({}, spot_at({1, 0, 1}, axis, 0.5)).pixel_class(), PixelClass::lit);
    const double narrower = std::nextafter(0.5, 1.0);
    const OnePixel outside{{crossing}, spot_at({2, 0, 2}, axis, narrower)};
    EXPECT_EQ(outside.pixel_class(), PixelClass::out_of_light);
    EXPECT_THAT(outside.check(1).fault, HasSubstr("receives no light"));
}

TEST(BruteForce, LeavesOutWhatCastsNoShadow)
{
    OnePixel pixel{{crossing}};
    pixel.scene.objects[1].casts = false;
    EXPECT_EQ(pixel.pixel_class(), PixelClass::lit);
    EXPECT_THAT(pixel.check(1).fault, HasSubstr("casts no shadow"));
    OnePixel seam{{left_of_edge, right_of_edge}};
    seam.scene.objects[2].casts = false;
    EXPECT_EQ(seam.decide().reason, ClassReason::silhouette);
}

TEST(BruteForce, LeavesOutWhatTheCameraDoesNotSee)
{
    const Corners cover{Vec3d{-1, -1, 2}, Vec3d{0.5, -1, 2}, Vec3d{0, 1, 2}};
    OnePixel pixel{{cover}};
    EXPECT_EQ(pixel.pixel_class(), PixelClass::unmatched);
    EXPECT_EQ(pixel.decide().triangle, 1U);
    EXPECT_EQ(pixel.pixel_class(1), PixelClass::lit);
    pixel.scene.objects[1].receives = false;
    EXPECT_EQ(pixel.pixel_class(), PixelClass::lit);
    EXPECT_EQ(pixel.pixel_class(1), PixelClass::unmatched);
}

TEST(BruteForce, MatchesEveryTriangleOfATiedFirstHit)
{
    // Both have the edge x = 0 above the ground.
    const Corners left{Vec3d{0, -1, 2}, Vec3d{0, 1, 2}, Vec3d{-1, 0, 2}};
    const Corners right{Vec3d{0, 1, 2}, Vec3d{0, -1, 2}, Vec3d{1, 0, 2}};
    const OnePixel pixel{{left, right}};
    EXPECT_EQ(pixel.pixel_class(1), PixelClass::lit);
    EXPECT_EQ(pixel.pixel_class(2), PixelClass::lit);
    EXPECT_EQ(pixel.pixel_class(0), PixelClass::unmatched);
}

TEST(BruteForce, SeesOnlyBeyondTheNearPlane)
{
    // The diagonal is 14 m, so that the near plane is 1.4e-5 m before the eye.
    const auto cover = [](double z) {
        return Corners{Vec3d{-1, -1, z}, Vec3d{0.5, -1, z}, Vec3d{0, 1, z}};
    };
    EXPECT_EQ(OnePixel{{cover(4 - 0x1p-18)}}.pixel_class(), PixelClass::lit);
    EXPECT_EQ(OnePixel{{cover(4 - 0x1p-12)}}.pixel_class(), PixelClass::unmatched);
}

TEST(BruteForce, TellsBackgroundFromUnmatched)
{
    OnePixel pixel{{}};
    EXPECT_EQ(pixel.pixel_class(no_triangle), PixelClass::unmatched);
    pixel.scene.objects[0].receives = false;
    EXPECT_EQ(pixel.pixel_class(no_triangle), PixelClass::background);
    EXPECT_EQ(pixel.pixel_class(0), PixelClass::unmatched);
    EXPECT_EQ(pixel.pixel_class(77), PixelClass::unmatched); // no such triangle
}

TEST(BruteForce, RefusesWitnessesThatAreNone)
{
    const OnePixel pixel{{crossing, at_corner}};
    EXPECT_THAT(pixel.check(2).fault, HasSubstr("does not block (signs: edges "));
    EXPECT_THAT(pixel.check(0).fault, HasSubstr("the receiver itself"));
    EXPECT_THAT(pixel.check(no_triangle).fault, HasSubstr("none of the scene's 3"));
    EXPECT_THAT(pixel.check(1, no_triangle).fault, HasSubstr("none of the scene's 3"));
    const OnePixel edge_on{{crossing, standing}};
    EXPECT_THAT(edge_on.check(1, 2).fault, HasSubstr("does not meet the plane of triangle 2"));
}

TEST(Explain, NamesTriangleAndSigns)
{
    EXPECT_THAT(explain(OnePixel{{crossing}}.decide()),
                testing::MatchesRegex("triangle 1 crosses the segment to the light \\(signs: edges "
                                      "(\\+\\+\\+|---), P (\\+, light -|-, light \\+)\\)"));
    EXPECT_THAT(explain(OnePixel{{at_corner}}.decide()),
                HasSubstr("triangle 1 is met exactly at a corner (signs: edges "));
    EXPECT_EQ(explain(OnePixel{{}}.decide()), "nothing meets the segment to the light");
}

/// Random triangles and segments between lattice points, so that many only just meet.
TEST(TriangleBoxes, RejectNothingThatIsMet)
{
    std::mt19937_64 random{11};
    for (int round = 0; round < 40; ++round) {
        // From round to round the scene is farther from the origin, down to a few ulp in size.
        const double shift = round % 2 == 0 ? 0 : std::ldexp(1.0, round / 2);
        const auto draw = [&] {
            return shift + 0.25 * std::uniform_int_distribution{-8, 8}(random);
        };
        const auto point = [&] {
            const double x = draw();
            const double y = draw();
            return Vec3d{x, y, draw()};
        };
        scene::SceneBuilder builder;
        for (int i = 0; i < 100; ++i) {
            builder.add("t", Corners{point(), point(), point()},
                        std::array<Indices, 1>{Indices{0, 1, 2}});
        }
        const scene::TriangleScene scene = builder.take();
        const TriangleBoxes boxes{scene, scene::casting_ranges(scene)};
        for (int i = 0; i < 20; ++i) {
            const Vec3d from = point();
            const Vec3d to = point();
            // A third is the start of many a P: no double holds it.
            const Point p{Rational{3.0} * Vector{from} + Vector{Vec3d{1, 0, 1}}, Rational{3.0}};
            const Point light =
                i % 2 == 0 ? Point{Vector{to}} : Point{Vector{to - from}, Rational{}};
            const auto kept = boxes.candidates(p, light);
            for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
                const Triangle corners = exact_triangle(scene.corners(t));
                const ContactKind kind = contact_kind(contact_signs(p, light, corners));
                const bool is_met = kind == ContactKind::in_plane
                                        ? meets_in_plane(p, light, corners)
                                        : kind != ContactKind::none;
                ASSERT_TRUE(!is_met || std::ranges::binary_search(kept, t))
                    << "round " << round << ", segment " << i << ", triangle " << t;
            }
        }
    }
}

TEST(TriangleBoxes, RejectWhatTheSegmentPassesBy)
{
    const OnePixel pixel{{crossing}};
    const TriangleBoxes boxes{pixel.scene, scene::casting_ranges(pixel.scene)};
    const auto candidates = [&](const Vec3d& from, const Vec3d& to) {
        return boxes.candidates(Point{Vector{from}}, Point{Vector{to}});
    };
    EXPECT_THAT(candidates({0, 0, 0.5}, {2, 0, 1.5}), testing::ElementsAre(1));
    EXPECT_THAT(candidates({0, 0, 0.5}, {0, 0, 3}), IsEmpty()); // outside the boxes' slabs
    // The segment's own box meets that of triangle 1, the segment does not.
    EXPECT_THAT(candidates({-3, 0, 0.5}, {1, 0, 4}), IsEmpty());
}

} // namespace
} // namespace gnomon::reference_rt::certificate
