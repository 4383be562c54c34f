#include "analysis/evaluate/case_causes.hpp"

#include "analysis/diagnosis/diagnose.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "analysis/lookup/taps.hpp"
#include "methods/job_method.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/pixels/pixel_class.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::analysis {

namespace {

/// Whether the lookup without any bias is recorded, or can be derived.
bool knows_unbiased(const Comparison& comparison, const scene::CaseLayers& layers)
{
    return can_derive_unbiased(comparison.job, comparison.view) || !layers.unmoved.samples.empty();
}

std::string listed(const std::vector<std::string>& words)
{
    return fmt::format("{}", fmt::join(words, ", "));
}

/// How many scored pixels the case's lookup decides otherwise than its mask does.
std::uint64_t count_contradicted(const Comparison& comparison, const BiasAnswers& answers)
{
    std::uint64_t pixels = 0;
    for (std::size_t i = 0; i < answers.critical_bias.pixel_count(); ++i) {
        const bool is_lit = answers.critical_bias[i] <= comparison.view.bias.constant;
        if (scene::is_scored(comparison.truth.pixel_class[i]) &&
            scene::is_lit(comparison.lookup.samples[i].verdict) != is_lit) {
            ++pixels;
        }
    }
    return pixels;
}

/// Finds every cause, or notes why that is impossible.
void find_all_causes(const Case& subject, const renderers::RoundedReference& truth,
                     Comparison& comparison)
{
    Evaluation& evaluation = *comparison.evaluation;
    const auto cannot = [&](std::string needs) {
        evaluation.cannot_know.push_back({"causes, labels, bias curve", std::move(needs)});
    };
    const auto missing = missing_for_causes(subject.file, comparison.job, subject.layers);
    if (!missing.empty()) {
        cannot(listed(missing));
        return;
    }
    if (!knows_unbiased(comparison, subject.layers)) {
        cannot("unmoved.*: the lookup without any bias");
        return;
    }
    const std::string disagreement = find_disagreement(
        comparison.view, subject.layers, subject.mesh, comparison.receivers.triangle,
        evaluation.import_check.distances.tolerance_m);
    if (!disagreement.empty()) {
        cannot(disagreement);
        return;
    }
    evaluation.has_map = true;
    if (evaluation.import_check.warning.empty()) {
        evaluation.import_check.warning = check_offset(comparison, subject.layers);
    }
    comparison.diagnosis = diagnose(
        {subject.mesh, comparison.receivers, comparison.truth, comparison.lookup,
         taps_of_mask(subject, comparison.job)},
        observe_recorded(subject.layers, comparison.job, comparison.view, comparison.lookup),
        {comparison.view.bias.constant}, truth);
    // The renderer rounds weights between texels' centres in its own way.
    const auto& biases = comparison.diagnosis->biases;
    if (biases && methods::traits(comparison.job).has_formula()) {
        evaluation.contradicted_pixels = count_contradicted(comparison, *biases);
    }
}

/// What r and d alone tell, without a full diagnosis.
void find_some_causes(const Case& subject, Comparison& comparison)
{
    Evaluation& evaluation = *comparison.evaluation;
    const scene::CaseLayers& layers = subject.layers;
    const bool has_one_tap =
        subject.file.says("lookup.filter") && methods::traits(comparison.job).has_one_tap();
    std::vector<std::string> missing;
    for (const auto& [is_there, what] :
         {std::pair{!layers.z_light.empty(), "z.light"},
          {!layers.z_map.empty(), "z.map"},
          {has_one_tap, "lookup.filter = \"nearest\""},
          {!scene::mixes_maps(comparison.job), "shadow_map.blend = 0"}}) {
        if (!is_there) {
            missing.emplace_back(what);
        }
    }
    for (const std::string_view key : methods::moving_bias_keys(comparison.job)) {
        const scene::Key* row = scene::keys_of(comparison.job).find(key);
        if (row == nullptr) {
            continue;
        }
        // Few renderers have terms with keys of their own; a case need not mention those.
        const bool is_known = row->is_added() || subject.file.says(key);
        if (!is_known ||
            scene::value_in(*row, comparison.job) != scene::default_of(*row, comparison.job)) {
            missing.push_back(fmt::format("{} = {}", key, row->default_text));
        }
    }
    if (missing.empty()) {
        evaluation.bias_causes =
            find_bias_causes(layers, comparison.truth, comparison.job.shadow_map.frustum.reversed);
    } else {
        evaluation.cannot_know.push_back({"which pixels are wrong by the bias", listed(missing)});
    }
}

} // namespace

int taps_of_mask(const Case& subject, const scene::Job& job)
{
    constexpr double rounding = 0x1p-20; // of a float32 below 1, times at most 81 taps
    if (!subject.file.says("lookup.filter") && !subject.file.says("method.name")) {
        return 0;
    }
    const int taps = methods::traits(job).equal_taps();
    const bool are_multiples = std::ranges::all_of(subject.layers.mask, [&](float lit) {
        const double share = double{lit} * taps;
        return std::isnan(lit) || std::abs(share - std::nearbyint(share)) <= rounding;
    });
    return are_multiples ? taps : 0;
}

void find_case_causes(const Case& subject, const renderers::RoundedReference& truth,
                      Comparison& comparison)
{
    find_all_causes(subject, truth, comparison);
    if (!comparison.diagnosis) {
        find_some_causes(subject, comparison);
    }
}

BiasCauses find_bias_causes(const scene::CaseLayers& layers, const scene::Truth& truth,
                            bool reversed)
{
    const LookupRule rule{.reversed = reversed};
    const auto& classes = truth.pixel_class;
    BiasCauses found{scene::Image<Cause>{classes.size()}, scene::Image<Label>{classes.size()}};
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        const bool is_lit = scene::is_lit(classes[i]);
        if (!scene::is_scored(classes[i]) || scene::is_lit(layers.mask[i]) == is_lit) {
            continue;
        }
        const float r = layers.z_light[i];
        const float d = layers.z_map[i];
        const bool compares = std::isfinite(r) && std::isfinite(d);
        if (!compares || rule.is_lit(r, d) != is_lit) {
            ++found.unknown;
            continue;
        }
        found.cause[i] = Cause::bias;
        found.label[i] = is_lit ? Label::overshadow : Label::peter_panning;
        ++(is_lit ? found.overshadow : found.peter_panning);
    }
    return found;
}

} // namespace gnomon::analysis
