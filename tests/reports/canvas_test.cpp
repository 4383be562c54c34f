#include "reports/pictures/canvas.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::reports {
namespace {

TEST(Canvas, MeasuresATextWithoutGlyphsAsNothing)
{
    const Canvas canvas{{8, 8}, {255, 255, 255}, default_font_folder};
    const TextStyle style{12, false, {0, 0, 0}};
    EXPECT_EQ(canvas.text_width_px("", style), 0);
    EXPECT_GT(canvas.text_width_px("i", style), 0);
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

TEST(Canvas, WrapsALineAtSpaces)
{
    const Canvas canvas{{8, 8}, {}, default_font_folder};
    const TextStyle style{20, false, {}};
    const std::string text = "a line of several words";
    EXPECT_THAT(canvas.wrapped(text, style, 1000, 3), testing::ElementsAre(text));
    const std::vector<std::string> lines = canvas.wrapped(text, style, 120, 5);
    EXPECT_GT(lines.size(), 1U);
    EXPECT_EQ(fmt::format("{}", fmt::join(lines, " ")), text);
    for (const std::string& line : lines) {
        EXPECT_LE(canvas.text_width_px(line, style), 120) << line;
    }
}

TEST(Canvas, ShortensTheLastLineAndLongWords)
{
    const Canvas canvas{{8, 8}, {}, default_font_folder};
    const TextStyle style{20, false, {}};
    const std::vector<std::string> lines =
        canvas.wrapped("a " + std::string(40, 'W') + " and more words than fit", style, 120, 3);
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0], "a");
    EXPECT_THAT(lines[1], testing::EndsWith("W..."));
    EXPECT_THAT(lines[2], testing::EndsWith("..."));
    for (const std::string& line : lines) {
        EXPECT_LE(canvas.text_width_px(line, style), 120) << line;
    }
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

} // namespace
} // namespace gnomon::reports
