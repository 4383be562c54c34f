#include "reports/pictures/picture.hpp"

#include "example_comparison.hpp"
#include "reports/pictures/canvas.hpp"
#include "scene/error.hpp"
#include "store/exr/aov.hpp"
#include "store/images/layer_file.hpp"
#include "temporary_folder.hpp"

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

TEST(LayOutPicture, PutsThreePanelsSideBySide)
{
    const PictureLayout layout = lay_out_picture({1920, 1080});
    EXPECT_EQ(layout.panel, (ImageSize{960, 540}));
    EXPECT_FALSE(layout.is_stacked);
    EXPECT_EQ(layout.canvas.width_px, 3 * 960 + 4 * layout.margin);
}

TEST(LayOutPicture, StacksWideImages)
{
    const PictureLayout layout = lay_out_picture({2000, 400});
    EXPECT_TRUE(layout.is_stacked);
    EXPECT_EQ(layout.canvas.width_px, 960 + 2 * layout.margin);
    EXPECT_GT(layout.canvas.height_px, 3 * layout.panel.height_px);
}

TEST(LayOutPicture, KeepsExtremeShapesSmall)
{
    for (const ImageSize image : {ImageSize{1, 1}, ImageSize{16384, 1}, ImageSize{1, 16384},
                                  ImageSize{16384, 16384}, ImageSize{3, 2000}}) {
        const PictureLayout layout = lay_out_picture(image);
        EXPECT_GE(layout.panel.width_px, 1);
        EXPECT_GE(layout.panel.height_px, 1);
        EXPECT_LE(std::max(layout.panel.width_px, layout.panel.height_px), 960);
        EXPECT_LE(layout.canvas.width_px, 3200);
        EXPECT_LE(layout.canvas.height_px, 2400);
    }
}

TEST(Canvas, MeasuresATextWithoutGlyphsAsNothing)
{
    const Canvas canvas{{8, 8}, {255, 255, 255}, default_font_folder};
    const TextStyle style{12, false, {0, 0, 0}};
    EXPECT_EQ(canvas.text_width_px("", style), 0);
    EXPECT_GT(canvas.text_width_px("i", style), 0);
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
    EXPECT_EQ(image.size(), lay_out_picture({96, 64}).canvas);
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

TEST(Canvas, ShortensALineToTheWidth)
{
    const Canvas canvas{{8, 8}, {}, default_font_folder};
    const TextStyle style{20, false, {}};
    EXPECT_EQ(canvas.fitted("short", style, 1000), "short");
    const std::string fitted = canvas.fitted("a line of several words", style, 120);
    EXPECT_THAT(fitted, testing::AllOf(testing::StartsWith("a line"), testing::EndsWith("...")));
    EXPECT_LE(canvas.text_width_px(fitted, style), 120);
    EXPECT_GT(canvas.text_width_px(fitted, style), 120 - 20);
}

TEST(Canvas, SplitsNoCodePoint)
{
    const Canvas canvas{{8, 8}, {}, default_font_folder};
    const TextStyle style{20, false, {}};
    std::string text;
    for (int i = 0; i < 40; ++i) {
        text += "é";
    }
    const std::string fitted = canvas.fitted(text, style, 120);
    EXPECT_EQ(fitted.size() % 2, 1U) << fitted; // two bytes per letter, and three dots
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
