#include "reports/pictures/captions.hpp"

#include "methods/job_method.hpp"
#include "reports/text/description.hpp"
#include "reports/text/text.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

namespace gnomon::reports {

namespace {

using scene::PixelClass;

/// Adds a line without a mark; an empty text adds none.
void add_line(Caption& caption, std::string text)
{
    if (!text.empty()) {
        caption.lines.push_back({std::move(text), {}, {}, {}});
    }
}

Caption gl_caption(const analysis::Comparison& comparison)
{
    const Description words = describe(comparison);
    const bool has_map = methods::traits(comparison.job).has_map;
    Caption caption{has_map ? "GL shadow map" : "GL shadows", {}};
    if (has_map) {
        add_line(caption, words.map + ", " + words.lookup);
        add_line(caption, bias_in_brief(comparison));
        add_line(caption, words.range);
    } else {
        add_line(caption, words.lookup);
    }
    add_line(caption, comparison.environment.gl_renderer);
    return caption;
}

bool is_given(const analysis::Evaluation& evaluation, std::string_view key)
{
    const auto& given = evaluation.given_keys;
    return std::ranges::find(given, key) != given.end();
}

/// A value as TOML writes it, but a real number with at most four digits.
std::string short_value(const std::string& value)
{
    double number = 0;
    const char* const end = value.data() + value.size();
    const bool is_number = std::from_chars(value.data(), end, number).ptr == end;
    return is_number && number != std::floor(number) ? fmt::format("{:.4g}", number) : value;
}

/// "resolution = 1024, depth_format = d32f": the keys of a table that the case gives. A line breaks
/// only between keys.
std::string given_settings(const analysis::Comparison& comparison,
                           const analysis::Evaluation& evaluation, std::string_view table)
{
    constexpr std::string_view no_break = "\u00A0";
    std::vector<std::string> settings;
    for (const auto& [key, value] : scene::resolved_keys(comparison.job)) {
        if (key.starts_with(table) && is_given(evaluation, key)) {
            settings.push_back(fmt::format("{0}{1}={1}{2}", key.substr(table.size()), no_break,
                                           short_value(value)));
        }
    }
    return fmt::format("{}", fmt::join(settings, ", "));
}

/// Another renderer's name, its case's map settings, and its own keys.
Caption case_caption(const analysis::Comparison& comparison, const analysis::Evaluation& evaluation)
{
    Caption caption{comparison.environment.gl_renderer, {}};
    for (const auto& [name, table] : {std::pair{"map", "shadow_map."},
                                      {"lookup", "lookup."},
                                      {"bias", "bias."},
                                      {"engine", "engine."}}) {
        const std::string text = given_settings(comparison, evaluation, table);
        if (!text.empty()) {
            add_line(caption, fmt::format("{} {}", name, text));
        }
    }
    if (caption.lines.empty()) {
        add_line(caption, "the case gives no settings of a shadow map");
    }
    return caption;
}

/// "359 of 150,772 blocked px"
std::string share_text(std::uint64_t part, std::uint64_t whole, std::string_view noun)
{
    return fmt::format("{} of {} {} px", grouped(part), grouped(whole), noun);
}

/// Two lines: the errors of each kind, with their rates.
std::vector<CaptionLine> error_lines(const analysis::Metrics& metrics)
{
    const analysis::ClassCounts& counts = metrics.pixels;
    return {{"false shadow", percent(metrics.false_shadow_rate),
             share_text(metrics.false_shadow, counts.of(PixelClass::lit), "lit"),
             Mark::false_shadow},
            {"false lit", percent(metrics.false_lit_rate),
             share_text(metrics.false_lit, counts.of(PixelClass::blocked), "blocked"),
             Mark::false_lit}};
}

} // namespace

Caption shown_caption(const analysis::Comparison& comparison)
{
    return comparison.evaluation ? case_caption(comparison, *comparison.evaluation)
                                 : gl_caption(comparison);
}

Caption truth_caption(const analysis::Comparison& comparison)
{
    const analysis::ClassCounts& counts = comparison.metrics.pixels;
    const auto pixels = [&](PixelClass pixel_class) { return grouped(counts.of(pixel_class)); };
    Caption caption{"Truth (shadow rays)", {}};
    add_line(caption, fmt::format("{} px lit, {} px blocked", pixels(PixelClass::lit),
                                  pixels(PixelClass::blocked)));
    add_line(caption,
             fmt::format("{} px attached (turned from the light)", pixels(PixelClass::attached)));
    add_line(caption,
             fmt::format("{} px outside the light, {} px background",
                         pixels(PixelClass::out_of_light), pixels(PixelClass::background)));
    add_line(caption,
             fmt::format("{}, {}", comparison.environment.embree, comparison.truth_method));
    return caption;
}

Caption error_caption(const analysis::Metrics& metrics)
{
    const auto unscored = [&](std::string_view name, PixelClass pixel_class, Mark mark) {
        return CaptionLine{
            std::string{name},
            {},
            fmt::format("{} px, not scored", grouped(metrics.pixels.of(pixel_class))),
            mark};
    };
    Caption caption{has_fractions(metrics)
                        ? fmt::format("Errors: {} wrong, {} by amount", percent(metrics.error_rate),
                                      percent(metrics.mean_abs_error))
                        : fmt::format("Errors: {} of scored pixels", percent(metrics.error_rate)),
                    error_lines(metrics)};
    caption.lines.push_back(unscored("unmatched", PixelClass::unmatched, Mark::unmatched));
    caption.lines.push_back(
        unscored("indeterminate", PixelClass::indeterminate, Mark::indeterminate));
    return caption;
}

Caption after_caption(const analysis::Comparison& comparison,
                      const analysis::Recommendation& recommended)
{
    const analysis::ErrorCounts& errors = recommended.rounded_outcome.errors;
    const analysis::Metrics left =
        analysis::make_metrics(comparison.metrics.pixels, {errors.false_shadow, errors.false_lit,
                                                           recommended.rounded_outcome.amounts});
    Caption caption{fmt::format("After: {} ({:.3g} {})", recommended.rounded.key,
                                recommended.rounded_length.metres, length_unit(comparison)),
                    error_lines(left)};
    add_line(caption, fmt::format("{} of scored pixels wrong, from {}", percent(left.error_rate),
                                  percent(comparison.metrics.error_rate)));
    return caption;
}

} // namespace gnomon::reports
