#include "reports/text/answer.hpp"

#include "analysis/advice/remedies.hpp"
#include "analysis/pixels/statistics.hpp"
#include "reports/text/answer_parts.hpp"
#include "reports/text/description.hpp"
#include "reports/text/error_text.hpp"
#include "reports/text/findings.hpp"
#include "reports/text/remedy_text.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace gnomon::reports {

namespace {

using analysis::Remedy;

constexpr std::size_t most_answer_lines = 14;

std::uint64_t wrong_count(const analysis::Metrics& metrics)
{
    return metrics.false_shadow + metrics.false_lit;
}

/// Whether some verdict is wrong, or off by more than what a kernel softens on purpose.
bool has_wrong_verdicts(const analysis::Comparison& comparison)
{
    return comparison.diagnosis ? has_errors(comparison) || wrong_count(comparison.metrics) > 0
                                : comparison.metrics.amounts.total() > 0;
}

/// What is wrong, where causes are not known.
std::string counted_summary(const analysis::Comparison& comparison)
{
    const analysis::Metrics& metrics = comparison.metrics;
    if (wrong_count(metrics) > 0) {
        return fmt::format("{} of the scored pixels are wrong.", percent(metrics.error_rate));
    }
    return has_wrong_verdicts(comparison)
               ? fmt::format("No scored pixel is on the wrong side of one half, but verdicts are "
                             "off by {} on average.",
                             percent(metrics.mean_abs_error))
               : fmt::format("All {} scored pixels are right.", grouped(metrics.pixels.scored()));
}

/// A sentence that goes on behind a colon; "GL…" keeps its capital.
std::string after_colon(std::string sentence)
{
    const bool is_word =
        sentence.size() > 1 && std::islower(static_cast<unsigned char>(sentence[1])) != 0;
    if (is_word) {
        sentence[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence[0])));
    }
    return sentence;
}

void add_headline(AnswerLines& lines, const analysis::Comparison& comparison)
{
    const std::string& scene =
        comparison.evaluation ? comparison.evaluation->case_name : comparison.scene.name;
    const bool is_summed = comparison.diagnosis || comparison.metrics.pixels.scored() == 0;
    const bool is_right = !has_wrong_verdicts(comparison) &&
                          comparison.metrics.pixels.scored() > 0 && comparison.light_shells.empty();
    lines.sentence(
        fmt::format(
            "{}{}: {}", scene,
            comparison.light.empty() ? "" : fmt::format(", light {}", comparison.light),
            after_colon(is_summed ? error_summary(comparison) : counted_summary(comparison))),
        is_right ? Tone::good : Tone::bad);
}

/// "2,112 of 526,341 scored pixels (0.401 %): 1,753 false shadow, 359 false lit"
std::string counts_text(const analysis::Metrics& metrics)
{
    return fmt::format("{} of {} scored pixels ({}): {} false shadow, {} false lit",
                       grouped(wrong_count(metrics)), grouped(metrics.pixels.scored()),
                       percent(metrics.error_rate), grouped(metrics.false_shadow),
                       grouped(metrics.false_lit));
}

void add_wrong_counts(AnswerLines& lines, const analysis::Comparison& comparison)
{
    const analysis::Metrics& metrics = comparison.metrics;
    std::string text = counts_text(metrics);
    if (has_fractions(metrics)) {
        const double amount = analysis::error_amount(comparison);
        text += fmt::format("; {} by amount",
                            percent(analysis::ratio(amount, metrics.pixels.scored())));
    }
    lines.entry("wrong", text, Tone::bad);
}

/// Adds remedies after the first: three, or all that were measured; one if lines are scarce.
/// @param lines_after  the lines that follow.
void add_others(AnswerLines& lines, const analysis::Comparison& comparison,
                const std::vector<Remedy>& remedies, std::size_t lines_after)
{
    constexpr std::size_t most_measured = 12;
    constexpr std::size_t most_known = 4;
    const bool is_advised = !comparison.advice.empty();
    const std::size_t end = std::min(remedies.size(), is_advised ? most_measured : most_known);
    for (std::size_t i = 1; i < end; ++i) {
        AnswerLines other{lines};
        other.entry(i == 1 ? "or" : "", remedy_in_brief(comparison, remedies[i]));
        if (!is_advised && i > 1 && other.size() + lines_after > most_answer_lines) {
            return;
        }
        lines = other;
    }
    if (is_advised && remedies.size() > end) {
        lines.entry("", fmt::format("and {} more", remedies.size() - end));
    }
}

