#include "scene_fixture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

/// Classes must not depend on names, order, size and orientation.
namespace gnomon::reference_rt::test {
namespace {

constexpr ImageSize moved_image{48, 36};
constexpr std::array<unsigned, 3> seeds{31, 32, 33};

/// A soup and two boxes on a tiled ground: general triangles, shared edges and coplanar neighbours.
TriangleScene mixed_scene(std::mt19937& random)
{
    std::uniform_real_distribution<double> place{-1.5, 1.5};
    SceneBuilder builder;
    add_ground(builder, 3, 4, -1);
    add_box(builder, {-1, -1, -1}, {-0.25, 0.25, 0}, "box");
    add_box(builder, {-0.25, -1, -1}, {0.5, -0.25, 0}, "touching box");
    for (int i = 0; i < 30; ++i) {
        const Vec3d centre{place(random), place(random), place(random)};
        std::vector<Vec3d> corners;
        for (int k = 0; k < 3; ++k) {
            corners.push_back(centre + 0.3 * Vec3d{place(random), place(random), place(random)});
        }
        builder.add("soup", corners, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}});
    }
    return builder.take();
}

View view_of(bool has_directional)
{
    return make_view({1, 2.5, 4}, {0, -0.5, 0}, moved_image,
                     has_directional ? directional({-0.5, -1, -0.25})
                                     : spot({-1, 3, 1}, {0, 0, 0}, 150));
}

struct Subject {
    TriangleScene scene;
    View view;
    Image<std::uint32_t> receivers;
    scene::Truth truth;
};

Subject make_subject(unsigned seed)
{
    std::mt19937 random{seed};
    Subject subject{mixed_scene(random), view_of(seed % 2 == 0), {}, {}};
    subject.receivers = brute_force_receivers(subject.scene, subject.view);
    subject.truth =
        compute_truth(ReferenceScene{subject.scene}, subject.view, subject.receivers, {});
    EXPECT_GT(count(subject.truth.pixel_class, PixelClass::blocked), 20);
    EXPECT_GT(count(subject.truth.pixel_class, PixelClass::lit), 20);
    return subject;
}

void expect_same_classes(const Subject& subject, const TriangleScene& scene, const View& view,
                         const Image<std::uint32_t>& receivers)
{
    const auto truth = compute_truth(ReferenceScene{scene}, view, receivers, {});
    EXPECT_TRUE(std::ranges::equal(truth.pixel_class, subject.truth.pixel_class));
    EXPECT_TRUE(std::ranges::equal(truth.reason, subject.truth.reason));
}

TEST(Invariance, HoldsWhenTrianglesAndTheirCornersArePermuted)
{
    for (const unsigned seed : seeds) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        const Subject subject = make_subject(seed);
        std::mt19937 random{seed};
        TriangleScene permuted = subject.scene;
        permuted.objects = {{"all", 0, static_cast<std::uint32_t>(permuted.triangles.size())}};
        std::vector<std::uint32_t> order(permuted.triangles.size());
        std::iota(order.begin(), order.end(), 0U);
        std::ranges::shuffle(order, random);
        std::vector<std::uint32_t> place_of(order.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            permuted.triangles[i] = subject.scene.triangles[order[i]];
            std::ranges::shuffle(permuted.triangles[i], random); // turns some over as well
            place_of[order[i]] = i;
        }
        Image<std::uint32_t> receivers = subject.receivers;
        for (std::size_t i = 0; i < receivers.pixel_count(); ++i) {
            receivers[i] = receivers[i] == no_triangle ? no_triangle : place_of[receivers[i]];
        }
        expect_same_classes(subject, permuted, subject.view, receivers);
    }
}

TEST(Invariance, HoldsUnderScalingByPowersOfTwo)
{
    for (const unsigned seed : seeds) {
        const Subject subject = make_subject(seed);
        for (const int exponent : {-100, -30, -3, 5, 40}) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", 2^" << exponent);
            const double factor = std::ldexp(1.0, exponent);
            TriangleScene scaled = subject.scene;
            for (scene::Vec3f& vertex : scaled.vertices) {
                vertex *= static_cast<float>(factor);
            }
            View view = subject.view;
            view.camera.eye *= factor;
            view.light.position *= factor;
            if (view.light.type == scene::LightType::spot) {
                view.light.direction *= factor;
            }
            expect_same_classes(subject, scaled, view, subject.receivers);
        }
    }
}

