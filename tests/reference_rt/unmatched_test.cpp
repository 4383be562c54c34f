#include "scene_fixture.hpp"

#include "reference_rt/truth.hpp"

#include <gtest/gtest.h>

/// Pixels in which GL's triangle, made up here, is not the ray's first hit.
namespace gnomon::reference_rt::test {
namespace {

using scene::ClassReason;

constexpr ImageSize small_image{64, 48};

/// Two triangles that share the diagonal of a square, 4 m from the camera, and a sheet `gap_m`
/// behind.
TriangleScene square_and_sheet(double gap_m)
{
    SceneBuilder builder;
    builder.add("square", std::vector<Vec3d>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
    builder.add("sheet", std::vector<Vec3d>{{-1, -1, -gap_m}, {1, -1, -gap_m}, {1, 1, -gap_m}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    return builder.take();
}

View front_view()
{
    return make_view({0, 0, 4}, {0, 0, 0}, small_image, directional({0.1, 0.2, -1}));
}

struct Reclassified {
    PixelClass pixel_class;
    ClassReason reason;
};

/// The class of one pixel when GL claims to see `triangle` there.
Reclassified class_when_seeing(const TriangleScene& scene, const View& view, int x, int y,
                               std::uint32_t triangle)
{
    auto receivers = brute_force_receivers(scene, view);
    receivers(x, y) = triangle;
    const auto truth = compute_truth(ReferenceScene{scene}, view, receivers, {});
    return {truth.pixel_class(x, y), truth.reason(x, y)};
}

void expect_unmatched(const Reclassified& pixel, ClassReason reason)
{
    EXPECT_EQ(pixel.pixel_class, PixelClass::unmatched);
    EXPECT_EQ(pixel.reason, reason);
}

TEST(Unmatched, AcceptsBothFirstHitsOfASharedEdge)
{
    // In a square image, whose sx and sy have the same bits, the centres of (32 + k, 31 − k)
    // lie on the diagonal exactly.
    const TriangleScene scene = square_and_sheet(1);
    View view = front_view();
    view.image = {64, 64};
    for (const std::uint32_t triangle : {0U, 1U}) {
        const auto pixel = class_when_seeing(scene, view, 34, 29, triangle);
        EXPECT_TRUE(scene::is_scored(pixel.pixel_class)) << "triangle " << triangle;
        EXPECT_EQ(pixel.reason, ClassReason::none);
    }
}

TEST(Unmatched, IsAMismatchFarFromEveryEdge)
{
    const TriangleScene scene = square_and_sheet(1);
    // The neighbour does not cover the pixel; nothing at all was drawn; the sheet is far behind.
    expect_unmatched(class_when_seeing(scene, front_view(), 36, 30, 1), ClassReason::mismatch);
    expect_unmatched(class_when_seeing(scene, front_view(), 36, 30, no_triangle),
                     ClassReason::mismatch);
    expect_unmatched(class_when_seeing(scene, front_view(), 36, 30, 2), ClassReason::mismatch);
    // GL sees a triangle that no ray meets.
    expect_unmatched(class_when_seeing(scene, front_view(), 1, 1, 0), ClassReason::mismatch);
}

TEST(Unmatched, IsATieWithinTheDepthBuffersResolution)
{
    // 4e-7 m at 4 m are 1e-7 of the depth, one ulp of float32 there; the bound allows a few.
    const TriangleScene scene = square_and_sheet(4e-7);
    expect_unmatched(class_when_seeing(scene, front_view(), 36, 30, 2), ClassReason::tie);
}

TEST(Unmatched, IsASnapWithinASubPixelOfAnEdge)
{
    // A vertical edge near the centre of pixel column 40: x = ±1 m spans ±1/(4·tan 22.5°)·24 px.
    const double px_per_m = 24 / (4 * std::tan(glm::radians(22.5)));
    for (const double offset_px : {-1.0 / 512, 1.0 / 512, 1.0 / 16}) {
        const double edge = (40.5 + offset_px - 32) / px_per_m;
        SceneBuilder builder;
        builder.add("sheet", std::vector<Vec3d>{{edge, -1, 0}, {edge, 1, 0}, {-1, 0, 0}},
                    std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
        const TriangleScene scene = builder.take();
        const bool is_covered = offset_px > 0;
        // Row 24: the triangle's other edges are 7 px and more away.
        const auto pixel =
            class_when_seeing(scene, front_view(), 40, 24, is_covered ? no_triangle : 0U);
        expect_unmatched(pixel, std::abs(offset_px) < 1.0 / 256 ? ClassReason::snap
                                                                : ClassReason::mismatch);
    }
}

TEST(Unmatched, IsASnapWhereGlsPositionsCollapseToAPoint)
{
    // Far from the origin float32 steps are larger than a triangle. Its point lies pixels away from
    // the centre, whether as it is or turned over.
    const TriangleScene scene = square_and_sheet(1);
    auto receivers = brute_force_receivers(scene, front_view());
    const int x = 36;
    const int y = 30;
    receivers(x, y) = no_triangle;
    for (const float side : {-1.0F, 1.0F}) {
        const scene::Vec4f point{0.5F * side, 0.5F * side, 0.001F, 4};
        const renderers::RasterFacts collapsed{
            8, std::vector<scene::Vec4f>(scene.vertices.size(), point)};
        const auto truth = compute_truth(ReferenceScene{scene}, front_view(), receivers, collapsed);
        expect_unmatched({truth.pixel_class(x, y), truth.reason(x, y)}, ClassReason::snap);
    }
}

TEST(Unmatched, IsASnapWhereTheNearPlaneCutsATriangle)
{
    // Seen in parallel rays along −z from z = 4, a slope reaches through the near plane: 24 px a
    // metre, and z grows by a metre along x. GL clips right of x where z = 4 − near.
    SceneBuilder builder;
    builder.add("slope", std::vector<Vec3d>{{-9, -9, -9}, {9, -9, 9}, {9, 9, 9}, {-9, 9, -9}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
    const TriangleScene scene = builder.take();
    View view = make_view({4, 0, 4}, {4, 0, 0}, small_image, directional({0.1, 0.2, -1}),
                          scene::Projection::orthographic);
    view.camera.half_height = 1;
    const double near_m = scene::receiver_near_m(scene.bounds());
    // Half a sub-pixel on either side of a column's centre, and a quarter of a pixel.
    for (const double offset_px : {-1.0 / 512, 1.0 / 512, -0.25, 0.25}) {
        TriangleScene moved = scene;
        const double cut_m = 4 + (40.5 + offset_px - 32) / 24;
        for (scene::Vec3f& vertex : moved.vertices) {
            vertex.z += static_cast<float>(4 - near_m - cut_m);
        }
        const bool is_covered = offset_px > 0;
        const std::uint32_t seen = brute_force_receivers(moved, view)(40, 30);
        ASSERT_EQ(seen != no_triangle, is_covered) << offset_px;
        const auto pixel = class_when_seeing(moved, view, 40, 30, is_covered ? no_triangle : 1U);
        expect_unmatched(pixel, std::abs(offset_px) < 1.0 / 256 ? ClassReason::snap
                                                                : ClassReason::mismatch);
    }
}

} // namespace
} // namespace gnomon::reference_rt::test
