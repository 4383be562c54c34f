#include "reference_rt/traversal/embree_scene.hpp"

#include "claims.hpp"
#include "scene_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

/// Injects faults into the truth one at a time, which the certifier must find.
namespace gnomon::reference_rt::test {
namespace {

/// A reference scene for exact truth with these faults.
ReferenceScene make_faulty_scene(const TriangleScene& scene, const Faults& faults)
{
    return ReferenceScene{
        std::make_unique<ReferenceScene::Implementation>(scene, ReferenceOptions{}, faults)};
}

/// A box and a sphere on the ground.
TriangleScene box_and_sphere()
{
    SceneBuilder builder;
    add_ground(builder, 3, 2);
    add_box(builder, {-1, 0, -1}, {0, 1.2, 0.2});
    add_sphere(builder, {0.9, 0.6, 0.4}, 0.5, 6);
    return builder.take();
}

View view_of_box_and_sphere()
{
    return make_view({0.5, 4, 6}, {0, 0.4, 0}, {48, 36}, directional({-0.4, -1, -0.3}));
}

/// Certifies a truth computed with these faults.
Certificate certify_with(const Faults& faults, const TriangleScene& scene, const View& view)
{
    const auto receivers = brute_force_receivers(scene, view);
    const auto truth = compute_truth(make_faulty_scene(scene, faults), view, receivers, {});
    const auto points = receiver_points(scene, view, receivers);
    return certify(scene, view, claims_of(receivers, truth, points), {});
}

TEST(Faults, AreNoneByDefault)
{
    EXPECT_TRUE(certify_with({}, box_and_sphere(), view_of_box_and_sphere()).is_certified());
}

TEST(Faults, OfASignAreRefuted)
{
    const auto certificate =
        certify_with({.light_sign = -1}, box_and_sphere(), view_of_box_and_sphere());
    EXPECT_FALSE(certificate.is_certified());
    EXPECT_GT(certificate.wrong, 10U);
}

TEST(Faults, OfATraversalThatMissesATriangleAreRefuted)
{
    // A sheet over the ground: each of its triangles is the only blocker of its half of the shadow.
    SceneBuilder builder;
    add_ground(builder, 3, 2);
    builder.add("sheet", std::vector<Vec3d>{{-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}},
                std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}, {0, 3, 2}});
    const TriangleScene scene = builder.take();
    const View view = view_of_box_and_sphere();
    EXPECT_TRUE(certify_with({}, scene, view).is_certified());
    const auto last = static_cast<std::uint32_t>(scene.triangles.size() - 1);
    for (const std::uint32_t hidden : {last - 1, last}) {
        const auto certificate = certify_with({.hidden_triangle = hidden}, scene, view);
        EXPECT_FALSE(certificate.is_certified()) << "triangle " << hidden;
        ASSERT_FALSE(certificate.refutations.empty());
        EXPECT_GT(certificate.wrong, 10U);
    }
}

/// Strips low over the ground, for the outer columns of each packet of pixels. Their near edge is
/// the first float32 beyond the point where the column's segments cross their plane: closer than
/// the rays of the traversal resolve, in a frame whose origin is far from here.
struct Strips {
    TriangleScene scene;
    View view;
    std::uint64_t shadowed_px = 0;

    Strips()
    {
        scene::CameraSettings camera;
        camera.eye = {0.3, 4, 0};
        camera.target = {0.3, 0, 0};
        camera.up = {0, 0, -1};
        camera.projection = scene::Projection::orthographic;
        camera.orthographic_height_m = 0.06;
        view = View{scene::make_camera(camera),
                    {48, 8},
                    scene::make_light(directional({-1, -1, 0})),
                    {},
                    {}};
        SceneBuilder builder;
        add_rectangle(builder, "ground", -0.5, 3.7, 0);
        for (int x = 0; x < view.image.width_px; ++x) {
            if (x % 4 == 0 || x % 4 == 3) {
                add_strip(builder, x);
                shadowed_px += static_cast<std::uint64_t>(view.image.height_px);
            }
        }
        scene = builder.take();
        for (scene::Object& object : scene.objects) {
            object.receives = object.name == "ground";
        }
    }

private:
    static void add_rectangle(SceneBuilder& builder, std::string_view name, double x0, double x1,
                              double y)
    {
        builder.add(name, std::vector<Vec3d>{{x0, y, -1}, {x0, y, 1}, {x1, y, 1}, {x1, y, -1}},
                    std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}});
    }

    /// Adds a strip beside the outermost column's view.
    void add_strip(SceneBuilder& builder, int x) const
    {
        // And as far to the side, along (1, 1, 0). It is no multiple of the frame's resolution, or
        // every rounding would go the same way.
        constexpr double height_m{0.0157F};
        const double crossing_m =
            scene::pixel_ray(view.camera, view.image, x, 0).origin.x + height_m;
        const double beyond = x % 4 == 0 ? 1 : -1;
        const double edge_m{
            std::nextafter(static_cast<float>(crossing_m), static_cast<float>(2 * beyond))};
        const double far_m = edge_m - beyond * 0x1p-11;
        add_rectangle(builder, "strip", std::min(edge_m, far_m), std::max(edge_m, far_m), height_m);
    }
};

TEST(Faults, OfMissingPaddingAreRefuted)
{
    const Strips strips;
    const auto sound = certify_with({}, strips.scene, strips.view);
    EXPECT_TRUE(sound.is_certified());
    EXPECT_EQ(sound.claimed[static_cast<std::size_t>(PixelClass::blocked)], strips.shadowed_px);
    const auto certificate = certify_with({.padding_share = 0}, strips.scene, strips.view);
    EXPECT_FALSE(certificate.is_certified());
    EXPECT_GT(certificate.wrong, 10U);
}

} // namespace
} // namespace gnomon::reference_rt::test
