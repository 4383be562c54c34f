#pragma once

#include "analysis/advice/remedies.hpp"
#include "analysis/comparison/comparison.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// Comparisons with invented errors and remedies.
namespace gnomon::reports {

/// 100 lit and 100 blocked pixels; a lit pixel needs a bias of 0.25, the blocked allow 0.5.
inline analysis::Comparison comparison_of(std::uint64_t false_shadow, std::uint64_t false_lit)
{
    analysis::Comparison comparison;
    comparison.view.maps.resize(1);
    analysis::Metrics& metrics = comparison.metrics;
    metrics.pixels.by_class[static_cast<std::size_t>(scene::PixelClass::lit)] = 100;
    metrics.pixels.by_class[static_cast<std::size_t>(scene::PixelClass::blocked)] = 100;
    metrics =
        make_metrics(metrics.pixels,
                     {false_shadow,
                      false_lit,
                      {static_cast<double>(false_shadow), static_cast<double>(false_lit), 0, 0}});

    scene::Image<float> critical{{200, 1}, -0.5F};
    scene::Image<scene::PixelClass> classes{{200, 1}, scene::PixelClass::lit};
    for (int i = 100; i < 200; ++i) {
        classes(i, 0) = scene::PixelClass::blocked;
        critical(i, 0) = 0.5F;
    }
    critical[0] = 0.25F;
    analysis::BiasCurve curve{critical, classes};
    const analysis::BestBiases best = find_best_biases(curve);
    const analysis::PixelCauses acne{
        scene::Image<analysis::PixelCause>{
            {200, 1}, {analysis::Cause::resolution, analysis::Cause::resolution, true}},
        {}};
    const auto acne_free = [&](std::span<const std::uint64_t> allowed) {
        return analysis::find_acne_free({classes, critical, acne}, allowed);
    };
    const analysis::BiasBounds bounds = find_bias_bounds(curve, critical, classes, acne_free, {});
    comparison.diagnosis = analysis::Diagnosis{
        .causes = {},
        .peter_panning = {},
        .biases = analysis::BiasAnswers{critical, std::move(curve), best, bounds, {}, {}, 0},
        .by_distance = {},
        .by_angle = {},
        .by_object = {}};
    comparison.job.shadow_map.resolution_texels = 1024;
    return comparison;
}

inline void set_causes(analysis::Comparison& comparison, analysis::Cause cause,
                       analysis::Label label)
{
    analysis::CauseCounts& counts = comparison.diagnosis->causes.counts;
    const std::uint64_t wrong = comparison.metrics.false_shadow + comparison.metrics.false_lit;
    counts.by_cause[static_cast<std::size_t>(cause)] = wrong;
    counts.by_label[static_cast<std::size_t>(label)] = wrong;
}

inline void set_amounts(analysis::CauseAmounts& amounts, analysis::Cause cause,
                        analysis::Label label, double amount)
{
    amounts.by_cause[static_cast<std::size_t>(cause)] += amount;
    amounts.by_label[static_cast<std::size_t>(label)] += amount;
}

/// A recommendation that leaves this many pixels in shadow.
inline analysis::Recommendation recommended(float bias, std::uint64_t left)
{
    const analysis::BiasLength length{bias, 4.0 * double{bias}, 8.0 * double{bias}};
    const analysis::Outcome outcome{{left, 0}, {static_cast<double>(left), 0, 0, 0}, 0};
    return {length, length,  length, outcome, {fmt::format("bias.constant = {}", bias), bias},
            length, outcome, 1};
}

/// Error counts by label.
inline analysis::NamedErrors left(const std::vector<std::pair<analysis::Label, double>>& by_label)
{
    analysis::NamedErrors errors;
    for (const auto& [label, amount] : by_label) {
        errors.by_label[static_cast<std::size_t>(label)] = amount;
    }
    return errors;
}

inline analysis::Remedy rerun(const std::string& key, const analysis::ErrorCounts& errors)
{
    return {
        {key},
        {errors,
         {static_cast<double>(errors.false_shadow), static_cast<double>(errors.false_lit), 0, 0},
         0},
        {},
        {std::uint64_t{1024} * 1024 * 4, 1}};
}

} // namespace gnomon::reports
