#include "reports/gate/gate_report.hpp"
#include "reports/gate/new_pixels_picture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace gnomon::reports {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string awkward = "100% a:b, c\r\n::error::x|<y>&\"z\"";

/// A report of `count` configurations of the named case, each with one broken rule.
GateReport broken_report(const std::string& case_name, std::size_t count = 1)
{
    GateReport report;
    report.baseline_file = "baseline.json";
    analysis::GateRule rule;
    rule.id = "few, 50%: yes";
    rule.metric = "false_lit";
    rule.allow_pixels = 0;
    report.rules = {rule};
    const auto entries = [&](double wrong) {
        analysis::GateEntries run;
        run.axes = {"bias.constant"};
        for (std::size_t i = 0; i < count; ++i) {
            run.entries.push_back({{case_name, {{"bias.constant", fmt::format("{}", i)}}},
                                   {},
                                   {{"false_lit", wrong}, {"pixels.total", 100}}});
        }
        (void)sort_entries(run);
        return run;
    };
    report.baseline = entries(1);
    report.run.results = entries(5);
    report.run.status.done = count;
    report.outcome = analysis::judge_run(report.baseline, report.run.results, report.rules);
    report.verdict = analysis::gate_verdict(report.outcome, report.rules, true);
    return report;
}

TEST(GithubOutput, EscapesWhatEndsACommand)
{
    EXPECT_EQ(github_message("100% a:b, c\r\nd"), "100%25 a:b, c%0D%0Ad");
    EXPECT_EQ(github_property("100% a:b, c\r\nd"), "100%25 a%3Ab%2C c%0D%0Ad");
    EXPECT_EQ(github_message("\x01\xFF"), "\uFFFD\uFFFD");
}

/// Decodes a text as a GitHub runner does: `%25`, `%0D`, `%0A`, `%3A` and `%2C`.
std::string github_read(std::string text)
{
    for (const auto& [code, c] :
         {std::pair{"%0D", "\r"}, {"%0A", "\n"}, {"%3A", ":"}, {"%2C", ","}, {"%25", "%"}}) {
        for (std::size_t at = text.find(code); at != std::string::npos; at = text.find(code, at)) {
            text.replace(at, 3, c);
            at += 1;
        }
    }
    return text;
}

TEST(GithubOutput, SurvivesTheRoundTrip)
{
    for (const std::string& text : {awkward, std::string{"%25%0A"}, std::string{"a%3Ab,%"}}) {
        EXPECT_EQ(github_read(github_property(text)), text);
        EXPECT_EQ(github_read(github_message(text)), text);
    }
}

TEST(GithubOutput, AnnotatesTheWorstTenWithALineEach)
{
    const std::string text = github_annotations(broken_report(awkward, 30));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = text.find('\n', begin);
        const std::string line = text.substr(begin, end - begin);
        EXPECT_THAT(line,
                    StartsWith("::error title=gnomon gate%2C 100%25 a%3Ab%2C c??%3A%3Aerror"));
        EXPECT_THAT(line, AllOf(HasSubstr("false_lit 1 -> 5 (+4), 0 allowed"),
                                HasSubstr("rule \"few, 50%25: yes\"")));
        begin = end + 1;
    }
}

TEST(GithubOutput, SummaryStaysBelowItsLimit)
{
    const GateReport report = broken_report(std::string(300, '|'), 2000);
    for (const std::size_t limit : {std::size_t{0}, std::size_t{300}, std::size_t{5000}}) {
        EXPECT_LE(github_summary(report, limit).size(), limit);
    }
    const std::string text = github_summary(report, 1'000'000);
    EXPECT_LE(text.size(), 1'000'000U);
    EXPECT_THAT(text, HasSubstr("left out here"));
    EXPECT_THAT(github_summary(broken_report("noon"), 1'000'000), Not(HasSubstr("left out")));
}

