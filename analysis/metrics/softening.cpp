#include "analysis/metrics/softening.hpp"

#include "analysis/limits/error_segments.hpp"
#include "analysis/pixels/pixel_runs.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace gnomon::analysis {

using scene::PixelClass;

namespace {

/// Differences of the softening between neighbouring biases, as integers in units of a pixel.
class SofteningChanges {
public:
    explicit SofteningChanges(std::size_t biases) : shadow_(biases + 1), light_(biases + 1) {}

    void add(PixelClass truth, const ErrorSegment& segment)
    {
        if (segment.cause == Cause::filter && segment.rest_label == Label::edge) {
            std::vector<std::int64_t>& changes = scene::is_lit(truth) ? shadow_ : light_;
            changes[segment.first] += segment.rest;
            changes[segment.last] -= segment.rest;
        }
    }
    void add(const SofteningChanges& other)
    {
        std::ranges::transform(shadow_, other.shadow_, shadow_.begin(), std::plus<>{});
        std::ranges::transform(light_, other.light_, light_.begin(), std::plus<>{});
    }
    [[nodiscard]] std::vector<Softening> sums(std::int64_t units) const
    {
        std::vector<Softening> sums(shadow_.size() - 1);
        std::int64_t shadow = 0;
        std::int64_t light = 0;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            shadow += shadow_[i];
            light += light_[i];
            sums[i] = {static_cast<double>(shadow) / static_cast<double>(units),
                       static_cast<double>(light) / static_cast<double>(units)};
        }
        return sums;
    }

private:
    std::vector<std::int64_t> shadow_;
    std::vector<std::int64_t> light_;
};

} // namespace

std::vector<Softening> softening_at(const BiasRowInputs& inputs, std::span<const float> biases)
{
    if (!inputs.rule.traits.has_fractions()) {
        return std::vector<Softening>(biases.size());
    }
    // If only its self-shadowing surface shadows a pixel, it is acne at any bias.
    const auto may_be_soft = [&](std::size_t pixel) {
        const PixelCause& why = inputs.causes.pixels[pixel];
        return scene::is_lit(inputs.classes[pixel])
                   ? inputs.causes.filters[pixel].has_others
                   : why.if_wrong == Cause::filter || why.if_partial == Cause::filter;
    };
    const ErrorSegments segments{inputs, biases};
    const auto count = [&](std::size_t begin, std::size_t end, SofteningChanges& sum) {
        segments.visit(begin, end, may_be_soft,
                       [&](std::size_t pixel, const ErrorSegment& segment) {
                           sum.add(inputs.classes[pixel], segment);
                       });
    };
    return sum_over_runs(inputs.classes.pixel_count(), SofteningChanges{biases.size()}, count)
        .sums(segments.units());
}

} // namespace gnomon::analysis
