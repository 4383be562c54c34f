#include "reports/depth/drawing.hpp"

#include "scene/error.hpp"

#include <gmock/gmock.h>

#include <string>

namespace gnomon::reports {
namespace {

using ::testing::HasSubstr;

constexpr store::Rgb red{255, 0, 0};
constexpr store::Rgb white{255, 255, 255};

TEST(Drawing, IsWhiteWithoutMarks)
{
    const store::RgbImage image = rasterise({{8, 6}, {}, {}});
    for (const store::Rgb& pixel : image) {
        EXPECT_EQ(pixel, white);
    }
}

TEST(Drawing, CoversThePixelsOfALine)
{
    // Two pixels wide on the border of two rows: covers both entirely, and no others.
    const store::RgbImage image = rasterise({{8, 8}, {Polyline{{{-4, 4}, {12, 4}}, red, 2}}, {}});
    for (int x = 0; x < 8; ++x) {
        EXPECT_EQ(image(x, 3), red);
        EXPECT_EQ(image(x, 4), red);
        EXPECT_EQ(image(x, 2), white);
        EXPECT_EQ(image(x, 5), white);
    }
}

TEST(Drawing, PaintsLaterMarksOnTop)
{
    const store::RgbImage image =
        rasterise({{9, 9}, {Dots{{{4.5, 4.5}}, {0, 0, 255}, 3}, Dots{{{4.5, 4.5}}, red, 1}}, {}});
    EXPECT_EQ(image(4, 4), red);
    EXPECT_EQ(image(6, 4), (store::Rgb{0, 0, 255}));
    EXPECT_EQ(image(0, 0), white);
}

TEST(Drawing, LeavesOutWhatLiesOutside)
{
    const store::RgbImage image = rasterise(
        {{4, 4}, {Polyline{{{-1e6, -50}, {1e6, -50}}, red, 3}, Dots{{{99, 99}}, red, 2}}, {}});
    for (const store::Rgb& pixel : image) {
        EXPECT_EQ(pixel, white);
    }
}

TEST(Drawing, IsSvgWithEscapedText)
{
    const std::string svg = svg_text({{40, 20},
                                      {Polyline{{{1, 2}, {3, 4}}, red, 1}, Dots{{{5, 6}}, red, 1}},
                                      {{{7, 8}, "a < b & c", {12}, Anchor::middle}}});
    EXPECT_THAT(svg, HasSubstr("width=\"40\" height=\"20\""));
    EXPECT_THAT(svg, HasSubstr("points=\"1.00,2.00 3.00,4.00 \""));
    EXPECT_THAT(svg, HasSubstr("<circle cx=\"5.00\" cy=\"6.00\""));
    EXPECT_THAT(svg, HasSubstr("text-anchor=\"middle\">a &lt; b &amp; c</text>"));
}

TEST(Drawing, IsWrittenAsSvgOrPngOnly)
{
    for (const char* name : {"plot", "plot.jpg", "plot.svg.gz", ".png/x"}) {
        EXPECT_THROW(write_drawing(name, {}), scene::InputError) << name;
    }
}

} // namespace
} // namespace gnomon::reports
