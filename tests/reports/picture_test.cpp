#include "reports/pictures/picture.hpp"

#include "example_comparison.hpp"
#include "reports/pictures/canvas.hpp"
#include "reports/pictures/captions.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "store/exr/aov.hpp"
#include "store/images/layer_file.hpp"
#include "temporary_folder.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include <png.h>

namespace gnomon::reports {
namespace {

using scene::ImageSize;
using scene::PixelClass;
using testing::HasSubstr;

/// Reads a PNG file.
struct PngFile : png_image {
    explicit PngFile(const std::filesystem::path& path) : png_image{}
    {
        version = PNG_IMAGE_VERSION;
        EXPECT_NE(png_image_begin_read_from_file(this, path.c_str()), 0) << message;
    }
    PngFile(const PngFile&) = delete;
    PngFile& operator=(const PngFile&) = delete;
    ~PngFile() { png_image_free(this); }
};

std::ptrdiff_t count_colour(const store::RgbImage& image, store::Rgb colour)
{
    return std::count(image.begin(), image.end(), colour);
}

/// Brightness as a weighted sum of sRGB values.
int brightness(store::Rgb colour)
{
    return (2 * colour.r + 5 * colour.g + colour.b) / 8;
}

TEST(MarkOf, MarksErrorsAndPixelsWithoutATruth)
{
    EXPECT_EQ(mark_of(PixelClass::lit, 1.0F), Mark::none);
    EXPECT_EQ(mark_of(PixelClass::lit, 0.0F), Mark::false_shadow);
    EXPECT_EQ(mark_of(PixelClass::blocked, 0.0F), Mark::none);
    EXPECT_EQ(mark_of(PixelClass::blocked, 0.5F), Mark::false_lit);
    EXPECT_EQ(mark_of(PixelClass::unmatched, 1.0F), Mark::unmatched);
    EXPECT_EQ(mark_of(PixelClass::indeterminate, 1.0F), Mark::indeterminate);
    EXPECT_EQ(mark_of(PixelClass::attached, 1.0F), Mark::none);
    EXPECT_EQ(mark_of(PixelClass::background, 0.0F), Mark::none);
}

TEST(DrawPanels, ColoursEachErrorAtItsPixel)
{
    const analysis::Comparison& comparison = store::example().comparison;
    const Panels panels = draw_panels(comparison, comparison.view.image);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 96; ++x) {
            const Mark mark = mark_of(comparison.truth.pixel_class(x, y),
                                      comparison.lookup.samples(x, y).verdict);
            for (const Mark other : {Mark::false_shadow, Mark::false_lit, Mark::unmatched}) {
                ASSERT_EQ(panels.errors(x, y) == mark_colour(other), mark == other)
                    << "pixel " << x << ", " << y;
            }
        }
    }
}

TEST(DrawPanels, ShowsTheSamePixelsWhereGlIsRight)
{
    const analysis::Comparison& comparison = store::example().comparison;
    const Panels panels = draw_panels(comparison, comparison.view.image);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 96; ++x) {
            const PixelClass pixel_class = comparison.truth.pixel_class(x, y);
            const store::Rgb gl = panels.gl(x, y);
            const store::Rgb truth = panels.truth(x, y);
            switch (mark_of(pixel_class, comparison.lookup.samples(x, y).verdict)) {
            case Mark::none:
                ASSERT_EQ(gl, truth) << "pixel " << x << ", " << y;
                break;
            case Mark::false_shadow:
                ASSERT_LT(brightness(gl), brightness(truth)) << "pixel " << x << ", " << y;
                break;
            case Mark::false_lit:
                ASSERT_GT(brightness(gl), brightness(truth)) << "pixel " << x << ", " << y;
                break;
            default:
                break;
            }
        }
    }
}

TEST(DrawPanels, MarksTheSamePixelsFromKeptLayers)
{
    const store::TemporaryFolder folder;
    const analysis::Comparison& comparison = store::example().comparison;
    store::write_aov(folder / "a.exr", comparison, store::example().points);
    store::LayerFile layers{folder / "a.exr", ""};
    const Panels kept = draw_panels(layers, comparison.view.image);
    const Panels panels = draw_panels(comparison, comparison.view.image);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 96; ++x) {
            const Mark mark = mark_of(comparison.truth.pixel_class(x, y),
                                      comparison.lookup.samples(x, y).verdict);
            if (mark != Mark::none) {
                ASSERT_EQ(kept.errors(x, y), panels.errors(x, y)) << "pixel " << x << ", " << y;
                continue;
            }
            ASSERT_EQ(kept.gl(x, y), kept.truth(x, y)) << "pixel " << x << ", " << y;
        }
    }
}

