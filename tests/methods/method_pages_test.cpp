// Checks the generated tables of docs/methods/NAME.md. GNOMON_UPDATE_DOCUMENTS=1 writes them.

#include "methods/job_method.hpp"
#include "methods/key_table.hpp"
#include "methods/list.hpp"
#include "methods/refusal.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"

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

/// A table with a row per filter; for methods with several.
std::string filters_table(const Method& method)
{
    std::string text = "| filter | verdict | compares | rises | curve | what it computes |\n"
                       "|---|---|---|---|---|---|\n";
    for (const FilterChoice& filter : method.filters) {
        const LookupTraits promised = traits_with(method, filter.filter);
        text += fmt::format(
            "| `{}` | {} | {} | {} | {} | {} |\n", scene::filter_name(filter.filter),
            spaced(name(promised.verdict)), spaced(name(promised.compares)),
            spaced(name(promised.monotonicity.how)), spaced(name(promised.curve)), filter.sentence);
    }
    return text;
}

/// The traits of a default job.
std::string traits_table(const Method& method)
{
    constexpr double mebibyte = 1 << 20;
    scene::Job job;
    job.keys = methods::key_table();
    job.method.name = method.name;
    const LookupTraits promised = method.traits(job);
    const std::string of_map =
        promised.has_map ? fmt::format("{0} × {0} texels | {1} | {2:g} MiB", promised.width_texels,
                                       spaced(name(promised.reads)),
                                       static_cast<double>(promised.map_bytes) / mebibyte)
                         : "no map | nothing | none";
    return fmt::format("| verdict | compares | rises | curve | footprint | reads | memory |\n"
                       "|---|---|---|---|---|---|---|\n"
                       "| {} | {} | {} | {} | {} |\n",
                       spaced(name(promised.verdict)), spaced(name(promised.compares)),
                       spaced(name(promised.monotonicity.how)), spaced(name(promised.curve)),
                       of_map);
}

std::string keys_table(const Method& method)
{
    std::string text = "| key | meaning | default | allowed | redone in a sweep |\n"
                       "|---|---|---|---|---|\n";
    for (const scene::Key& key : method.keys) {
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
        for (const scene::Key& key : keys_of(term)) {
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

/// A block of a page, between markers with its name.
struct Block {
    std::string_view name;
    std::string text;
};

/// The generated blocks of a method's page.
std::vector<Block> blocks_of(const Method& method)
{
    std::vector<Block> blocks;
    blocks.push_back(method.filters.empty() ? Block{"promises", traits_table(method)}
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

/// Checks a page's blocks, or writes them.
void expect_blocks(std::string_view page, const std::vector<Block>& blocks)
{
    const std::string file = fmt::format("{}/{}", GNOMON_ROOT, page);
    std::ostringstream written;
    written << std::ifstream{file}.rdbuf();
    std::string expected = written.str();
    for (const Block& block : blocks) {
        expected = with_block(std::move(expected), page, block);
    }
    if (std::getenv("GNOMON_UPDATE_DOCUMENTS") != nullptr) {
        std::ofstream{file} << expected;
        return;
    }
    EXPECT_EQ(written.str(), expected)
        << "GNOMON_UPDATE_DOCUMENTS=1 ./dev test -- -R methods_tests writes them anew";
}

TEST(MethodPages, HaveTheTablesOfTheLayer)
{
    for (const Method& method : methods()) {
        expect_blocks(method.page, blocks_of(method));
    }
}

std::string_view text_of(scene::TriedUnit unit)
{
    switch (unit) {
    case scene::TriedUnit::of_key:
        return "";
    case scene::TriedUnit::scene_diagonals:
        return " of the scene's diagonal";
    case scene::TriedUnit::texel_widths:
        return " of a texel's width at the median receiver";
    }
    return {};
}

/// "all with bias terms" of a key that every one of them has.
std::string methods_with(const scene::Key& key)
{
    const auto has_terms = [](const Method& method) { return !method.bias_terms.empty(); };
    return key.name.starts_with("bias.") &&
                   std::ssize(key.methods.value()) == std::ranges::count_if(methods(), has_terms)
               ? "all with bias terms"
               : fmt::format("`{}`", fmt::join(key.methods.value(), "`, `"));
}

std::string tried_values_table()
{
    std::string text = "| key | of | default | tried beside it |\n|---|---|---|---|\n";
    for (const scene::Key& key : methods::key_table()->rows()) {
        std::vector<std::string> values;
        for (const scene::JobValue& value : key.tried.values) {
            values.push_back(fmt::format("`{}`", scene::to_toml(value)));
        }
        if (!values.empty()) {
            text += fmt::format("| `{}` | {} | `{}` | {}{} |\n", key.name, methods_with(key),
                                key.default_text, fmt::join(values, ", "), text_of(key.tried.unit));
        }
    }
    return text;
}

TEST(TunePage, HasTheValuesThatKeysName)
{
    expect_blocks("docs/tune.md", {{"tried values", tried_values_table()}});
}

} // namespace
} // namespace gnomon::methods
