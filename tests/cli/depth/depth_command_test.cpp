#include "child_process.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <set>
#include <utility>

namespace gnomon::testing {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

Json depth_json(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "depth");
    arguments.emplace_back("--json");
    const Ending ending = gnomon(arguments);
    expect_done(ending);
    return Json::parse(ending.out);
}

const std::vector<std::string> no_gl{"__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent"};

TEST(DepthCommand, HasTheFormulasLargestErrorOfTheLesson)
{
    const Json json = depth_json({"--near", "4", "--far", "50", "--bits", "8", "--theory-only"});
    EXPECT_NEAR(json.at("theory").at("max_error_m").get<double>(), 1.10259, 5e-6);
    EXPECT_NEAR(json.at("theory").at("envelope_at_far_m").get<double>(), 1.1535, 5e-5);
    EXPECT_TRUE(json.at("measured").is_null());
    EXPECT_EQ(json.at("not_measured_because"), "--theory-only");
}

TEST(DepthCommand, MeasuresBesideTheFormula)
{
    const Json json = depth_json({"--near", "4", "--far", "50", "--bits", "16", "--projection",
                                  "perspective", "--samples", "5000"});
    EXPECT_EQ(json.at("format"), "d16");
    const Json& measured = json.at("measured");
    EXPECT_EQ(measured.at("samples"), 5000);
    EXPECT_EQ(json.at("samples").size(), 5000U);
    EXPECT_EQ(measured.at("certificate").at("outside"), 0);
    // The last tooth has 200 samples: the largest lies within 1 % of its tip.
    const double theory_m = json.at("theory").at("max_error_m").get<double>();
    EXPECT_NEAR(measured.at("max_error_m").get<double>(), theory_m, 0.05 * theory_m);
    EXPECT_GT(measured.at("rms_error_m").get<double>(), 0);
    for (const Json& sample : json.at("samples")) {
        const double error_m = sample.at("error_m").get<double>();
        ASSERT_LE(std::abs(error_m), sample.at("model_m").get<double>()) << sample;
        // Two numbers near 50, printed with 16 digits.
        ASSERT_NEAR(sample.at("stored_zeta_m").get<double>() - sample.at("zeta_m").get<double>(),
                    error_m, 1e-13);
    }
}

TEST(DepthCommand, KnowsEveryFormatAndWidth)
{
    for (const char* format : {"d16", "d24", "d32f", "r32f", "r16f", "rgba8", "u8", "u13", "u24"}) {
        EXPECT_EQ(depth_json({"--format", format, "--samples", "16"}).at("format"), format);
    }
    EXPECT_EQ(depth_json({"--bits", "12", "--samples", "16"}).at("format"), "u12");
    for (const char* bits : {"25", "28", "31"}) {
        const Json json = depth_json({"--bits", bits, "--samples", "16"});
        EXPECT_TRUE(json.at("measured").is_null()) << bits;
        EXPECT_EQ(json.at("samples").size(), 16U);
    }
}

TEST(DepthCommand, MeasuresDistances)
{
    for (const char* format : {"d16", "d32f", "r16f", "rgba8", "u8"}) {
        const Json json =
            depth_json({"--content", "distance", "--format", format, "--samples", "2000"});
        EXPECT_EQ(json.at("content"), "distance");
        EXPECT_EQ(json.at("frustum").at("near_m"), 4);
        EXPECT_TRUE(json.at("theory").at("transform_error_at_far_m").at("premultiplied").is_null());
        EXPECT_EQ(json.at("measured").at("certificate").at("outside"), 0) << format;
        for (const Json& sample : json.at("samples")) {
            // One division, and far is a float32.
            ASSERT_NEAR(sample.at("depth").get<double>(), sample.at("zeta_m").get<double>() / 50,
                        1e-15);
            ASSERT_LE(std::abs(sample.at("error_m").get<double>()),
                      sample.at("model_m").get<double>())
                << format << sample;
        }
    }
}

