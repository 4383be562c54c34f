#include "reports/pictures/layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::reports {
namespace {

using scene::ImageSize;
using scene::PixelClass;

TEST(LayOutPicture, PutsThreePanelsSideBySideAndFourInTwoRows)
{
    const PictureLayout three = lay_out_picture({1920, 1080});
    EXPECT_EQ(three.panel, (ImageSize{960, 540}));
    EXPECT_EQ(three.columns, 3);
    EXPECT_EQ(three.canvas.width_px, 3 * 960 + 4 * three.margin);
    const PictureLayout four = lay_out_picture({1920, 1080}, {.panels = 4});
    EXPECT_EQ(four.columns, 2);
    EXPECT_EQ(four.canvas.width_px, 2 * 960 + 3 * four.margin);
    EXPECT_EQ(four.canvas.height_px, three.canvas.height_px + four.step_y);
    EXPECT_EQ(lay_out_picture({300, 900}, {.panels = 4}).columns, 4); // two rows would be too high
}

TEST(LayOutPicture, StacksWideImages)
{
    for (const int panels : {3, 4}) {
        const PictureLayout layout = lay_out_picture({2000, 400}, {.panels = panels});
        EXPECT_EQ(layout.columns, 1);
        EXPECT_EQ(layout.canvas.width_px, 960 + 2 * layout.margin);
        EXPECT_GT(layout.canvas.height_px, panels * layout.panel.height_px);
    }
}

TEST(LayOutPicture, MakesRoomForLongTexts)
{
    const PictureLayout layout = lay_out_picture({96, 64});
    const PictureLayout longer = lay_out_picture({96, 64}, {3, 4, 7});
    EXPECT_EQ(longer.first_panel, layout.first_panel + 2 * layout.line);
    EXPECT_EQ(longer.canvas.height_px, layout.canvas.height_px + 5 * layout.line);
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

/// An image of background with a rectangle of lit pixels.
scene::Image<PixelClass> with_lit(ImageSize size, const ImagePart& lit)
{
    scene::Image<PixelClass> classes{size, PixelClass::background};
    for (int y = 0; y < lit.size.height_px; ++y) {
        for (int x = 0; x < lit.size.width_px; ++x) {
            classes(lit.left + x, lit.top + y) = PixelClass::lit;
        }
    }
    return classes;
}

TEST(ShownPart, IsTheScoredPixelsWithAMarginInTheImagesShape)
{
    // 6 % of 40 px are 3 px on each side, so 46 of 200 px; 23 of 100 px is the image's shape.
    const ImagePart part = shown_part(with_lit({200, 100}, {100, 50, {40, 10}}));
    EXPECT_EQ(part, (ImagePart{97, 43, {46, 23}}));
}

TEST(ShownPart, StaysInsideTheImage)
{
    const ImagePart part = shown_part(with_lit({200, 100}, {160, 90, {40, 10}}));
    EXPECT_EQ(part, (ImagePart{154, 77, {46, 23}}));
}

TEST(ShownPart, IsTheWholeImageUnlessItIsHalved)
{
    const ImageSize size{200, 100};
    const ImagePart whole{0, 0, size};
    // With its margin of 8 px, 124 px become 140 of 200 px: 49 % of the area. One more is 50.1 %.
    EXPECT_EQ(shown_part(with_lit(size, {30, 20, {124, 10}})).size, (ImageSize{140, 70}));
    EXPECT_EQ(shown_part(with_lit(size, {30, 20, {125, 10}})), whole);
    EXPECT_EQ(shown_part(with_lit(size, whole)), whole);
}

TEST(ShownPart, IsTheWholeImageWithoutScoredPixels)
{
    const scene::Image<PixelClass> classes{{200, 100}, PixelClass::background};
    EXPECT_EQ(shown_part(classes), (ImagePart{0, 0, {200, 100}}));
}

TEST(ShownPart, KeepsTheSurroundingsOfAFewPixels)
{
    EXPECT_EQ(shown_part(with_lit({200, 100}, {50, 50, {1, 1}})).size, (ImageSize{25, 13}));
}

} // namespace
} // namespace gnomon::reports
