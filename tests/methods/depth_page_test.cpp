// The tables of docs/methods/depth.md are those of the layer: GNOMON_UPDATE_DOCUMENTS=1 writes
// them.

#include "methods/depth/bias_terms.hpp"
#include "methods/depth/depth_map.hpp"
#include "methods/depth/filters.hpp"
#include "scene/job/stage_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::methods {
namespace {

/// "each tap" of "each_tap".
std::string spaced(std::string_view name)
{
    std::string text{name};
    std::ranges::replace(text, '_', ' ');
    return text;
}

std::string filters_table()
{
    std::string text = "| filter | verdict | compares | rises | curve | what it computes |\n"
                       "|---|---|---|---|---|---|\n";
    for (const FilterPromises& filter : filters()) {
        const Promises promised = promises_with(depth_map(), filter.filter);
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n",
                            scene::filter_name(filter.filter), spaced(name(promised.verdict)),
                            spaced(name(promised.compares)), spaced(name(promised.rises.how)),
                            spaced(name(promised.curve)), filter.sentence);
    }
    return text;
}

std::string bias_table()
{
    std::string text = "| term | keys | acts on | redone in a sweep | what it does |\n"
                       "|---|---|---|---|---|\n";
    for (const BiasTerm& term : bias_terms()) {
        std::vector<std::string> keys;
        for (const scene::JobKey& key : keys_of(term)) {
            keys.push_back(fmt::format("`{}` [{}]", key.name, key.unit));
        }
        text += fmt::format("| {} | {} | {} | {} | {} |\n", term.name, fmt::join(keys, ", "),
                            spaced(name(term.place)),
                            fmt::join(scene::stage_names(stages_of(term)), ", "), term.sentence);
    }
    return text;
}

std::string sources_list()
{
    std::string text;
    for (const Source& source : depth_map().sources) {
        text += fmt::format("- {}, {}: *{}*.{}\n", source.authors, source.year, source.title,
                            source.about.empty() ? "" : fmt::format(" For {}.", source.about));
    }
    return text;
}

/// The page with this text between the markers of that name.
std::string with_block(std::string page, std::string_view block, std::string_view text)
{
    const std::string begin = fmt::format("<!-- {}: generated -->\n", block);
    const auto start = page.find(begin);
    const auto end = page.find("<!-- end -->", start);
    if (start == std::string::npos || end == std::string::npos) {
        ADD_FAILURE() << "docs/methods/depth.md has no place for " << block;
        return page;
    }
    const auto from = start + begin.size();
    return page.replace(from, end - from, fmt::format("\n{}\n", text));
}

TEST(DepthPage, HasTheTablesOfTheLayer)
{
    const std::string file = GNOMON_ROOT "/docs/methods/depth.md";
    std::ostringstream written;
    written << std::ifstream{file}.rdbuf();
    std::string expected = with_block(written.str(), "filters", filters_table());
    expected = with_block(std::move(expected), "bias terms", bias_table());
    expected = with_block(std::move(expected), "sources", sources_list());
    if (std::getenv("GNOMON_UPDATE_DOCUMENTS") != nullptr) {
        std::ofstream{file} << expected;
        return;
    }
    EXPECT_EQ(written.str(), expected)
        << "GNOMON_UPDATE_DOCUMENTS=1 ./dev test -- -R methods_tests writes them anew";
}

} // namespace
} // namespace gnomon::methods