TEST(DepthCommand, TellsFormulasOfDistancesWithoutGl)
{
    const Json json = depth_json({"--content", "distance", "--format", "rgba8", "--theory-only"});
    EXPECT_EQ(json.at("spacing"), "packed");
    // Half a step of eight bits over 50 m, refined by the other bytes.
    EXPECT_NEAR(json.at("theory").at("max_error_m").get<double>(), 50 / 510.0, 0.02 * 50 / 510);
    const Ending table =
        gnomon({"depth", "--content", "distance", "--format", "r16f", "--theory-only"});
    expect_done(table);
    EXPECT_THAT(table.out, HasSubstr("distance over far, near 4 m, far 50 m"));
    EXPECT_THAT(table.out, HasSubstr("r [m]"));
}

TEST(DepthCommand, TakesReversalClipTiltAndOffset)
{
    const Json json = depth_json({"--format", "d32f", "--reversed", "--tilt-deg", "30", "--offset",
                                  "100", "--projection", "orthographic", "--samples", "64"});
    EXPECT_EQ(json.at("frustum").at("clip_range"), "zero_to_one");
    EXPECT_EQ(json.at("frustum").at("reversed"), true);
    EXPECT_EQ(json.at("offset_m"), 100);
    EXPECT_NEAR(json.at("tilt_deg").get<double>(), 30, 1e-12);
    const Json other = depth_json({"--clip", "zero_to_one", "--samples", "64"});
    EXPECT_EQ(other.at("frustum").at("clip_range"), "zero_to_one");
    EXPECT_EQ(other.at("frustum").at("reversed"), false);
}

TEST(DepthCommand, WritesCsvToAFileOrToStandardOutput)
{
    const TemporaryFolder folder;
    const std::string path = folder.path() / "depth.csv";
    const Ending printed = gnomon({"depth", "--samples", "8", "--csv"});
    expect_done(printed);
    EXPECT_THAT(printed.out, StartsWith("zeta_m,depth,envelope_m,"));
    EXPECT_EQ(std::count(printed.out.begin(), printed.out.end(), '\n'), 9);
    expect_done(gnomon({"depth", "--samples", "8", "--csv", path}));
    EXPECT_EQ(text_of(path), printed.out);
}

TEST(DepthCommand, DrawsSvgAndPng)
{
    const TemporaryFolder folder;
    for (const char* name : {"plot.svg", "plot.png"}) {
        const std::string path = folder.path() / name;
        expect_done(gnomon({"depth", "--bits", "8", "--samples", "64", "--plot", path}));
        EXPECT_GT(std::filesystem::file_size(path), 10000U) << name;
    }
    const std::string svg = text_of(folder.path() / "plot.svg");
    EXPECT_THAT(svg, HasSubstr("|error of z| [m]"));
    EXPECT_THAT(svg, HasSubstr("Depth error of u8"));
}

// The lesson's: near 4, far 50, 32 bits; ζ = √(2T(2^32 − 1)/0.23) = 19.3255 m.
TEST(DepthCommand, HoldsAConstantToleranceAgainstTheSawtooth)
{
    const TemporaryFolder folder;
    const std::vector<std::string> asked{"--bits",        "32",        "--tolerance", "1e-8",
                                         "--theory-only", "--samples", "16"};
    const Json tolerance = depth_json(asked).at("tolerance");
    EXPECT_EQ(tolerance.at("tolerance_m"), 1e-8);
    EXPECT_NEAR(tolerance.at("exceeded_from_m").get<double>(), 19.3255, 1e-4);
    EXPECT_TRUE(depth_json({"--bits", "16", "--theory-only"}).at("tolerance").is_null());

    const std::string plot = folder.path() / "plot.svg";
    const std::string csv = folder.path() / "depth.csv";
    std::vector<std::string> arguments{"depth", "--plot", plot, "--csv", csv};
    arguments.insert(arguments.end(), asked.begin(), asked.end());
    const Ending table = gnomon(arguments);
    expect_done(table);
    EXPECT_THAT(table.out, HasSubstr("less than the envelope from 19.33 m on"));
    EXPECT_THAT(text_of(plot), HasSubstr("tolerance 1e-08 m"));
    EXPECT_THAT(text_of(csv), HasSubstr("class,tolerance_m\n"));
    EXPECT_THAT(text_of(csv), HasSubstr(",1e-08\n"));
    // 16 spread evenly, and 129 at each of three places; near and far are in both.
    const std::string rows = text_of(csv);
    EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 16 + 3 * 129 - 2);

    EXPECT_THAT(gnomon({"depth", "--format", "d16", "--tolerance", "1", "--samples", "8"}).out,
                HasSubstr("1 m: more than the envelope at every distance"));
    EXPECT_THAT(gnomon({"depth", "--format", "d16", "--tolerance", "1e-9", "--samples", "8"}).out,
                HasSubstr("less than the envelope from near on"));
}