TEST(GithubOutput, SummaryHasNoCellTooMany)
{
    const std::string text = github_summary(broken_report(awkward), 100'000);
    const std::size_t row = text.find("| **fail** ");
    ASSERT_NE(row, std::string::npos) << text;
    std::size_t bars = 0;
    for (std::size_t i = row; text[i] != '\n'; ++i) {
        bars += text[i] == '|' && (i == 0 || text[i - 1] != '\\') ? 1U : 0U;
    }
    EXPECT_EQ(bars, 9U) << text;
    EXPECT_THAT(text, Not(HasSubstr("<y>")));
}

TEST(JunitOutput, EscapesWhatXmlForbids)
{
    EXPECT_EQ(xml_text("a<b>&\"c\n"), "a&#60;b&#62;&#38;&#34;c&#10;");
    EXPECT_EQ(xml_text(std::string{"\x00\x1B", 2}), "\uFFFD\uFFFD");
    EXPECT_EQ(xml_text("\xFF\xED\xA0\x80"), "\uFFFD\uFFFD\uFFFD\uFFFD");
    EXPECT_EQ(xml_text("\uFFFE\uFFFF\U0001F600"), "\uFFFD\uFFFD\U0001F600");
}

TEST(JunitOutput, CountsFailuresAndErrors)
{
    const std::string text = gate_junit(broken_report(awkward, 3));
    EXPECT_THAT(text, HasSubstr("tests=\"4\" failures=\"3\" errors=\"0\""));
    EXPECT_THAT(text, HasSubstr("<failure type=\"worse_than_baseline\" message=\"false_lit 1 -"));
    GateReport report = broken_report("noon");
    report.run.results.entries.clear();
    report.outcome = analysis::judge_run(report.baseline, report.run.results, report.rules);
    const std::string missing = gate_junit(report);
    EXPECT_THAT(missing, HasSubstr("<error type=\"missing\""));
    EXPECT_THAT(missing, HasSubstr("<error type=\"incomplete\""));
}

TEST(GateTable, SaysOfWhichPixelsAndWhere)
{
    GateReport report = broken_report("noon");
    analysis::GateFinding& finding = report.outcome.findings.front();
    finding.filter.object = "wall\x1b";
    finding.new_pixels = analysis::NewPixels{
        12, {{3, 4}, {5, 4}, {6, 4}, {7, 4}, {8, 4}}, {3, 4}, {9, 8}, std::nullopt};
    EXPECT_THAT(gate_table(report, GateDetail::all),
                AllOf(HasSubstr("of object wall?\n"),
                      HasSubstr("at (3, 4), (5, 4), (6, 4), (7, 4) and 8 more, from (3, 4) to "
                                "(9, 8)")));
}

/// A report of one configuration whose bias changed, which breaks many rules.
GateReport many_broken_rules()
{
    GateReport report;
    report.baseline_file = "baseline.json";
    report.rules = analysis::default_gate_rules();
    const auto entry = [](double wrong, const char* bias) {
        analysis::GateEntries run;
        std::map<std::string, double> metrics{{"pixels.total", 100}, {"scored_pixels", 90}};
        for (const analysis::GateRule& rule : analysis::default_gate_rules()) {
            if (rule.allow_share) {
                metrics.emplace(rule.metric, wrong);
            }
        }
        run.entries.push_back({{"noon", {}}, {{"bias.constant", bias}}, std::move(metrics)});
        return run;
    };
    report.baseline = entry(1, "0.01");
    report.run.results = entry(5, "0.5");
    report.run.status.done = 1;
    report.outcome = analysis::judge_run(report.baseline, report.run.results, report.rules);
    report.verdict = analysis::gate_verdict(report.outcome, report.rules, true);
    return report;
}

TEST(GateTable, NamesTheSuspectFirstInTenLinesAndListsAllOnRequest)
{
    const GateReport report = many_broken_rules();
    ASSERT_GT(report.outcome.findings.size(), 10U);
    const std::string brief = gate_table(report, GateDetail::worst);
    EXPECT_LE(std::count(brief.begin(), brief.end(), '\n'), 10) << brief;
    const std::size_t verdict_end = brief.find('\n');
    EXPECT_EQ(brief.find("first suspects: bias.constant: 0.01 -> 0.5"), verdict_end + 3) << brief;
    EXPECT_THAT(brief, HasSubstr(fmt::format("and {} more findings: --verbose lists them",
                                             report.outcome.findings.size() - 2)));
    const std::string all = gate_table(report, GateDetail::all);
    EXPECT_GT(std::count(all.begin(), all.end(), '\n'),
              static_cast<std::ptrdiff_t>(report.outcome.findings.size()));
    EXPECT_LT(all.find("first suspects"), all.find("false_shadow"));
    const std::string summary = github_summary(report, 100'000);
    EXPECT_LT(summary.find("First suspects: bias.constant: 0.01"), summary.find("| **fail**"));
}

TEST(GateTable, NamesTheWorstOfSeveralConfigurations)
{
    const std::string text = gate_table(broken_report("noon", 3), GateDetail::worst);
    EXPECT_THAT(text, HasSubstr("worst: noon, bias.constant = 0\n"));
    EXPECT_THAT(text, HasSubstr("and 2 more findings"));
}

NewPixelsPicture picture_of_marks(scene::ImageSize size)
{
    NewPixelsPicture picture;
    picture.title = "title";
    picture.lines = {"line"};
    picture.ground = store::RgbImage{size, {200, 200, 200}};
    picture.marks = scene::Image<PixelChange>{size};
    return picture;
}

std::size_t drawn_pixels(const store::RgbImage& image, store::Rgb colour)
{
    return static_cast<std::size_t>(std::count(image.begin(), image.end(), colour));
}

TEST(GatePage, BeginsWithTheVerdictAndTheWorstFinding)
{
    const std::string page = gate_page(broken_report(awkward, 2));
    EXPECT_THAT(page, HasSubstr("<span class=\"bad\">Regression.</span> false lit: 1 → 5</h1>"));
    EXPECT_THAT(page, HasSubstr("The job is unchanged"));
    EXPECT_THAT(page, HasSubstr("--baseline baseline.json --update changed"));
    // Names are shown as text.
    EXPECT_THAT(page, HasSubstr("::error::x|&lt;y&gt;&amp;"));
    EXPECT_THAT(page, Not(HasSubstr("<y>")));
    EXPECT_THAT(page, Not(HasSubstr("<script")));
}

TEST(GatePage, SaysThatTheGatePasses)
{
    GateReport report = broken_report("wall");
    report.outcome.findings.clear();
    report.verdict = analysis::GateVerdict::pass;
    EXPECT_THAT(gate_page(report),
                HasSubstr("<span class=\"good\">Pass.</span> Nothing is worse than the baseline"));
}

TEST(NewPixelsPicture, LosesNoNewPixelWhereItIsScaledDown)
{
    constexpr store::Rgb blue{0x00, 0x72, 0xB2};
    NewPixelsPicture picture = picture_of_marks({3000, 1200});
    picture.marks(2999, 1199) = PixelChange::new_false_lit;
    picture.marks(2998, 1199) = PixelChange::wrong_before;
    const std::size_t legend =
        drawn_pixels(draw_new_pixels_picture(picture_of_marks({3000, 1200})), blue);
    // A few pixels are dots: 7×7 in the whole image, 8×8 in the magnified part.
    EXPECT_EQ(drawn_pixels(draw_new_pixels_picture(picture), blue), legend + 49 + 64);
    // Many pixels are one panel pixel each; the magnified part shows others.
    for (int x = 0; x < 250; ++x) {
        picture.marks(x, 0) = PixelChange::new_false_shadow;
    }
    EXPECT_EQ(drawn_pixels(draw_new_pixels_picture(picture), blue), legend + 1);
}

TEST(NewPixelsPicture, DrawsTheSmallestImage)
{
    NewPixelsPicture picture = picture_of_marks({1, 1});
    picture.marks(0, 0) = PixelChange::new_false_shadow;
    EXPECT_GT(drawn_pixels(draw_new_pixels_picture(picture), {0xD5, 0x5E, 0x00}), 400U * 400U);
}

} // namespace
} // namespace gnomon::reports
