// The tables of each method's page, docs/methods/NAME.md, are those of the layer:
// GNOMON_UPDATE_DOCUMENTS=1 writes them.

#include "methods/list.hpp"
#include "methods/refusal.hpp"
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

/// Of several filters, each a row.
std::string filters_table(const Method& method)
{
    std::string text = "| filter | verdict | compares | rises | curve | what it computes |\n"
                       "|---|---|---|---|---|---|\n";
    for (const FilterChoice& filter : method.filters) {
        const Promises promised = promises_with(method, filter.filter);
        text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n",
                            scene::filter_name(filter.filter), spaced(name(promised.verdict)),
                            spaced(name(promised.compares)), spaced(name(promised.rises.how)),
                            spaced(name(promised.curve)), filter.sentence);
    }
    return text;
}

/// Of a job of defaults.
std::string promises_table(const Method& method)
{
    constexpr double mebibyte = 1 << 20;
    scene::Job job;
    job.method.name = method.name;
    const Promises promised = method.promises(job);
    const std::string of_map =
        promised.has_map ? fmt::format("{0} × {0} texels | {1} | {2:g} MiB", promised.width_texels,
                                       spaced(name(promised.reads)),
                                       static_cast<double>(promised.map_bytes) / mebibyte)
                         : "no map | nothing | none";
    return fmt::format("| verdict | compares | rises | curve | footprint | reads | memory |\n"
                       "|---|---|---|---|---|---|---|\n"
                       "| {} | {} | {} | {} | {} |\n",
                       spaced(name(promised.verdict)), spaced(name(promised.compares)),
                       spaced(name(promised.rises.how)), spaced(name(promised.curve)), of_map);
}

std::string keys_table(const Method& method)
{
    std::string text = "| key | meaning | default | allowed | redone in a sweep |\n"
                       "|---|---|---|---|---|\n";
    for (const scene::HandedKey& own : method.keys) {
        const scene::JobKey key = own.row();
        text += fmt::format("| `{}` | {} | `{}` | {} | {} |\n", key.name, key.description,
                            key.default_text, key.range_text,
                            fmt::join(scene::stage_names(key.stages), ", "));
    }
    return text;
}

std::string bias_table(const Method& method)
{
    std::string text = "| term | keys | acts on | redone in a sweep | what it does |\n"
                       "|---|---|---|---|---|\n";
    for (const BiasTerm& term : method.bias_terms) {
        std::vector<std::string> keys;
        for (const scene::JobKey& key : keys_of(term)) {
            keys.push_back(fmt::format("`{}` [{}]", key.name, key.unit));
        }
        text += fmt::format("| {} | {} | {} | {} | {} |\n", term.name, fmt::join(keys, ", "),
                            refuses(method, term) ? "refused" : spaced(name(term.place)),
                            fmt::join(scene::stage_names(stages_of(term)), ", "), term.sentence);
    }
    return text;
}

std::string sources_list(const Method& method)
{
    std::string text;
    for (const Source& source : method.sources) {
        text += fmt::format("- {}, {}: *{}*.{}\n", source.authors, source.year, source.title,
                            source.about.empty() ? "" : fmt::format(" For {}.", source.about));
    }
    return text;
}

/// A block of a page, between markers of its name.
struct Block {
    std::string_view name;
    std::string text;
};

/// What a method's page must have.
std::vector<Block> blocks_of(const Method& method)
{
    std::vector<Block> blocks;
    blocks.push_back(method.filters.empty() ? Block{"promises", promises_table(method)}
                                            : Block{"filters", filters_table(method)});
    if (!method.keys.empty()) {
        blocks.push_back({"keys", keys_table(method)});
    }
    if (!method.bias_terms.empty()) {
        blocks.push_back({"bias terms", bias_table(method)});
    }
    blocks.push_back({"sources", sources_list(method)});
    return blocks;
}

/// The page with the block's text between its markers.
std::string with_block(std::string page, std::string_view file, const Block& block)
{
    const std::string begin = fmt::format("<!-- {}: generated -->\n", block.name);
    const auto start = page.find(begin);
    const auto end = page.find("<!-- end -->", start);
    if (start == std::string::npos || end == std::string::npos) {
        ADD_FAILURE() << file << " has no place for " << block.name;
        return page;
    }
    const auto from = start + begin.size();
    return page.replace(from, end - from, fmt::format("\n{}\n", block.text));
}

TEST(MethodPages, HaveTheTablesOfTheLayer)
{
    for (const Method& method : methods()) {
        const std::string file = fmt::format("{}/{}", GNOMON_ROOT, method.page);
        std::ostringstream written;
        written << std::ifstream{file}.rdbuf();
        std::string expected = written.str();
        for (const Block& block : blocks_of(method)) {
            expected = with_block(std::move(expected), method.page, block);
        }
        if (std::getenv("GNOMON_UPDATE_DOCUMENTS") != nullptr) {
            std::ofstream{file} << expected;
            continue;
        }
        EXPECT_EQ(written.str(), expected)
            << "GNOMON_UPDATE_DOCUMENTS=1 ./dev test -- -R methods_tests writes them anew";
    }
}

} // namespace
} // namespace gnomon::methods
