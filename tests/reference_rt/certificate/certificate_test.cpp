#include "reference_rt/certificate/certificate.hpp"

#include "claims.hpp"
#include "reference_rt/certificate/pixel.hpp"
#include "scene_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::reference_rt {
namespace {

using scene::Image;
using scene::ImageSize;
using scene::no_triangle;
using scene::PixelClass;
using scene::SceneBuilder;
using scene::View;
using testing::HasSubstr;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr scene::Vec3f not_a_point{nan, nan, nan};

/// A box and a sphere on the ground, small enough for every pixel to be derived.
struct CertifiedScene {
    scene::TriangleScene scene;
    View view;
    TruthClaims claims;

    explicit CertifiedScene(const scene::LightSettings& light = test::directional({-0.4, -1, -0.3}))
    {
        SceneBuilder builder;
        test::add_ground(builder, 3, 2);
        test::add_box(builder, {-1, 0, -1}, {0, 1.2, 0.2});
        test::add_sphere(builder, {0.9, 0.6, 0.4}, 0.5, 6);
        scene = builder.take();
        view = test::make_view({0.5, 4, 6}, {0, 0.4, 0}, {48, 36}, light);
        const auto receivers = test::brute_force_receivers(scene, view);
        claims = test::claims_of(receivers, test::truth_of(scene, view),
                                 receiver_points(scene, view, receivers));
    }

