#include "scene_fixture.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace gnomon::reference_rt::test {
namespace {

constexpr ImageSize audited_image{160, 120};

struct Audited {
    std::vector<scene::FloatMethodErrors> errors;
    scene::Truth truth;
    scene::Truth plain;

    [[nodiscard]] const scene::FloatMethodErrors& of(std::string_view name) const
    {
        for (const auto& method : errors) {
            if (method.name == name) {
                return method;
            }
        }
        throw std::out_of_range{std::string{name}};
    }
};

/// A sphere on a tiled ground, moved off the origin by `shift`.
Audited audit_at(const Vec3d& shift)
{
    SceneBuilder builder;
    add_ground(builder, 3, 16);
    add_sphere(builder, {0, 1, 0}, 1, 12);
    TriangleScene scene = builder.take();
    for (scene::Vec3f& vertex : scene.vertices) {
        vertex += scene::Vec3f{shift};
    }
    const View view = make_view(Vec3d{2, 2.5, 4} + shift, Vec3d{0, 0.5, 0} + shift, audited_image,
                                directional({-0.4, -1, -0.3}));
    const auto receivers = brute_force_receivers(scene, view);
    const ReferenceScene reference{scene, {0, true, true}};
    Audited audited;
    audited.truth = compute_truth(reference, view, receivers, {});
    audited.plain = compute_truth(reference, view, receivers, {}, {TruthMethod::plain, 0});
    audited.errors = audit_float_methods(reference, view, receivers, audited.truth);
    return audited;
}

TEST(AuditFloatMethods, CountsScoredPixelsInWhichAMethodDiffers)
{
    const Audited audited = audit_at({1000, -1000, 500});
    ASSERT_EQ(audited.errors.size(), 4U);
    std::uint64_t false_blocked = 0;
    std::uint64_t false_lit = 0;
    for (std::size_t i = 0; i < audited.truth.pixel_class.pixel_count(); ++i) {
        const PixelClass truth = audited.truth.pixel_class[i];
        const PixelClass plain = audited.plain.pixel_class[i];
        false_blocked += truth == PixelClass::lit && plain == PixelClass::blocked ? 1U : 0U;
        false_lit += truth == PixelClass::blocked && plain == PixelClass::lit ? 1U : 0U;
    }
    // `--truth float` is the method that starts rays 1e-4 of the diagonal off the surface.
    EXPECT_EQ(audited.of("ray_start_1e-4").false_blocked, false_blocked);
    EXPECT_EQ(audited.of("ray_start_1e-4").false_lit, false_lit);
}

TEST(AuditFloatMethods, FindsSelfIntersectionsWithoutOffsetAndMoreFarFromTheOrigin)
{
    const Audited near = audit_at({0, 0, 0});
    const Audited far = audit_at({1000, -1000, 500});
    EXPECT_GT(near.of("no_offset").false_blocked, 1000U);
    // Far away P is rounded by up to 3e-5 m, so neighbouring tiles block it where its own triangle
    // is excluded.
    EXPECT_GT(far.of("id_exclusion").false_blocked, near.of("id_exclusion").false_blocked);
    EXPECT_LT(far.of("id_exclusion").false_blocked, far.of("no_offset").false_blocked);
}

TEST(AuditFloatMethods, NeedsPlainRays)
{
    SceneBuilder builder;
    add_ground(builder, 3, 1);
    const TriangleScene scene = builder.take();
    const View view = make_view({2, 2.5, 4}, {0, 0, 0}, audited_image, directional({0, -1, 0}));
    const Image<std::uint32_t> receivers{audited_image, 0};
    const ReferenceScene reference{scene};
    const auto truth = compute_truth(reference, view, brute_force_receivers(scene, view), {});
    EXPECT_THROW((void)audit_float_methods(reference, view, receivers, truth),
                 std::invalid_argument);
}

} // namespace
} // namespace gnomon::reference_rt::test