/// The example with one false-lit pixel as its only mark.
analysis::Comparison with_one_error(int error_x, int error_y)
{
    analysis::Comparison comparison = store::example().comparison;
    for (std::size_t i = 0; i < comparison.truth.pixel_class.pixel_count(); ++i) {
        comparison.truth.pixel_class[i] = PixelClass::lit;
        comparison.lookup.samples[i].verdict = 1.0F;
    }
    comparison.truth.pixel_class(error_x, error_y) = PixelClass::blocked;
    return comparison;
}

TEST(DrawPanels, TintsWhatIsPartlyWrong)
{
    analysis::Comparison comparison = with_one_error(0, 0);
    comparison.truth.pixel_class(0, 0) = PixelClass::lit;
    const ImageSize size = comparison.view.image;
    const store::Rgb right = draw_panels(comparison, size).errors(40, 30);
    comparison.lookup.samples(40, 30).verdict = 0.75F;
    const store::Rgb partly = draw_panels(comparison, size).errors(40, 30);
    // A quarter of the way to vermilion, each channel rounded.
    const store::Rgb mark = mark_colour(Mark::false_shadow);
    EXPECT_NEAR(partly.r, 0.75 * right.r + 0.25 * mark.r, 0.5);
    EXPECT_NEAR(partly.g, 0.75 * right.g + 0.25 * mark.g, 0.5);
    EXPECT_NEAR(partly.b, 0.75 * right.b + 0.25 * mark.b, 0.5);
    // Larger errors have the full colour.
    comparison.lookup.samples(40, 30).verdict = 0.25F;
    EXPECT_EQ(draw_panels(comparison, size).errors(40, 30), mark);
}

TEST(DrawPanels, NeverLosesAnErrorWhenScalingDown)
{
    // 96x64 into 37x23: neither factor is whole.
    constexpr ImageSize size{37, 23};
    for (const auto& [x, y] :
         {std::pair{0, 0}, std::pair{95, 63}, std::pair{47, 31}, std::pair{13, 50}}) {
        const Panels panels = draw_panels(with_one_error(x, y), size);
        EXPECT_EQ(panels.errors(x * 37 / 96, y * 23 / 64), mark_colour(Mark::false_lit))
            << "error at " << x << ", " << y;
        EXPECT_GE(count_colour(panels.errors, mark_colour(Mark::false_lit)), 1);
        // A pixel of the image touches at most two panel pixels each way.
        EXPECT_LE(count_colour(panels.errors, mark_colour(Mark::false_lit)), 4);
    }
}

TEST(DrawPanels, ShowsEachPixelAsABlockWhenScalingUp)
{
    const Panels panels = draw_panels(with_one_error(10, 20), {96 * 3, 64 * 3});
    EXPECT_EQ(count_colour(panels.errors, mark_colour(Mark::false_lit)), 9);
    EXPECT_EQ(panels.errors(30, 60), mark_colour(Mark::false_lit));
    EXPECT_EQ(panels.errors(32, 62), mark_colour(Mark::false_lit));
}

TEST(DrawPanels, DrawsAnImageOfOnePixel)
{
    const store::Example tiny{{.image = {1, 1}}};
    const Panels panels = draw_panels(tiny.comparison, {4, 4});
    EXPECT_EQ(count_colour(panels.gl, panels.gl(0, 0)), 16);
}

TEST(DrawPanels, ShowsTheErrorsOfAPart)
{
    const analysis::Comparison comparison = with_one_error(40, 30);
    const ImagePart part{38, 29, {12, 8}};
    const Panels panels = draw_panels(comparison, part.size, part);
    EXPECT_EQ(count_colour(panels.errors, mark_colour(Mark::false_lit)), 1);
    EXPECT_EQ(panels.errors(2, 1), mark_colour(Mark::false_lit));
    const Panels whole = draw_panels(comparison, comparison.view.image);
    EXPECT_EQ(panels.gl(11, 7), whole.gl(49, 36));
}

/// The example at a bias, with the errors at every other one.
analysis::Comparison diagnosed(float bias)
{
    const store::Example example{{.bias_constant = bias}};
    analysis::Comparison comparison = store::example().comparison;
    comparison.view = example.comparison.view;
    comparison.lookup = example.comparison.lookup;
    comparison.metrics = example.comparison.metrics;
    scene::Image<float> criticals{comparison.view.image};
    for (std::size_t i = 0; i < criticals.pixel_count(); ++i) {
        const scene::LookupSample& sample = comparison.lookup.samples[i];
        criticals[i] = sample.receiver_depth - sample.map_depth;
    }
    analysis::BiasCurve curve{criticals, comparison.truth.pixel_class};
    analysis::Diagnosis& diagnosis = comparison.diagnosis.emplace();
    diagnosis.curve.recommended = analysis::recommend_by_count(
        curve, {comparison.view.first_map(), 48, 10}, comparison.job.bias);
    diagnosis.biases.emplace(
        analysis::BiasAnswers{std::move(criticals), std::move(curve), {}, {}, {}, {}});
    return comparison;
}