    [[nodiscard]] Certificate certify(const CertificateOptions& options = {}) const
    {
        return reference_rt::certify(scene, view, claims, options);
    }
    /// The first pixel of a class.
    [[nodiscard]] std::size_t find(PixelClass pixel_class) const
    {
        const auto found =
            std::find(claims.pixel_class.begin(), claims.pixel_class.end(), pixel_class);
        return static_cast<std::size_t>(found - claims.pixel_class.begin());
    }
    void claim(std::size_t pixel, PixelClass pixel_class)
    {
        claims.pixel_class[pixel] = pixel_class;
        claims.truth[pixel] = pixel_class == PixelClass::lit       ? 1.0F
                              : pixel_class == PixelClass::blocked ? 0.0F
                                                                   : -1.0F;
    }
    /// Expects that exactly this pixel is refuted, with such a reason.
    void expect_refuted(std::size_t pixel, const std::string& reason) const
    {
        const Certificate certificate = certify();
        EXPECT_FALSE(certificate.is_certified());
        EXPECT_EQ(certificate.error_rate_bound(), std::nullopt);
        ASSERT_EQ(certificate.wrong, 1U);
        const Refutation& refutation = certificate.refutations.at(0);
        EXPECT_EQ(static_cast<std::size_t>(refutation.y * view.image.width_px + refutation.x),
                  pixel);
        EXPECT_EQ(refutation.claimed, claims.pixel_class[pixel]);
        EXPECT_THAT(refutation.reason, HasSubstr(reason));
    }
};

TEST(Certify, CertifiesTheReferencesTruthOfEveryPixel)
{
    for (const auto& light :
         {test::directional({-0.4, -1, -0.3}), test::spot({2, 4, 1}, {0, 0, 0}, 40)}) {
        const CertifiedScene example{light};
        const Certificate certificate = example.certify();
        for (const Refutation& refutation : certificate.refutations) {
            ADD_FAILURE() << refutation.x << ' ' << refutation.y << ": " << refutation.reason;
        }
        EXPECT_TRUE(certificate.is_certified());
        // The surface has fewer pixels than the sample.
        EXPECT_EQ(certificate.derived, certificate.claimed);
        EXPECT_EQ(certificate.positions, certificate.surface_pixels);
        EXPECT_GT(certificate.witnesses, 10U);
        EXPECT_EQ(certificate.error_rate_bound(), 0.0);
    }
}

TEST(Certify, RefutesAFlippedClass)
{
    CertifiedScene example;
    const std::size_t lit = example.find(PixelClass::lit);
    for (const PixelClass claim : {PixelClass::attached, PixelClass::out_of_light,
                                   PixelClass::unmatched, PixelClass::indeterminate}) {
        example.claim(lit, claim);
        example.expect_refuted(lit, "it is lit: nothing meets the segment to the light");
    }
    example.claim(lit, PixelClass::background);
    example.expect_refuted(lit, "GL sees triangle ");
}

TEST(Certify, RefutesABlockedPixelThatIsClaimedLit)
{
    CertifiedScene example;
    const std::size_t blocked = example.find(PixelClass::blocked);
    example.claim(blocked, PixelClass::lit);
    example.claims.witness[blocked] = no_triangle;
    example.expect_refuted(blocked, "crosses the segment to the light (signs: edges ");
}

TEST(Certify, RefutesALitPixelThatIsClaimedBlocked)
{
    CertifiedScene example;
    const std::size_t lit = example.find(PixelClass::lit);
    example.claim(lit, PixelClass::blocked);
    example.claims.witness[lit] = 30;
    example.expect_refuted(lit, "witness 30 does not block (signs: edges ");
}

TEST(Certify, RefutesAReplacedOrMissingWitnessOutsideTheSampleToo)
{
    CertifiedScene example;
    const std::size_t blocked = example.find(PixelClass::blocked);
    // The ground's first triangle, seen from its own plane, blocks nobody.
    for (const auto& [witness, reason] :
         {std::pair{0U, "witness 0"}, std::pair{no_triangle, "none of the scene's"},
          std::pair{1'000'000U, "none of the scene's"}}) {
        example.claims.witness[blocked] = witness;
        example.expect_refuted(blocked, reason);
        EXPECT_EQ(example.certify({.sample = 1}).wrong, 1U);
    }
}

TEST(Certify, RefutesAWitnessOfAPixelThatIsNotBlocked)
{
    CertifiedScene example;
    const std::size_t lit = example.find(PixelClass::lit);
    example.claims.witness[lit] = 3;
    example.expect_refuted(lit, "it has the witness 3 but is not blocked");
}

TEST(Certify, RefutesAnotherReceiver)
{
    CertifiedScene example;
    const std::size_t lit = example.find(PixelClass::lit);
    const std::uint32_t receiver = example.claims.receiver[lit];
    for (const auto& [other, reason] :
         {std::pair{receiver ^ 1U,
                    "it is unmatched: the exact ray sees triangle " + std::to_string(receiver)},
          std::pair{1'000'000U, std::string{"triangle 1000000 is none of the scene's"}}}) {
        example.claims.receiver[lit] = other;
        example.expect_refuted(lit, reason);
    }
    example.claims.receiver[lit] = no_triangle;
    example.claims.position[lit] = not_a_point;
    example.expect_refuted(lit, "it is unmatched");
}

TEST(Certify, RefutesATruthThatIsNotItsClasss)
{
    CertifiedScene example;
    const std::size_t lit = example.find(PixelClass::lit);
    for (const float truth : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
        example.claims.truth[lit] = truth;
        example.expect_refuted(lit, "and not 1");
    }
}

TEST(Certify, RefutesAPositionThatIsNotItsReceiversOutsideTheSampleToo)
{
    const CertifiedScene honest;
    for (const PixelClass pixel_class : {PixelClass::lit, PixelClass::blocked}) {
        const std::size_t pixel = honest.find(pixel_class);
        for (int axis = 0; axis < 3; ++axis) {
            CertifiedScene example = honest;
            float& coordinate = example.claims.position[pixel][axis];
            coordinate += 1e-6F; // two steps of float32 at 4 m; no coordinate here is larger
            EXPECT_EQ(example.certify({.sample = 1}).wrong, 1U) << axis;
            example.expect_refuted(pixel, "its P.");
            coordinate = nan;
            example.expect_refuted(pixel, "is nan and not ");
        }
    }
}

TEST(Certify, RefutesAPositionWhereNothingIsSeen)
{
    CertifiedScene example;
    const std::size_t background = example.find(PixelClass::background);
    example.claims.position[background] = {1, 2, 3};
    example.expect_refuted(background, "it has a P, but GL sees nothing there");
}

TEST(Certify, RefutesEverySurfacePixelThatWasErasedToBackground)
{
    CertifiedScene example;
    std::uint64_t erased = 0;
    for (std::size_t i = 0; i < example.claims.pixel_class.pixel_count(); i += 7) {
        if (example.claims.pixel_class[i] != PixelClass::background) {
            example.claim(i, PixelClass::background);
            example.claims.receiver[i] = no_triangle;
            example.claims.witness[i] = no_triangle;
            example.claims.position[i] = not_a_point;
            ++erased;
        }
    }
    ASSERT_GT(erased, 50U);
    const Certificate certificate = example.certify({.sample = 1});
    EXPECT_EQ(certificate.wrong, erased);
    EXPECT_THAT(certificate.refutations.at(0).reason, HasSubstr("the exact ray sees triangle "));
}

TEST(Certify, RefutesASceneThatLacksABlocker)
{
    // The claims were made without the sphere: its shadow was missed.
    const CertifiedScene example;
    CertifiedScene without = example;
    for (std::size_t i = 0; i < without.claims.pixel_class.pixel_count(); ++i) {
        if (without.claims.pixel_class[i] == PixelClass::blocked &&
            without.scene.object_of(without.claims.witness[i]) == 2) {
            without.claim(i, PixelClass::lit);
            without.claims.witness[i] = no_triangle;
        }
    }
    const Certificate certificate = without.certify();
    EXPECT_GT(certificate.wrong, 5U);
    EXPECT_THAT(certificate.refutations.at(0).reason, HasSubstr("it is blocked: triangle "));
}

TEST(Certify, NamesTheFirstHundredInTheImagesOrder)
{
    CertifiedScene example;
    std::uint64_t lit = 0;
    for (std::size_t i = 0; i < example.claims.pixel_class.pixel_count(); ++i) {
        if (example.claims.pixel_class[i] == PixelClass::lit) {
            example.claims.witness[i] = 0;
            ++lit;
        }
    }
    ASSERT_GT(lit, 100U);
    for (const int threads : {1, 2, 7}) {
        const Certificate certificate = example.certify({.sample = 10, .threads = threads});
        EXPECT_EQ(certificate.wrong, lit);
        ASSERT_EQ(certificate.refutations.size(), 100U);
        const auto place = [](const Refutation& r) { return std::pair{r.y, r.x}; };
        EXPECT_TRUE(std::ranges::is_sorted(certificate.refutations, {}, place));
        EXPECT_EQ(place(certificate.refutations[0]).first * example.view.image.width_px +
                      place(certificate.refutations[0]).second,
                  static_cast<int>(example.find(PixelClass::lit)));
    }
}

TEST(Certify, DrawsTheSampleFromTheSurfaceAndFillsUpRareClasses)
{
    const CertifiedScene example;
    const Certificate certificate = example.certify({.sample = 100, .seed = 5});
    EXPECT_EQ(certificate.sampled, 100U);
    // 3/k for k pixels without a wrong one.
    EXPECT_DOUBLE_EQ(certificate.error_rate_bound().value(), 0.03);
    std::uint64_t derived = 0;
    for (std::size_t c = 0; c < certificate.derived.size(); ++c) {
        derived += certificate.derived[c];
        EXPECT_LE(certificate.derived[c], certificate.claimed[c]);
        // A twentieth of the sample of every class.
        EXPECT_GE(certificate.derived[c], std::min<std::uint64_t>(certificate.claimed[c], 5)) << c;
    }
    constexpr auto background = static_cast<std::size_t>(PixelClass::background);
    EXPECT_EQ(certificate.derived[background], certificate.claimed[background]);
    EXPECT_GE(derived, 105U);
}

TEST(Certify, DrawsTheSampleBySeedAlone)
{
    CertifiedScene example;
    for (std::size_t i = 0; i < example.claims.pixel_class.pixel_count(); ++i) {
        if (example.claims.pixel_class[i] == PixelClass::lit) {
            example.claim(i, PixelClass::attached); // so that every pixel derived is named
        }
    }
    const auto named = [&](std::uint64_t seed, int threads) {
        std::vector<std::pair<int, int>> places;
        for (const Refutation& refutation :
             example.certify({.sample = 50, .seed = seed, .threads = threads}).refutations) {
            places.emplace_back(refutation.x, refutation.y);
        }
        return places;
    };
    const auto places = named(5, 1);
    EXPECT_GT(places.size(), 20U);
    EXPECT_EQ(named(5, 3), places);
    EXPECT_NE(named(6, 1), places);
}

TEST(Certify, ReportsProgressOfBothStages)
{
    const CertifiedScene example;
    std::vector<std::string> stages;
    CertificateOptions options;
    options.progress = [&](std::string_view stage, std::uint64_t done, std::uint64_t total) {
        EXPECT_LE(done, total);
        if (stages.empty() || stages.back() != stage) {
            stages.emplace_back(stage);
        }
    };
    (void)example.certify(options);
    EXPECT_THAT(stages, testing::ElementsAre("witnesses", "sample"));
}

TEST(Certify, ProvesNothingWithoutSurface)
{
    CertifiedScene example;
    for (std::size_t i = 0; i < example.claims.pixel_class.pixel_count(); ++i) {
        example.claims.receiver[i] = no_triangle;
        example.claims.witness[i] = no_triangle;
        example.claims.position[i] = not_a_point;
        example.claim(i, PixelClass::background);
    }
    for (scene::Object& object : example.scene.objects) {
        object.receives = false;
    }
    const Certificate certificate = example.certify();
    EXPECT_TRUE(certificate.is_certified());
    EXPECT_EQ(certificate.error_rate_bound(), std::nullopt);
}

TEST(Certify, RejectsImagesOfAnotherSize)
{
    CertifiedScene example;
    example.claims.truth = Image<float>{ImageSize{1, 1}};
    EXPECT_THROW((void)example.certify(), std::invalid_argument);
}

TEST(DefaultSampleSize, ShrinksAboveAHundredThousandTriangles)
{
    scene::TriangleScene scene;
    scene.triangles.resize(100'000);
    EXPECT_EQ(default_sample_size(scene), 3000U);
    scene.triangles.resize(100'001);
    EXPECT_EQ(default_sample_size(scene), 300U);
}

} // namespace
} // namespace gnomon::reference_rt
