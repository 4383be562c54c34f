#include "reports/tables/methods_table.hpp"

#include "methods/refusal.hpp"
#include "reports/tables/aligned_rows.hpp"
#include "scene/job/stage_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

using Row = std::vector<std::string>;

/// "each tap" of "each_tap".
std::string spaced(std::string_view name)
{
    std::string text{name};
    std::ranges::replace(text, '_', ' ');
    return text;
}

std::string rises_text(const methods::Rises& rises)
{
    const std::string how = spaced(methods::name(rises.how));
    return rises.how == methods::Rise::up_to_rounding
               ? fmt::format("{} ({:.2g})", how, rises.largest_fall)
               : how;
}

/// The cells that both tables of promises share.
void add_promises(Row& row, const methods::Promises& promises)
{
    for (std::string text :
         {spaced(methods::name(promises.verdict)), spaced(methods::name(promises.compares)),
          rises_text(promises.rises), spaced(methods::name(promises.curve))}) {
        row.push_back(std::move(text));
    }
}

std::string promises_columns(const methods::Method& method)
{
    if (method.filters.empty()) {
        const methods::Promises promises = method.promises(scene::Job{});
        std::vector<Row> rows{{"texels", "verdict", "compares", "rises", "curve"},
                              {promises.has_map ? fmt::format("{0} × {0}", promises.width_texels)
                                                : std::string{"no map"}}};
        add_promises(rows.back(), promises);
        return aligned_rows(rows);
    }
    std::vector<Row> rows{{"filter", "texels", "verdict", "compares", "rises", "curve", ""}};
    for (const methods::FilterChoice& filter : method.filters) {
        const methods::Promises promises = methods::promises_with(method, filter.filter);
        Row row{std::string{scene::filter_name(filter.filter)},
                fmt::format("{0} × {0}", promises.width_texels)};
        add_promises(row, promises);
        row.emplace_back(filter.sentence);
        rows.push_back(std::move(row));
    }
    return aligned_rows(rows);
}

std::string bias_columns(const methods::Method& method)
{
    std::vector<Row> rows{{"bias term", "acts on", "stage", "keys", ""}};
    for (const methods::BiasTerm& term : method.bias_terms) {
        std::vector<std::string> keys;
        for (const scene::Key& key : methods::keys_of(term)) {
            keys.push_back(fmt::format("{} [{}]", key.name, key.unit));
        }
        rows.push_back(
            {std::string{term.name},
             methods::refuses(method, term) ? "refused" : spaced(methods::name(term.place)),
             spaced(
                 fmt::format("{}", fmt::join(scene::stage_names(methods::stages_of(term)), ", "))),
             fmt::format("{}", fmt::join(keys, ", ")), std::string{term.sentence}});
    }
    return aligned_rows(rows);
}

std::string key_columns(const methods::Method& method)
{
    std::vector<Row> rows{{"key", "default", ""}};
    for (const scene::Key& key : methods::keys_of(method)) {
        rows.push_back(
            {key.name, key.default_text.empty() ? "–" : key.default_text, key.description});
    }
    return aligned_rows(rows);
}

std::string source_text(const methods::Source& source)
{
    return fmt::format("{}, {}, {}{}{}", source.authors, source.year, source.title,
                       source.about.empty() ? "" : ": ", source.about);
}

std::string method_text(const methods::Method& method)
{
    std::string text = fmt::format("{}: {}\n\n", method.name, method.sentence);
    for (const methods::Source& source : method.sources) {
        text += fmt::format("  source  {}\n", source_text(source));
    }
    return text + fmt::format("  page    {}\n", method.page) + promises_columns(method) +
           bias_columns(method) + key_columns(method);
}

} // namespace

std::string methods_table(std::span<const methods::Method> methods)
{
    std::string text;
    for (const methods::Method& method : methods) {
        if (!text.empty()) {
            text += '\n';
        }
        text += method_text(method);
    }
    return text;
}

} // namespace gnomon::reports
