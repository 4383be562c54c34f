#include "reports/comparison_table.hpp"

#include "reports/description.hpp"
#include "reports/findings.hpp"
#include "reports/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

namespace gnomon::reports {

namespace {

using scene::ClassReason;
using scene::PixelClass;

constexpr std::size_t name_columns = 16;
constexpr std::size_t count_columns = 13;
constexpr std::size_t rate_columns = 11;

/// A line without the blanks that padding left at its end.
std::string trimmed(std::string line)
{
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

std::string setting_line(std::string_view name, std::string_view value)
{
    return trimmed(pad_right(name, name_columns) + std::string{value});
}

std::string count_line(std::string_view name, std::string_view count, std::string_view rate,
                       std::string_view note)
{
    return trimmed(pad_right(name, name_columns) + pad_left(count, count_columns) +
                   pad_left(rate, rate_columns) + "  " + std::string{note});
}

/// "5 of 1,234 signs needed integers"; empty for a method that decides none.
std::string signs(const scene::TruthSigns& signs)
{
    const std::uint64_t all = signs.filtered + signs.exact;
    return all == 0 ? std::string{}
                    : setting_line("", fmt::format("{} of {} signs needed integers",
                                                   grouped(signs.exact), grouped(all)));
}

std::string settings(const analysis::Comparison& comparison)
{
    const Description words = describe(comparison);
    const analysis::Environment& environment = comparison.environment;
    std::string text = setting_line("scene", comparison.scene.name);
    text += setting_line("", words.size);
    text += setting_line("image", words.image);
    text += setting_line("light", words.light);
    text += setting_line("shadow map", words.map);
    text += setting_line("", words.range);
    text += setting_line("lookup", words.lookup);
    text += setting_line("bias", words.bias);
    text += setting_line("GL", environment.gl_renderer);
    text += setting_line("", environment.gl_version);
    text +=
        setting_line("truth", fmt::format("{}, {}", comparison.truth_method, environment.embree));
    text += signs(comparison.truth.signs);
    return text;
}

/// "snap 3, tie 1", of the reasons that occur.
std::string reasons(const analysis::ClassCounts& counts,
                    std::initializer_list<std::pair<ClassReason, std::string_view>> named)
{
    std::string text;
    for (const auto& [reason, name] : named) {
        if (counts.of(reason) > 0) {
            text +=
                fmt::format("{}{} {}", text.empty() ? "" : ", ", name, grouped(counts.of(reason)));
        }
    }
    return text;
}

std::string class_note(const analysis::ClassCounts& counts, PixelClass pixel_class)
{
    if (pixel_class == PixelClass::unmatched) {
        return reasons(counts, {{ClassReason::snap, "snap"},
                                {ClassReason::tie, "tie"},
                                {ClassReason::mismatch, "mismatch"}});
    }
    if (pixel_class == PixelClass::indeterminate) {
        return reasons(counts, {{ClassReason::silhouette, "silhouette"},
                                {ClassReason::vertex, "vertex"},
                                {ClassReason::graze, "graze"}});
    }
    return scene::is_scored(pixel_class) ? "scored" : "";
}

std::string classes(const analysis::ClassCounts& counts)
{
    std::string text = count_line("class", "pixels", "share", "");
    for (std::size_t i = 0; i < scene::pixel_class_count; ++i) {
        const auto pixel_class = static_cast<PixelClass>(i);
        const std::uint64_t count = counts.of(pixel_class);
        std::optional<double> share;
        if (counts.total > 0) {
            share = static_cast<double>(count) / static_cast<double>(counts.total);
        }
        text += count_line(scene::pixel_class_names[i], grouped(count), percent(share),
                           class_note(counts, pixel_class));
    }
    return text + count_line("total", grouped(counts.total), "", "");
}

std::string errors(const analysis::Metrics& metrics)
{
    const analysis::ClassCounts& counts = metrics.pixels;
    const auto denominator = [](std::uint64_t count, std::string_view noun) {
        return fmt::format("of {} {}", grouped(count), noun);
    };
    std::string text = count_line("error", "pixels", "rate", "");
    text += count_line("false shadow", grouped(metrics.false_shadow),
                       percent(metrics.false_shadow_rate),
                       denominator(counts.of(PixelClass::lit), "lit"));
    text += count_line("false lit", grouped(metrics.false_lit), percent(metrics.false_lit_rate),
                       denominator(counts.of(PixelClass::blocked), "blocked"));
    text += count_line("both", grouped(metrics.false_shadow + metrics.false_lit),
                       percent(metrics.error_rate), denominator(counts.scored(), "scored"));
    return text +
           count_line("mean |error|", "", percent(metrics.mean_abs_error), "verdict against truth");
}

/// Wrong pixels by name; the first name, "none", is left out.
template <typename Names, typename Counts>
std::string named_counts(std::string_view head, const Names& names, const Counts& counts,
                         std::uint64_t wrong)
{
    std::string text = count_line(head, "pixels", "of wrong", "");
    for (std::size_t i = 1; i < names.size(); ++i) {
        std::string name{names[i]};
        std::ranges::replace(name, '_', '-');
        std::optional<double> share;
        if (wrong > 0) {
            share = static_cast<double>(counts[i]) / static_cast<double>(wrong);
        }
        text += count_line(name, grouped(counts[i]), percent(share), "");
    }
    return text;
}

std::string diagnosis(const analysis::Comparison& comparison)
{
    if (!comparison.diagnosis) {
        return "";
    }
    const analysis::Diagnosis& diagnosis = *comparison.diagnosis;
    const std::uint64_t wrong = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    std::string text = "\n";
    text += named_counts("cause", analysis::cause_names, diagnosis.causes.counts.by_cause, wrong);
    text += "\n";
    text += named_counts("called", analysis::label_names, diagnosis.causes.counts.by_label, wrong);
    if (const auto& gap = diagnosis.peter_panning.metres) {
        text += setting_line("", fmt::format("peter-panning gap: median {:.4g} m, 95 % {:.4g} m, "
                                             "largest {:.4g} m ({:.3g} texels)",
                                             gap->median, gap->p95, gap->max,
                                             diagnosis.peter_panning.texels->max));
    }
    return text + by_object(diagnosis.by_object);
}

/// "bias.constant = 0.002, shadow_map.resolution = 2048" and what was measured with it.
std::string advice(const analysis::Comparison& comparison)
{
    if (comparison.advice.empty()) {
        return "";
    }
    const std::uint64_t now = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    std::string text = "\n";
    text += count_line("measured with", "errors", "rate", "");
    text += count_line("the job as it is", grouped(now), percent(comparison.metrics.error_rate), "");
    for (const analysis::Advice& change : comparison.advice) {
        text += count_line("", grouped(change.errors.total()), percent(change.error_rate),
                           fmt::format("{}", fmt::join(change.keys, ", ")));
    }
    return text;
}

std::string sentences(const analysis::Comparison& comparison)
{
    std::string text;
    for (const std::string& sentence : findings(comparison)) {
        text += sentence + "\n";
    }
    return text.empty() ? text : "\n" + text;
}

std::string by_object(const std::vector<analysis::ObjectErrors>& objects)
{
    constexpr std::size_t most_lines = 12;
    std::vector<analysis::ObjectErrors> wrong;
    std::ranges::copy_if(objects, std::back_inserter(wrong), [](const auto& object) {
        return object.counts.false_shadow + object.counts.false_lit > 0;
    });
    if (objects.size() < 2 || wrong.empty()) {
        return "";
    }
    std::ranges::stable_sort(wrong, std::greater{}, [](const analysis::ObjectErrors& object) {
        return object.counts.false_shadow + object.counts.false_lit;
    });
    std::string text = "\n";
    text += count_line("on object", "false shadow", "false lit", "");
    for (std::size_t i = 0; i < std::min(wrong.size(), most_lines); ++i) {
        text += count_line(wrong[i].name, grouped(wrong[i].counts.false_shadow),
                           grouped(wrong[i].counts.false_lit), "");
    }
    if (wrong.size() > most_lines) {
        text += setting_line("", fmt::format("and on {} more", wrong.size() - most_lines));
    }
    return text;
}

std::string float_audit(const analysis::Comparison& comparison)
{
    if (comparison.float_audit.empty()) {
        return "";
    }
    std::string text = "\n";
    text += count_line("float method", "false blocked", "false lit", "");
    for (const scene::FloatMethodErrors& method : comparison.float_audit) {
        text += count_line(method.name, grouped(method.false_blocked), grouped(method.false_lit),
                           "wrong pixels");
    }
    return text;
}

std::string seconds(const analysis::StageSeconds& seconds)
{
    return setting_line("seconds",
                        fmt::format("scene {:.3f}  bvh {:.3f}  receivers {:.3f}  shadow map {:.3f}",
                                    seconds.scene, seconds.bvh, seconds.receivers,
                                    seconds.shadow_map)) +
           setting_line("", fmt::format("lookup {:.3f}  truth {:.3f}  analysis {:.3f}",
                                        seconds.lookup, seconds.truth, seconds.analysis));
}

} // namespace

std::string comparison_table(const analysis::Comparison& comparison)
{
    return fmt::format("{}\n{}\n{}{}{}\n{}", settings(comparison),
                       classes(comparison.metrics.pixels), errors(comparison.metrics),
                       diagnosis(comparison), advice(comparison) + float_audit(comparison),
                       seconds(comparison.seconds) + sentences(comparison));
}

} // namespace gnomon::reports
