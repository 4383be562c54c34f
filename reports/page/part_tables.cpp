#include "reports/page/page_html.hpp"

#include "reports/text/text.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

constexpr std::size_t most_objects = 40;

std::uint64_t member(const store::Json& object, const char* name)
{
    const auto found = object.find(name);
    return found != object.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
}

std::optional<double> number(const store::Json& object, const char* name)
{
    const auto found = object.find(name);
    return found != object.end() && found->is_number() ? std::optional{found->get<double>()}
                                                       : std::nullopt;
}

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

double length_m(const store::Json& object, const char* name)
{
    return number(object, name).value_or(not_known);
}

/// The objects in an array of `compare --json`, such as "by_object"; empty if it is missing.
std::vector<const store::Json*> parts_of(const store::Json& detail, const char* breakdown)
{
    std::vector<const store::Json*> parts;
    if (detail.is_object() && detail.contains(breakdown) && detail[breakdown].is_array()) {
        for (const store::Json& part : detail[breakdown]) {
            if (part.is_object()) {
                parts.push_back(&part);
            }
        }
    }
    return parts;
}

/// The objects with scored pixels, most errors first.
std::vector<const store::Json*> objects_of(const store::Json& detail)
{
    std::vector<const store::Json*> objects = parts_of(detail, "by_object");
    std::erase_if(objects, [](const store::Json* object) {
        return member(*object, "lit") + member(*object, "blocked") == 0;
    });
    const auto wrong = [](const store::Json* object) {
        return member(*object, "false_shadow") + member(*object, "false_lit");
    };
    std::stable_sort(
        objects.begin(), objects.end(),
        [&](const store::Json* a, const store::Json* b) { return wrong(a) > wrong(b); });
    return objects;
}

/// @param name  The member with the part's name.
std::string part_heading(const store::Json& part, const char* name)
{
    const auto named = part.find(name);
    return row_heading(named != part.end() && named->is_string() ? named->get<std::string>()
                                                                 : std::string{});
}

constexpr std::array<std::string_view, 5> part_columns{"false shadow", "of lit", "false lit",
                                                       "of blocked", "mean error"};

/// The cells of `part_columns`.
std::string part_cells(const store::Json& part)
{
    return number_cell(grouped(member(part, "false_shadow"))) +
           number_cell(percent(number(part, "false_shadow_rate"))) +
           number_cell(grouped(member(part, "false_lit"))) +
           number_cell(percent(number(part, "false_lit_rate"))) +
           number_cell(percent(number(part, "mean_abs_error")));
}

std::string part_table_head(std::string_view caption,
                            std::initializer_list<std::string_view> columns)
{
    std::vector<std::string_view> all{columns};
    all.insert(all.end(), part_columns.begin(), part_columns.end());
    return table_head(caption, all);
}

/// A cascade's view depths, texel size and depth range, and the constant bias there.
std::string cascade_cells(const store::Json& map)
{
    const auto bias = map.find("bias");
    const bool has_bias = bias != map.end() && bias->is_object();
    const double begin_m = length_m(map, "begin_m");
    const double range_m = length_m(map, "far_m") - length_m(map, "near_m");
    const double bias_m = has_bias ? length_m(*bias, "constant_m") : not_known;
    return number_cell(fmt::format("{:.4g} to {:.4g}", begin_m, length_m(map, "end_m"))) +
           number_cell(fmt::format("{:.3g}", length_m(map, "texel_m"))) +
           number_cell(fmt::format("{:.4g}", range_m)) + number_cell(fmt::format("{:.3g}", bias_m));
}

} // namespace

std::string objects_table(const store::Json& detail)
{
    const auto objects = objects_of(detail);
    if (objects.empty()) {
        return "<p>Errors by object are not known: the layers of this configuration were not "
               "kept.</p>\n";
    }
    std::string html = part_table_head("By object, most errors first", {"object"});
    for (std::size_t i = 0; i < std::min(objects.size(), most_objects); ++i) {
        html += "<tr>" + part_heading(*objects[i], "object") + part_cells(*objects[i]) + "</tr>\n";
    }
    html += table_end;
    if (objects.size() > most_objects) {
        html += fmt::format("<p>{} more objects are in the page’s data.</p>\n",
                            grouped(objects.size() - most_objects));
    }
    return html;
}

std::string maps_table(const store::Json& detail, std::string_view unit)
{
    const auto maps = parts_of(detail, "by_map");
    if (maps.empty()) {
        return {};
    }
    const auto with_unit = [unit](std::string_view what) {
        return fmt::format("{} [{}]", what, unit);
    };
    const bool are_cascades = maps.front()->contains("begin_m");
    std::string html =
        are_cascades
            ? part_table_head("By map", {"cascade", with_unit("view depth"), with_unit("texel"),
                                         with_unit("range"), with_unit("bias")})
            : part_table_head("By map", {"map"});
    for (const store::Json* map : maps) {
        html += "<tr>" + part_heading(*map, "map") +
                (are_cascades ? cascade_cells(*map) : std::string{}) + part_cells(*map) + "</tr>\n";
    }
    return html + std::string{table_end};
}

} // namespace gnomon::reports
