#include "scene/error.hpp"
#include "store/output_name.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::store {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

void expect_refusal(const char* path, OutputKind kind, const char* text)
{
    EXPECT_THAT([&] { require_output_name(path, kind); },
                ThrowsMessage<scene::InputError>(HasSubstr(text)))
        << path;
}

TEST(OutputName, MayHaveTheEndingOfWhatIsWritten)
{
    EXPECT_NO_THROW(require_output_name("a.png", OutputKind::picture));
    EXPECT_NO_THROW(require_output_name("a.b.exr", OutputKind::layers));
    EXPECT_NO_THROW(require_output_name("a.svg", OutputKind::plot));
    EXPECT_NO_THROW(require_output_name("a.png", OutputKind::plot));
    EXPECT_NO_THROW(require_output_name("a.pdf", OutputKind::figure));
    EXPECT_NO_THROW(require_output_name("a.toml", OutputKind::job));
}

TEST(OutputName, MayHaveNoEndingWhereTheFormatDoesNotDependOnIt)
{
    for (const OutputKind kind : {OutputKind::picture, OutputKind::layers, OutputKind::csv,
                                  OutputKind::junit, OutputKind::baseline, OutputKind::job}) {
        EXPECT_NO_THROW(require_output_name("/dev/stdout", kind));
    }
    expect_refusal("/dev/stdout", OutputKind::plot,
                   "/dev/stdout: a plot is written as .svg or .png");
    expect_refusal("a", OutputKind::figure, "a: a figure is written as .pdf, .svg or .png");
}

TEST(OutputName, OfATextMayHaveAnyEndingThatIsNoOthers)
{
    EXPECT_NO_THROW(require_output_name("a.txt", OutputKind::csv));
    EXPECT_NO_THROW(require_output_name("a.v2", OutputKind::baseline));
    expect_refusal("a.png", OutputKind::csv, "a.png: a table is written as .csv; name it so");
    expect_refusal("a.toml", OutputKind::baseline, "a.toml: a baseline is written as .json");
    expect_refusal("a.json", OutputKind::junit, "a.json: a JUnit report is written as .xml");
    expect_refusal("model.glb", OutputKind::csv, "is written as .csv");
}

TEST(OutputName, OfAnImageMayHaveNoOtherEnding)
{
    expect_refusal("x.jpg", OutputKind::picture, "x.jpg: a picture is written as .png; name it so");
    expect_refusal("x.exr", OutputKind::picture, "is written as .png");
    expect_refusal("x.png", OutputKind::layers, "x.png: an image of numbers is written as .exr");
    expect_refusal("x.unknown", OutputKind::layers, "is written as .exr");
    expect_refusal("x.json", OutputKind::job, "x.json: a job file is written as .toml");
}

} // namespace
} // namespace gnomon::store
