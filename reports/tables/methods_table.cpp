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

std::string monotonicity_text(const methods::Monotonicity& monotonicity)
{
    const std::string how = spaced(methods::name(monotonicity.how));
    return monotonicity.how == methods::Monotone::up_to_rounding
               ? fmt::format("{} ({:.2g})", how, monotonicity.largest_fall)
               : how;
}

/// The cells that both tables of promises share.
void add_traits(Row& row, const methods::LookupTraits& traits)
{
    for (std::string text :
         {spaced(methods::name(traits.verdict)), spaced(methods::name(traits.compares)),
          monotonicity_text(traits.monotonicity), spaced(methods::name(traits.curve))}) {
        row.push_back(std::move(text));
    }
}

std::string traits_columns(const methods::Method& method)
{
    if (method.filters.empty()) {
        const methods::LookupTraits traits = method.traits(scene::Job{});
        std::vector<Row> rows{{"texels", "verdict", "compares", "rises", "curve"},
                              {traits.has_map ? fmt::format("{0} × {0}", traits.width_texels)
                                              : std::string{"no map"}}};
        add_traits(rows.back(), traits);
        return aligned_rows(rows);
    }
    std::vector<Row> rows{{"filter", "texels", "verdict", "compares", "rises", "curve", ""}};
    for (const methods::FilterChoice& filter : method.filters) {
        const methods::LookupTraits traits = methods::traits_with(method, filter.filter);
        Row row{std::string{scene::filter_name(filter.filter)},
                fmt::format("{0} × {0}", traits.width_texels)};
        add_traits(row, traits);
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
    return text + fmt::format("  page    {}\n", method.page) + traits_columns(method) +
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