TEST(Invariance, HoldsWhenAxesAreSwapped)
{
    const auto turned = [](const auto& v) {
        return std::remove_cvref_t<decltype(v)>{v.y, v.z, v.x};
    };
    for (const unsigned seed : seeds) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        const Subject subject = make_subject(seed);
        TriangleScene scene = subject.scene;
        for (scene::Vec3f& vertex : scene.vertices) {
            vertex = turned(vertex);
        }
        View view = subject.view;
        for (Vec3d* v : {&view.camera.eye, &view.camera.forward, &view.camera.right,
                         &view.camera.up, &view.light.direction, &view.light.position}) {
            *v = turned(*v);
        }
        expect_same_classes(subject, scene, view, subject.receivers);
    }
}

/// The scene with one triangle shrunk to a speck far below the ground, so that indices stay.
TriangleScene without(const TriangleScene& scene, std::uint32_t triangle)
{
    TriangleScene result = scene;
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    for (const scene::Vec3f& corner :
         {scene::Vec3f{0, -2, 0}, scene::Vec3f{0.001F, -2, 0}, scene::Vec3f{0, -2, 0.001F}}) {
        result.vertices.push_back(corner);
    }
    result.triangles[triangle] = {first, first + 1, first + 2};
    return result;
}

TEST(Invariance, LeavesAPixelBlockedOrNotWhenItsWitnessIsRemoved)
{
    const Subject subject = make_subject(seeds[0]);
    std::vector<std::uint32_t> witnesses{subject.truth.witness.begin(),
                                         subject.truth.witness.end()};
    std::ranges::sort(witnesses);
    witnesses.erase(std::unique(witnesses.begin(), witnesses.end()), witnesses.end());
    std::erase(witnesses, no_triangle);
    ASSERT_GT(witnesses.size(), 5U);
    for (const std::uint32_t removed : witnesses) {
        SCOPED_TRACE(testing::Message() << "without triangle " << removed);
        const auto truth = compute_truth(ReferenceScene{without(subject.scene, removed)},
                                         subject.view, subject.receivers, {});
        for (std::size_t i = 0; i < truth.pixel_class.pixel_count(); ++i) {
            const PixelClass before = subject.truth.pixel_class[i];
            if (subject.receivers[i] == removed || before == PixelClass::unmatched) {
                continue; // its own surface, or a hit that the removed triangle may have hidden
            }
            if (before == PixelClass::blocked) {
                EXPECT_NE(truth.witness[i], removed) << "pixel " << i;
            } else {
                EXPECT_EQ(truth.pixel_class[i], before) << "pixel " << i;
            }
        }
    }
}

TEST(Invariance, HoldsForAnyNumberOfThreads)
{
    const Subject subject = make_subject(seeds[1]);
    for (const int threads : {1, 2, 7}) {
        const ReferenceScene reference{subject.scene, {threads}};
        const auto truth = compute_truth(reference, subject.view, subject.receivers, {},
                                         {TruthMethod::exact, threads});
        EXPECT_TRUE(std::ranges::equal(truth.pixel_class, subject.truth.pixel_class));
        EXPECT_TRUE(std::ranges::equal(truth.reason, subject.truth.reason));
        EXPECT_EQ(truth.signs, subject.truth.signs) << threads << " threads";
    }
}

TEST(Invariance, HoldsForAnyInstructionSet)
{
    for (const unsigned seed : seeds) {
        const Subject subject = make_subject(seed);
        for (const char* const isa : {"sse2", "sse4.2", "avx", "avx2"}) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << isa);
            const ReferenceScene reference{subject.scene, {.embree_isa = isa}};
            const auto truth = compute_truth(reference, subject.view, subject.receivers, {});
            EXPECT_TRUE(std::ranges::equal(truth.pixel_class, subject.truth.pixel_class));
            EXPECT_TRUE(std::ranges::equal(truth.reason, subject.truth.reason));
        }
    }
}

/// FNV-1a of the bytes of all classes and reasons.
std::uint64_t hash_of(const scene::Truth& truth)
{
    std::uint64_t hash = 0xCBF29CE484222325;
    const auto add = [&hash](auto value) {
        hash = (hash ^ static_cast<std::uint8_t>(value)) * 0x100000001B3;
    };
    std::ranges::for_each(truth.pixel_class, add);
    std::ranges::for_each(truth.reason, add);
    return hash;
}

TEST(Invariance, HoldsForEveryBuild)
{
    // Debug, release and sanitized builds, and both compilers, find the same bytes: these.
    const std::array<std::uint64_t, seeds.size()> expected{0x9FE467D090C89128, 0x86E521378638E8BF,
                                                           0x4C8EA76FCE8640AB};
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        EXPECT_EQ(hash_of(make_subject(seeds[i]).truth), expected[i]) << "seed " << seeds[i];
    }
}

} // namespace
} // namespace gnomon::reference_rt::test
