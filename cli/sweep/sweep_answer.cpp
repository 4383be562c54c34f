#include "cli/sweep/sweep_answer.hpp"

#include "reports/page/run_overview.hpp"
#include "reports/text/text.hpp"
#include "reports/text/tones.hpp"
#include "store/run/run_reader.hpp"
#include "store/shell_text.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>
#include <vector>

namespace gnomon::cli {
namespace {

using reports::OverviewRow;
using reports::Tone;

/// "  best: 0.401 % wrong (1,753 px false shadow, 359 px false lit), bias.slope = 1"
std::string line_of(std::string_view rank, const OverviewRow& row)
{
    const store::ResultRow& result = row.result;
    return fmt::format("  {}: {} wrong ({} px false shadow, {} px false lit){}{}", rank,
                       reports::percent(result.number("error_rate")),
                       reports::grouped(result.count("false_shadow")),
                       reports::grouped(result.count("false_lit")),
                       row.settings.empty() ? "" : ", ", row.settings);
}

std::string lines_of(const store::RunReader& run, const std::string& group, bool in_colour)
{
    const auto shown = [in_colour](const std::string& line, Tone tone) {
        return (in_colour ? reports::toned(line, tone) : line) + "\n";
    };
    const std::vector<OverviewRow> ends = reports::best_and_worst(run, group);
    if (ends.empty()) {
        return {};
    }
    if (ends.size() == 1) {
        return shown(line_of("all", ends.front()), Tone::plain);
    }
    return shown(line_of("best", ends.front()), Tone::good) +
           shown(line_of("worst", ends.back()), Tone::bad);
}

} // namespace

std::string sweep_answer(const std::filesystem::path& folder, bool in_colour)
{
    constexpr std::size_t most_groups = 3;
    const store::RunReader run{folder};
    const std::vector<std::string> groups = reports::comparable_groups(run);
    std::string text;
    for (std::size_t i = 0; i < groups.size() && i < most_groups; ++i) {
        text += lines_of(run, groups[i], in_colour);
    }
    if (text.empty()) {
        return text;
    }
    if (groups.size() > most_groups) {
        text += fmt::format("  and {} more\n",
                            reports::counted(groups.size() - most_groups,
                                             run.description().lights.empty() ? "case" : "light"));
    }
    const std::string next = fmt::format("`{}` makes a page of all of them.",
                                         store::shell_text({"gnomon", "report", folder.string()}));
    return text + (in_colour ? reports::toned(next, Tone::dim) : next) + "\n";
}

} // namespace gnomon::cli
