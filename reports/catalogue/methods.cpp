#include "reports/catalogue/catalogue.hpp"

#include "methods/refusal.hpp"
#include "reports/tables/table_lines.hpp"
#include "scene/job/file.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

using Row = std::vector<std::string>;

/// "each tap" for "each_tap".
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

/// The cells that both tables of lookup traits share.
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

namespace {

store::Json source_array(std::span<const methods::Source> sources)
{
    store::Json json = store::Json::array();
    for (const methods::Source& source : sources) {
        json.push_back({{"authors", source.authors},
                        {"year", source.year},
                        {"title", source.title},
                        {"about", source.about}});
    }
    return json;
}

store::Json key_array(const methods::Method& method)
{
    store::Json json = store::Json::array();
    for (const scene::Key& key : methods::keys_of(method)) {
        // Defaults are TOML; numbers, booleans and words have the same syntax in JSON.
        json.push_back(
            {{"name", key.name},
             {"description", key.description},
             {"unit", key.unit},
             {"default", key.default_text.empty() ? store::Json(nullptr)
                                                  : store::Json::parse(key.default_text)},
             {"allowed", key.range_text},
             {"stages", scene::stage_names(key.stages)}});
    }
    return json;
}

store::Json lookup_traits_object(const methods::LookupTraits& traits)
{
    const bool falls = traits.monotonicity.how == methods::Monotone::up_to_rounding;
    return {{"verdict", methods::name(traits.verdict)},
            {"compares", methods::name(traits.compares)},
            {"rises", methods::name(traits.monotonicity.how)},
            {"largest_fall", falls ? store::Json(traits.monotonicity.largest_fall) : nullptr},
            {"curve", methods::name(traits.curve)},
            {"footprint_texels", traits.width_texels},
            {"reads", methods::name(traits.reads)},
            {"samples", traits.samples},
            {"map_bytes", traits.map_bytes},
            {"has_map", traits.has_map}};
}

store::Json filter_array(const methods::Method& method)
{
    store::Json json = store::Json::array();
    for (const methods::FilterChoice& filter : method.filters) {
        const methods::LookupTraits traits = methods::traits_with(method, filter.filter);
        json.push_back({{"name", scene::filter_name(filter.filter)},
                        {"sentence", filter.sentence},
                        {"width_texels", traits.width_texels},
                        {"lookup_traits", lookup_traits_object(traits)},
                        {"promises", lookup_traits_object(traits)}}); // the older name
    }
    return json;
}

store::Json bias_term_array(const methods::Method& method)
{
    store::Json json = store::Json::array();
    for (const methods::BiasTerm& term : method.bias_terms) {
        store::Json keys = store::Json::array();
        for (const scene::Key& key : methods::keys_of(term)) {
            keys.push_back({{"name", key.name}, {"unit", key.unit}});
        }
        json.push_back({{"name", term.name},
                        {"sentence", term.sentence},
                        {"acts", methods::name(term.place)},
                        {"refused", methods::refuses(method, term)},
                        {"stages", scene::stage_names(methods::stages_of(term))},
                        {"keys", std::move(keys)}});
    }
    return json;
}

} // namespace

std::string methods_json(std::span<const methods::Method> methods)
{
    store::Json json = store::Json::array();
    for (const methods::Method& method : methods) {
        const methods::LookupTraits traits = method.traits(scene::Job{});
        json.push_back({{"name", method.name},
                        {"sentence", method.sentence},
                        {"sources", source_array(method.sources)},
                        {"page", method.page},
                        {"lookup_traits", lookup_traits_object(traits)},
                        {"promises", lookup_traits_object(traits)}, // the older name
                        {"filters", filter_array(method)},
                        {"bias_terms", bias_term_array(method)},
                        {"keys", key_array(method)}});
    }
    return json.dump(2) + "\n";
}

} // namespace gnomon::reports