TEST(RecommendedErrors, AreThoseThatTheRecommendationCounts)
{
    const analysis::Comparison comparison = diagnosed(0.0F);
    const auto after = recommended_errors(comparison);
    ASSERT_TRUE(after);
    const analysis::ErrorCounts& errors = after->recommended->rounded_outcome.errors;
    ASSERT_GT(errors.total(), 0U);
    const store::RgbImage drawn = draw_errors(comparison, after->verdicts, comparison.view.image);
    EXPECT_EQ(count_colour(drawn, mark_colour(Mark::false_shadow)),
              static_cast<std::ptrdiff_t>(errors.false_shadow));
    EXPECT_EQ(count_colour(drawn, mark_colour(Mark::false_lit)),
              static_cast<std::ptrdiff_t>(errors.false_lit));
}

TEST(RecommendedErrors, AreCaptionedWithTheirCounts)
{
    const analysis::Comparison comparison = diagnosed(0.0F);
    const analysis::Recommendation& recommended = *comparison.diagnosis->curve.recommended;
    const analysis::ErrorCounts& errors = recommended.rounded_outcome.errors;
    const Caption caption = after_caption(comparison, recommended);
    EXPECT_THAT(caption.title, testing::StartsWith("After: bias.constant = "));
    EXPECT_THAT(caption.title, testing::EndsWith(" units)"));
    ASSERT_EQ(caption.lines.size(), 3U);
    EXPECT_THAT(caption.lines[0].detail,
                testing::StartsWith(fmt::format("{} of ", errors.false_shadow)));
    EXPECT_THAT(caption.lines[1].detail,
                testing::StartsWith(fmt::format("{} of ", errors.false_lit)));
    EXPECT_THAT(caption.lines[2].name, HasSubstr("from " + percent(comparison.metrics.error_rate)));
}

TEST(RecommendedErrors, AreEmptyWhereTheRecommendationIsNoBetter)
{
    analysis::Comparison comparison = diagnosed(0.0F);
    const float bias = comparison.diagnosis->curve.recommended->rounded.bias;
    EXPECT_FALSE(recommended_errors(diagnosed(bias)));
    comparison.diagnosis->curve.recommended.reset();
    EXPECT_FALSE(recommended_errors(comparison));
    EXPECT_FALSE(recommended_errors(store::example().comparison)); // without a diagnosis
}

TEST(RecommendedErrors, AreEmptyWhereVerdictsMayBeFractions)
{
    analysis::Comparison comparison = diagnosed(0.0F);
    comparison.job.lookup.filter = scene::Filter::pcf3;
    EXPECT_FALSE(recommended_errors(comparison));
}

TEST(DrawPicture, HasAFourthPanelForTheRecommendedBias)
{
    EXPECT_EQ(draw_picture(diagnosed(0.0F)).size(),
              lay_out_picture({96, 64}, {.panels = 4}).canvas);
}

TEST(ShownCaption, LeavesOutBiasesOfZero)
{
    const Caption caption = shown_caption(store::example().comparison);
    ASSERT_EQ(caption.lines.size(), 4U);
    EXPECT_EQ(caption.lines[1].name, "bias constant 0.002");
    EXPECT_THAT(caption.lines[2].name,
                testing::MatchesRegex("near .* units, far .* units, cull none"));
}

TEST(ShownCaption, ListsAnEnginesOwnKeys)
{
    analysis::Comparison comparison = store::example().comparison;
    std::vector<scene::Key> keys;
    for (const char* const name : {"engine.bias", "engine.kind"}) {
        keys.push_back(scene::added_key(
            scene::make_key(name, "what it does", "", scene::only(scene::Stage::lookup)),
            scene::RealDomain{.lower = 0, .upper = 1}, 0.5, {}));
    }
    comparison.job.keys = scene::keys_of(comparison.job).with_engine_keys(std::move(keys));
    comparison.job.method.values = {{"engine.bias", 0.001}};
    comparison.evaluation.emplace().given_keys = {"engine.bias", "engine.kind"};
    const Caption caption = shown_caption(comparison);
    ASSERT_EQ(caption.lines.size(), 1U);
    EXPECT_EQ(caption.lines[0].name, "engine bias\u00A0=\u00A00.001, kind\u00A0=\u00A00.5");
}

TEST(ShownCaption, WritesFewDigits)
{
    analysis::Comparison comparison = store::example().comparison;
    comparison.job.bias.slope = 1.0 / 3;
    comparison.job.shadow_map.resolution_texels = 16384;
    comparison.evaluation.emplace().given_keys = {"bias.slope", "shadow_map.resolution"};
    const Caption caption = shown_caption(comparison);
    ASSERT_EQ(caption.lines.size(), 2U);
    EXPECT_EQ(caption.lines[0].name, "map resolution\u00A0=\u00A016384");
    EXPECT_EQ(caption.lines[1].name, "bias slope\u00A0=\u00A00.3333");
}