TEST(DepthCommand, PlansANearPlane)
{
    const Json json = depth_json({"--plan", "--max-error-m", "0.01", "--far", "200"});
    ASSERT_EQ(json.at("answers").size(), 4U);
    for (const Json& answer : json.at("answers")) {
        EXPECT_EQ(answer.at("meets_target"), true);
        // Measure the recommended setting.
        std::vector<std::string> arguments{
            "--near",   answer.at("near_m").dump(), "--far",     "200",
            "--format", answer.at("format"),        "--samples", "4096"};
        if (answer.at("reversed").get<bool>()) {
            arguments.emplace_back("--reversed");
        }
        EXPECT_LE(depth_json(arguments).at("measured").at("max_error_m").get<double>(), 0.01)
            << answer;
    }
}

TEST(DepthCommand, ComparesAllFormats)
{
    const Json json = depth_json({"--compare", "--samples", "64"});
    EXPECT_EQ(json.at("formats").size(), 25U);
    for (const Json& format : json.at("formats")) {
        EXPECT_EQ(format.at("tilt_deg"), 0);
        EXPECT_EQ(format.at("offset_m"), 0);
    }
    const Ending text = gnomon({"depth", "--compare", "--theory-only"});
    expect_done(text);
    EXPECT_THAT(text.out, HasSubstr("d32f reversed"));
    EXPECT_THAT(text.out, HasSubstr("largest step"));
    const Json moved = depth_json(
        {"--compare", "--samples", "64", "--tilt-deg", "30", "--offset", "8", "--theory-only"});
    EXPECT_NEAR(moved.at("formats").at(0).at("tilt_deg").get<double>(), 30, 1e-12);
    EXPECT_EQ(moved.at("formats").at(24).at("offset_m"), 8);
}

TEST(DepthCommand, StatesTheLargestStepOfReversedFloatsWhereItIs)
{
    // At far the floats near 0 are 2^-149 apart, less than any step of a distance.
    const std::vector<std::string> arguments{"--format", "d32f", "--reversed", "--theory-only"};
    const Json theory = depth_json(arguments).at("theory");
    EXPECT_LT(theory.at("step_at_far_m"), 1e-40);
    EXPECT_NEAR(theory.at("largest_step_m").get<double>(), 1.4502e-6, 1e-10);
    EXPECT_NEAR(theory.at("coarsest_at_m").get<double>(), 29.09, 0.005);
    const Ending text = gnomon({"depth", "--format", "d32f", "--reversed", "--theory-only"});
    EXPECT_THAT(text.out, HasSubstr("at most 1.45e-06 m at 29.09 m"));
    EXPECT_THAT(text.out, Not(HasSubstr("e-43 m")));
}

TEST(DepthCommand, NeedsGlOnlyToMeasure)
{
    Start start;
    start.environment = no_gl;
    expect_refused(gnomon({"depth", "--bits", "16"}, start), 4, "no OpenGL 4.5 context");
    expect_done(gnomon({"depth", "--bits", "16", "--theory-only"}, start));
    expect_done(gnomon({"depth", "--bits", "27"}, start));
    expect_done(gnomon({"depth", "--plan", "--max-error-m", "0.1", "--far", "10"}, start));
}

