#include "reports/page/page_html.hpp"

#include "reports/page/run_overview.hpp"

#include "example_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>

namespace gnomon::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(PageHtml, ShowsAnyTextAsItself)
{
    EXPECT_EQ(escaped("<a href=\"x\">'&"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;");
    const nlohmann::ordered_json data{{"name", hostile_text}, {"bytes", "\xff</script"}};
    const std::string page = whole_page(hostile_text, "<body>", data, {});
    // Only the page's own script elements end.
    std::size_t ends = 0;
    for (std::size_t at = page.find("</script"); at != std::string::npos;
         at = page.find("</script", at + 1)) {
        ++ends;
    }
    EXPECT_EQ(ends, 3U);
    EXPECT_THAT(page, Not(HasSubstr("<img")));
    EXPECT_EQ(ReadPage{page}.data().at("name"), hostile_text);
}

TEST(PageHtml, AllowsItsOwnStyleAndScriptsAlone)
{
    const std::string page = whole_page("t", "<body>", {}, {});
    EXPECT_THAT(page, HasSubstr("content=\"default-src 'none'; script-src 'sha256-"));
    EXPECT_THAT(page, Not(HasSubstr("unsafe")));
    EXPECT_THAT(page, Not(HasSubstr("http://")));
}

TEST(MarkdownText, HasNoMarkup)
{
    EXPECT_EQ(markdown_text("a_b|c"), "a\\_b\\|c");
    EXPECT_EQ(markdown_text("<b>"), "\\<b\\>");
    EXPECT_EQ(markdown_text("two\nlines"), "two lines");
    EXPECT_EQ(markdown_text("@me http://x: y"), "&#64;me http&#58;//x: y");
    EXPECT_EQ(markdown_text(std::string(1001, 'x')), std::string(1000, 'x') + "…");
    EXPECT_EQ(markdown_text(std::string(990, 'x') + " a longer word"),
              std::string(990, 'x') + " a longer…");
}

} // namespace
} // namespace gnomon::reports
