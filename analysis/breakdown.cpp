#include "analysis/breakdown.hpp"

#include "analysis/ratio.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string_view>

namespace gnomon::analysis {

namespace {

using scene::PixelClass;

void count_pixel(PartCounts& counts, PixelClass pixel_class, bool is_lit)
{
    if (pixel_class == PixelClass::lit) {
        ++counts.lit;
        counts.false_shadow += is_lit ? 0 : 1;
    } else {
        ++counts.blocked;
        counts.false_lit += is_lit ? 1 : 0;
    }
}

void require_inputs(std::string_view function, const BreakdownInputs& inputs, int bins)
{
    const scene::ImageSize size = inputs.classes.size();
    const bool fits = inputs.lookup.samples.size() == size && inputs.criticals.size() == size &&
                      inputs.zeta_m.size() == size &&
                      (inputs.map_error_m.empty() || inputs.map_error_m.size() == size);
    if (!fits) {
        throw std::invalid_argument(fmt::format("{}: inputs: the images differ in size", function));
    }
    if (bins < 1) {
        throw std::invalid_argument(fmt::format("{}: bins: {} is below 1", function, bins));
    }
}

/// Equal bins over [lower, upper].
class Bins {
public:
    Bins(double lower, double upper, int count)
        : lower_{lower},
          upper_{upper},
          parts_(static_cast<std::size_t>(count))
    {
    }

    void add(double value, const BreakdownInputs& inputs, std::size_t pixel)
    {
        Part& part = parts_[index(value)];
        const PixelClass pixel_class = inputs.classes[pixel];
        count_pixel(part.counts, pixel_class, inputs.is_lit(pixel));
        if (pixel_class == PixelClass::lit) {
            part.needed.push_back(inputs.criticals[pixel]);
        }
        if (!inputs.map_error_m.empty()) {
            part.map_errors_m.push_back(inputs.map_error_m[pixel]);
        }
    }

    [[nodiscard]] std::vector<ErrorBin> take()
    {
        std::vector<ErrorBin> bins;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            Part& part = parts_[i];
            bins.push_back({edge(i), edge(i + 1), part.counts,
                            find_quantiles(std::move(part.needed)),
                            find_quantiles(std::move(part.map_errors_m))});
        }
        return bins;
    }

private:
    struct Part {
        PartCounts counts;
        std::vector<float> needed;
        std::vector<float> map_errors_m;
    };

    [[nodiscard]] double edge(std::size_t i) const
    {
        return std::lerp(lower_, upper_,
                         static_cast<double>(i) / static_cast<double>(parts_.size()));
    }
    /// The quotient may round across an edge; the edges decide.
    [[nodiscard]] std::size_t index(double value) const
    {
        const std::size_t last = parts_.size() - 1;
        if (!(upper_ > lower_)) {
            return 0;
        }
        const double position =
            (value - lower_) / (upper_ - lower_) * static_cast<double>(parts_.size());
        auto i = std::min(static_cast<std::size_t>(std::max(position, 0.0)), last);
        while (i > 0 && value < edge(i)) {
            --i;
        }
        while (i < last && value >= edge(i + 1)) {
            ++i;
        }
        return i;
    }

    double lower_;
    double upper_;
    std::vector<Part> parts_;
};

struct Range {
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();
};

Range scored_range(const scene::Image<PixelClass>& classes, const scene::Image<float>& zeta_m)
{
    Range range;
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (!scene::is_scored(classes[i])) {
            continue;
        }
        if (!std::isfinite(zeta_m[i])) {
            throw std::invalid_argument(fmt::format(
                "errors_by_distance: zeta_m: that of scored pixel {} is {}", i, zeta_m[i]));
        }
        range.lower = std::min(range.lower, double{zeta_m[i]});
        range.upper = std::max(range.upper, double{zeta_m[i]});
    }
    return range;
}

} // namespace

std::optional<double> PartCounts::false_shadow_rate() const
{
    return ratio(false_shadow, lit);
}

std::optional<double> PartCounts::false_lit_rate() const
{
    return ratio(false_lit, blocked);
}

std::optional<double> PartCounts::error_rate() const
{
    return ratio(false_shadow + false_lit, lit + blocked);
}

std::vector<ErrorBin> errors_by_distance(const BreakdownInputs& inputs, int bins)
{
    require_inputs("errors_by_distance", inputs, bins);
    const Range range = scored_range(inputs.classes, inputs.zeta_m);
    if (range.lower > range.upper) {
        return {};
    }
    Bins by_distance{range.lower, range.upper, range.lower < range.upper ? bins : 1};
    for (std::size_t i = 0; i < inputs.classes.pixel_count(); ++i) {
        if (scene::is_scored(inputs.classes[i])) {
            by_distance.add(double{inputs.zeta_m[i]}, inputs, i);
        }
    }
    return by_distance.take();
}

std::vector<ErrorBin> errors_by_angle(const BreakdownInputs& inputs, int bins)
{
    require_inputs("errors_by_angle", inputs, bins);
    Bins by_angle{0.0, std::numbers::pi / 2, bins};
    for (std::size_t i = 0; i < inputs.classes.pixel_count(); ++i) {
        if (scene::is_scored(inputs.classes[i])) {
            by_angle.add(std::atan(double{inputs.lookup.samples[i].tan_theta}), inputs, i);
        }
    }
    return by_angle.take();
}

std::vector<ObjectErrors> errors_by_object(const scene::Image<PixelClass>& classes,
                                           const scene::LookupLayers& lookup,
                                           const scene::Image<std::uint32_t>& triangles,
                                           const scene::TriangleScene& scene)
{
    if (lookup.samples.size() != classes.size() || triangles.size() != classes.size()) {
        throw std::invalid_argument("errors_by_object: the images differ in size");
    }
    std::vector<ObjectErrors> errors;
    for (const scene::Object& object : scene.objects) {
        errors.push_back({object.name, {}});
    }
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (scene::is_scored(classes[i])) {
            ObjectErrors& of_object = errors[scene.object_of(triangles[i])];
            count_pixel(of_object.counts, classes[i], scene::is_lit(lookup.samples[i].verdict));
        }
    }
    return errors;
}

} // namespace gnomon::analysis