/// The settings in a line. Another renderer reports only some of its own.
std::string answer_settings(const analysis::Comparison& comparison)
{
    if (!comparison.evaluation) {
        return settings_in_brief(comparison);
    }
    const Description words = describe(comparison);
    return fmt::format("{}; image {}; light {}; level {}", renderer_in_brief(comparison),
                       words.image, words.light, comparison.evaluation->level);
}

/// The lines behind the other ways: what to know, and the settings.
AnswerLines lines_after_fixes(const analysis::Comparison& comparison,
                              const std::vector<Remedy>& remedies, const AnswerOptions& options)
{
    AnswerLines lines{options.in_colour};
    add_places(lines, comparison);
    add_warnings(lines, comparison, remedies);
    if (comparison.evaluation) {
        add_evaluation(lines, comparison, *comparison.evaluation);
    } else if (!comparison.diagnosis) {
        lines.entry("note", "Causes and a fix need the exact truth: leave out --truth float.");
    }
    add_requested(lines, comparison);
    lines.entry("settings", answer_settings(comparison), Tone::dim);
    return lines;
}

/// What to do next, in one line or two.
/// @param has_fix  Whether `gnomon settings` would translate what was recommended.
AnswerLines next_steps(const AnswerOptions& options, bool has_fix)
{
    AnswerLines lines{options.in_colour};
    const std::string own = "--verbose shows every number; --picture FILE.png draws it";
    if (!has_fix || options.settings_command.empty()) {
        lines.sentence(own + ".", Tone::dim);
        return lines;
    }
    lines.sentence(own + ".", Tone::dim);
    lines.unbroken(fmt::format("{} --engine NAME translates the fix.", options.settings_command),
                   Tone::dim);
    return lines;
}

/// The remedies of a comparison in error; empty without a diagnosis.
std::vector<Remedy> remedies_of(const analysis::Comparison& comparison)
{
    return comparison.diagnosis && has_errors(comparison) ? analysis::ranked_remedies(comparison)
                                                          : std::vector<Remedy>{};
}

/// The answer for one light, without what to do next.
/// @param lines_after  of what to do next.
AnswerLines light_lines(const analysis::Comparison& comparison, const std::vector<Remedy>& remedies,
                        const AnswerOptions& options, std::size_t lines_after)
{
    AnswerLines lines{options.in_colour};
    add_headline(lines, comparison);
    if (has_wrong_verdicts(comparison)) {
        add_wrong_counts(lines, comparison);
    }
    const AnswerLines after = lines_after_fixes(comparison, remedies, options);
    if (comparison.diagnosis && has_errors(comparison)) {
        add_fix(lines, comparison, remedies);
        add_others(lines, comparison, remedies, after.size() + lines_after);
    }
    lines.append(after);
    return lines;
}

} // namespace

std::string answer_text(const analysis::Comparison& comparison, const AnswerOptions& options)
{
    const std::vector<Remedy> remedies = remedies_of(comparison);
    const bool has_fix = comparison.diagnosis && recommends_constant_bias(comparison, remedies);
    const AnswerLines next = next_steps(options, has_fix);
    AnswerLines lines = light_lines(comparison, remedies, options, next.size());
    lines.append(next);
    return lines.text();
}

std::string answer_text(std::span<const analysis::Comparison> lights, const AnswerOptions& options)
{
    std::string text;
    bool has_fix = false;
    for (const analysis::Comparison& comparison : lights) {
        const std::vector<Remedy> remedies = remedies_of(comparison);
        has_fix =
            has_fix || (comparison.diagnosis && recommends_constant_bias(comparison, remedies));
        text += light_lines(comparison, remedies, options, 0).text() + "\n";
    }
    const analysis::Metrics total = analysis::total_of(analysis::results_of(lights)).metrics;
    AnswerLines lines{options.in_colour};
    const std::string amount =
        has_fractions(total) ? fmt::format("; {} by amount", percent(total.mean_abs_error)) : "";
    lines.sentence(fmt::format("All lights: {}{}.", counts_text(total), amount),
                   wrong_count(total) > 0 ? Tone::bad : Tone::good);
    lines.append(next_steps(options, has_fix));
    return text + lines.text();
}

} // namespace gnomon::reports
