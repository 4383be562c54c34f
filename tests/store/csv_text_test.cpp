#include "store/csv/csv_text.hpp"

#include "csv_table.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

namespace gnomon::store {
namespace {

std::string cell(std::string_view text)
{
    std::string out;
    append_csv_text(out, text);
    return out;
}

std::string cell(double number)
{
    std::string out;
    append_csv_number(out, number);
    return out;
}

TEST(CsvText, StandsAsItIsWhereItCan)
{
    for (const char* const text : {"", "noon", "two words", "a;b", "it's", "größer"}) {
        EXPECT_EQ(cell(text), text);
    }
}

TEST(CsvText, IsQuotedWhereItHoldsCommasQuotesOrEndsOfLines)
{
    EXPECT_EQ(cell("[0, 1]"), "\"[0, 1]\"");
    EXPECT_EQ(cell("say \"hi\""), "\"say \"\"hi\"\"\"");
    EXPECT_EQ(cell("a\nb"), "\"a\nb\"");
    EXPECT_EQ(cell("a\r\nb"), "\"a\r\nb\"");
}

TEST(CsvText, IsNoFormula)
{
    EXPECT_EQ(cell("=1+1"), "'=1+1");
    EXPECT_EQ(cell("+1"), "'+1");
    EXPECT_EQ(cell("-1"), "'-1");
    EXPECT_EQ(cell("@x"), "'@x");
    EXPECT_EQ(cell("\tx"), "'\tx");
    EXPECT_EQ(cell("\r=x"), "\"'\r=x\"");
    EXPECT_EQ(cell("=HYPERLINK(\"a\",\"b\")"), "\"'=HYPERLINK(\"\"a\"\",\"\"b\"\")\"");
    EXPECT_EQ(cell("a=1"), "a=1");
}

TEST(CsvText, ReplacesWhatIsNoUtf8AndControlCharacters)
{
    EXPECT_EQ(cell("a\xFF"
                   "b"),
              "a\uFFFD"
              "b");
    EXPECT_EQ(cell(std::string_view{"a\0b", 3}), "a\uFFFD"
                                                 "b");
    EXPECT_EQ(cell("\x1B[31m"), "\uFFFD[31m");
    EXPECT_EQ(cell("\xC0\xAF"), "\uFFFD\uFFFD");                     // overlong
    EXPECT_EQ(cell("\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD");           // a surrogate
    EXPECT_EQ(cell("\xF4\x90\x80\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD"); // beyond U+10FFFF
    EXPECT_EQ(cell("\xE2\x82"), "\uFFFD\uFFFD");                     // cut off
    EXPECT_EQ(cell("\U0001F313"), "\U0001F313");
}

TEST(CsvNumber, IsTheShortestThatReadsBack)
{
    EXPECT_EQ(cell(0.0), "0");
    EXPECT_EQ(cell(1.0), "1");
    EXPECT_EQ(cell(-0.5), "-0.5");
    EXPECT_EQ(cell(0.1), "0.1");
    EXPECT_EQ(cell(double{0.1F}), "0.10000000149011612");
    EXPECT_EQ(cell(1e-6), "1e-06");
    EXPECT_EQ(cell(-std::numeric_limits<double>::min()), "-2.2250738585072014e-308");
    EXPECT_EQ(cell(std::numeric_limits<double>::denorm_min()), "5e-324");
}

RC_GTEST_PROP(CsvNumber, ReadsBackAsTheSameDouble, (std::uint64_t bits))
{
    double number = 0;
    std::memcpy(&number, &bits, sizeof number);
    RC_PRE(std::isfinite(number));
    const std::string text = cell(number);
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    RC_ASSERT(back == number);
}

RC_GTEST_PROP(CsvText, ReadsBackAsItWas, ())
{
    const std::string any =
        *rc::gen::container<std::string>(rc::gen::elementOf(std::string{"ab ,\"'\n\r\t=+-@"}));
    const std::string text = "a" + any; // no formula
    RC_ASSERT(parse_csv(cell(text) + '\n').columns.at(0) == text);
}

} // namespace
} // namespace gnomon::store