TEST(DepthCommand, RefusesWhatMakesNoSense)
{
    const auto refused = [](std::vector<std::string> arguments, const std::string& text) {
        arguments.insert(arguments.begin(), "depth");
        expect_refused(gnomon(arguments), 2, text);
    };
    refused({"--near", "5", "--far", "4"}, "near must be below far");
    refused({"--near", "0"}, "must be at least 1e-12 of far");
    refused({"--near", "nan"}, "near must be below far");
    refused({"--far", "1e16"}, "near must be below far");
    refused({"--bits", "7"}, "8 to 32");
    refused({"--format", "d17"}, "no such format");
    refused({"--format", "d24", "--bits", "24"}, "excludes");
    refused({"--content", "colour"}, "--content");
    refused({"--content", "distance", "--reversed"},
            "content = \"distance\" is a distance from a positional");
    refused({"--content", "distance", "--projection", "orthographic"}, "projection");
    refused({"--content", "distance", "--clip", "zero_to_one"}, "clip");
    refused({"--content", "distance", "--plan", "--max-error-m", "1", "--far", "9"}, "--plan");
    refused({"--projection", "fisheye"}, "--projection");
    refused({"--samples", "1"}, "samples = 1");
    refused({"--samples", "10000000"}, "samples = 10000000: must be 2 to 4194304");
    refused({"--near", "1.0000001", "--far", "1.00000009"}, "near = 1.0000001, far = 1.00000009:");
    refused({"--near", "1", "--far", "1.0000001"},
            "near = 1, far = 1.0000001: in float32 no plane fits between them");
    refused({"--tilt-deg", "81"}, "tilt = 81 deg: must be 0 to 80");
    refused({"--tilt-deg", "nan", "--theory-only"}, "tilt = nan deg: must be 0 to 80");
    refused({"--tilt-deg", "80", "--near", "49"},
            "a tilt of 80 deg and an offset of 0 m; widen the range, or");
    refused({"--offset", "1e30"}, "offset = 1e+30: must be within ±1e+15 m");
    refused({"--offset", "nan"}, "offset = nan: must be within");
    refused({"--offset", "1e12"}, "an offset of 1e+12 m");
    refused({"--plan"}, "--max-error-m and --far");
    refused({"--plan", "--max-error-m", "1", "--far", "9", "--offset", "3"}, "remove --offset");
    refused({"--plan", "--max-error-m", "1", "--far", "9", "--reversed"}, "--reversed");
    refused({"--plan", "--max-error-m", "-1", "--far", "9"}, "above 0");
    refused({"--max-error-m", "1"}, "needs --plan");
    refused({"--compare", "--bits", "16"}, "remove --bits");
    refused({"--json", "--csv"}, "name a file");
    refused({"--compare", "--tolerance", "1"}, "remove --bits");
    refused({"--tolerance", "0"}, "tolerance = 0: must be 1e-15 to 1e+15 m");
    refused({"--tolerance", "nan"}, "tolerance = nan: must be");
    refused({"--plot", "x.jpg"}, ".svg or .png");
}

TEST(Doctor, CertifiesDepthInEveryRange)
{
    const Ending ending = gnomon({"doctor", "--depth", "--json"});
    expect_done(ending);
    const Json certificate = Json::parse(ending.out).at("depth_certificate");
    std::set<std::pair<std::string, bool>> directions;
    for (const Json& range : certificate.at("ranges")) {
        const Json& frustum = range.at("frustum");
        directions.emplace(frustum.at("clip_range"), frustum.at("reversed"));
        EXPECT_GE(range.at("formats").size(), 6U) << frustum;
        for (const auto& [name, format] : range.at("formats").items()) {
            for (const char* triangles : {"large", "small"}) {
                const Json& texels = format.at(triangles);
                EXPECT_EQ(texels.at("outside"), 0) << frustum << name << " " << triangles;
                EXPECT_LE(texels.at("largest_share_of_bound"), 1)
                    << frustum << name << " " << triangles;
                EXPECT_GT(texels.at("texels"), 10000) << frustum << name << " " << triangles;
            }
        }
    }
    EXPECT_EQ(directions,
              (std::set<std::pair<std::string, bool>>{
                  {"minus_one_to_one", false}, {"zero_to_one", false}, {"zero_to_one", true}}));
    for (const auto& [name, units] : certificate.at("offset_units").items()) {
        EXPECT_EQ(units.size(), 6U) << name;
    }
}

TEST(Doctor, PrintsTheCertificateIfAskedFor)
{
    const std::string text = gnomon({"doctor", "--depth"}).out;
    EXPECT_THAT(text, HasSubstr("near 0.1 m, far 1000 m, clip [0, 1], reversed"));
    EXPECT_THAT(text, HasSubstr("polygon offset"));
    EXPECT_FALSE(Json::parse(gnomon({"doctor", "--json"}).out).contains("depth_certificate"));
}

} // namespace
} // namespace gnomon::testing