TEST(WritePicture, WritesAPngOfTheLayoutsSizeWithTheErrorColours)
{
    const store::TemporaryFolder folder;
    write_picture(folder / "picture.png", store::example().comparison);
    const PictureLayout layout = lay_out_picture({96, 64});
    PngFile png{folder / "picture.png"};
    ASSERT_EQ(png.width, static_cast<unsigned>(layout.canvas.width_px));
    ASSERT_EQ(png.height, static_cast<unsigned>(layout.canvas.height_px));
    ASSERT_EQ(png.format, static_cast<unsigned>(PNG_FORMAT_RGB));
    store::RgbImage image{layout.canvas};
    ASSERT_NE(png_image_finish_read(&png, nullptr, image.data(), 0, nullptr), 0) << png.message;
    const int factor = layout.panel.width_px / 96;
    const auto& metrics = store::example().comparison.metrics;
    // Blocks in the panel, and the swatch below it.
    EXPECT_GT(count_colour(image, mark_colour(Mark::false_shadow)),
              static_cast<std::ptrdiff_t>(metrics.false_shadow) * factor * factor);
    EXPECT_GT(count_colour(image, mark_colour(Mark::false_lit)),
              static_cast<std::ptrdiff_t>(metrics.false_lit) * factor * factor);
}

TEST(WritePicture, WritesTheSameBytesAgain)
{
    const store::TemporaryFolder folder;
    write_picture(folder / "a.png", store::example().comparison);
    write_picture(folder / "b.png", store::example().comparison);
    EXPECT_EQ(store::read_text(folder / "a.png"), store::read_text(folder / "b.png"));
}

TEST(WritePicture, SurvivesLongNamesAndMissingRates)
{
    analysis::Comparison comparison = store::example().comparison;
    comparison.scene.name = std::string(3000, 'W') + "é\xE9";
    comparison.environment = {};
    comparison.metrics = {};
    const store::RgbImage image = draw_picture(comparison);
    const PictureLayout layout = lay_out_picture({96, 64});
    EXPECT_EQ(image.size().width_px, layout.canvas.width_px);
    // The renderer has no name, which saves a line.
    EXPECT_LE(image.size().height_px, layout.canvas.height_px);
}

std::vector<store::Rgb> pixels_of(const store::RgbImage& image)
{
    return {image.begin(), image.end()};
}

TEST(DrawPicture, SaysOfAnotherRenderersCaseOnlyWhatItSays)
{
    analysis::Comparison comparison = store::example().comparison;
    comparison.environment.gl_renderer = "My Engine";
    comparison.environment.gl_version = analysis::Environment::other_renderer;
    analysis::Evaluation& evaluation = comparison.evaluation.emplace();
    evaluation.case_name = "noon";
    evaluation.points = scene::Image<scene::Vec3f>{comparison.view.image};
    evaluation.normal = scene::Image<scene::Vec3f>{comparison.view.image, {0, 0, 1}};
    const std::vector<store::Rgb> bare = pixels_of(draw_picture(comparison));
    comparison.job.shadow_map.resolution_texels = 4096;
    comparison.job.bias.slope = 3;
    EXPECT_EQ(pixels_of(draw_picture(comparison)), bare); // defaults are not written
    evaluation.given_keys = {"bias.slope"};
    EXPECT_NE(pixels_of(draw_picture(comparison)), bare);
    const std::vector<store::Rgb> given = pixels_of(draw_picture(comparison));
    comparison.job.shadow_map.resolution_texels = 1024;
    EXPECT_EQ(pixels_of(draw_picture(comparison)), given);
    evaluation.case_name = "dusk";
    EXPECT_NE(pixels_of(draw_picture(comparison)), given);
    evaluation.case_name = "noon";
    comparison.environment.gl_renderer = "Your Engine";
    EXPECT_NE(pixels_of(draw_picture(comparison)), given);
}

TEST(WritePicture, ReportsAnUnwritablePath)
{
    EXPECT_THROW(write_picture("/dev/full", store::example().comparison), scene::EnvironmentError);
}

TEST(DrawPicture, NamesThePackageOfAMissingFont)
{
    const store::TemporaryFolder folder;
    try {
        (void)draw_picture(store::example().comparison, folder.path());
        FAIL() << "a picture without a font";
    } catch (const scene::EnvironmentError& error) {
        EXPECT_THAT(error.what(), HasSubstr("install fonts-dejavu-core"));
    }
}

} // namespace
} // namespace gnomon::reports
