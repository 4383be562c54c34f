#include "analysis/recommendation/minimum_search.hpp"

#include "scene/infinity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <utility>

namespace gnomon::analysis {

std::vector<float> coarse_biases()
{
    std::vector<float> biases{0.0F};
    for (int i = 0; i <= 24; ++i) {
        biases.push_back(static_cast<float>(1e-6 * std::pow(10.0, i / 4.0)));
    }
    return biases;
}

std::vector<float> fine_biases()
{
    constexpr int count = 256;
    std::vector<float> biases = coarse_biases();
    for (int i = 0; i < count; ++i) {
        biases.push_back(static_cast<float>(std::pow(10.0, -7.0 + 7.0 * i / (count - 1))));
    }
    std::ranges::sort(biases);
    biases.erase(std::unique(biases.begin(), biases.end()), biases.end());
    return biases;
}

namespace {

constexpr int most_extensions = 4;

class MinimumSearch {
public:
    MinimumSearch(const SampledCurve& curve, BiasSteps steps)
        : curve_{curve},
          ladder_{steps == BiasSteps::fine ? fine_biases() : coarse_biases()},
          at_once_{steps == BiasSteps::fine ? std::size_t{64} : std::size_t{7}},
          needs_end_from_zero_{steps == BiasSteps::fine}
    {
    }

    SampledMinimum run()
    {
        const std::array<float, 1> none{0.0F};
        at_zero_ = curve_.measure(none).front().softening;
        begin_around(least_of_coarse());
        SampledMinimum found = try_window();
        for (int i = 0; i < most_extensions && extend(found); ++i) {
            found = try_window();
        }
        if (!found.pieces.empty() && found.pieces.back().hi >= 1) {
            found.pieces.back().hi = scene::infinity; // larger biases light everything
            found.broad_minimum = find_broad_minimum(found.pieces);
        }
        return found;
    }

private:
    /// The error without the softening that may be left out.
    [[nodiscard]] double error_of(const SoftAmounts& at) const
    {
        return at.amounts.total() - left_out(at.softening, at_zero_).total();
    }
    /// The smallest possible error, whatever part of it is softening.
    [[nodiscard]] double least_error(const ErrorAmounts& amounts) const
    {
        return amounts.total() - left_out({amounts.shadow, amounts.light}, at_zero_).total();
    }

    /// Measures the biases that are not known yet.
    void measure(std::span<const float> biases)
    {
        std::vector<float> unknown;
        std::ranges::copy_if(biases, std::back_inserter(unknown),
                             [&](float bias) { return !errors_.contains(bias); });
        if (unknown.empty()) {
            return;
        }
        const std::vector<SoftAmounts> found = curve_.measure(unknown);
        for (std::size_t i = 0; i < unknown.size(); ++i) {
            errors_[unknown[i]] = error_of(found[i]);
        }
    }

    /// The coarse bias with the least error. Measures only those that the amounts do not rule out.
    [[nodiscard]] float least_of_coarse()
    {
        const std::vector<float> coarse = coarse_biases();
        const std::vector<ErrorAmounts> amounts = curve_.amounts(coarse);
        const auto promising = std::ranges::min_element(
            amounts, {}, [&](const ErrorAmounts& at) { return least_error(at); });
        const std::array<float, 1> first{
            coarse[static_cast<std::size_t>(promising - amounts.begin())]};
        measure(first);
        const double known = errors_.at(first.front());
        std::vector<float> open;
        for (std::size_t i = 0; i < coarse.size(); ++i) {
            if (least_error(amounts[i]) < known) {
                open.push_back(coarse[i]);
            }
        }
        measure(open);
        return std::ranges::min_element(errors_, {}, &std::pair<const float, double>::second)
            ->first;
    }

    void begin_around(float centre)
    {
        const auto found = std::ranges::lower_bound(ladder_, centre) - ladder_.begin();
        const auto half = static_cast<std::ptrdiff_t>(at_once_ / 2);
        const auto latest = static_cast<std::ptrdiff_t>(ladder_.size() - at_once_);
        first_ = static_cast<std::size_t>(std::clamp(found - half, std::ptrdiff_t{0}, latest));
        last_ = first_ + at_once_;
    }

    [[nodiscard]] SampledMinimum try_window()
    {
        const auto window = std::span{ladder_}.subspan(first_, last_ - first_);
        measure(window);
        SampledMinimum found;
        for (const float bias : window) {
            found.pieces.push_back({bias, bias, errors_.at(bias)});
        }
        found.broad_minimum = find_broad_minimum(found.pieces);
        return found;
    }

    /// Extends the window where it may end too early; returns false if it does not.
    [[nodiscard]] bool extend(const SampledMinimum& found)
    {
        const float lowest = found.pieces.front().lo;
        const float highest = found.pieces.back().hi;
        const float least = std::ranges::min_element(found.pieces, {}, &ErrorPiece::error)->lo;
        const BiasInterval run =
            found.broad_minimum ? found.broad_minimum->run : BiasInterval{lowest, highest};
        const bool has_end = run.hi < highest || (run.lo <= 0 && !needs_end_from_zero_);
        const bool goes_down = first_ > 0 && (least == lowest || run.lo == lowest);
        const bool goes_up = last_ < ladder_.size() && (least == highest || !has_end);
        first_ -= goes_down ? std::min(at_once_, first_) : 0;
        last_ += goes_up ? std::min(at_once_, ladder_.size() - last_) : 0;
        return goes_down || goes_up;
    }

    const SampledCurve& curve_;
    std::vector<float> ladder_;
    std::size_t at_once_;
    bool needs_end_from_zero_; ///< whether to find the end of a minimum that contains 0
    Softening at_zero_;
    std::map<float, double> errors_; ///< of the measured biases [px]
    std::size_t first_ = 0;          ///< window of the ladder: first index
    std::size_t last_ = 0;           ///< one behind the last index
};

} // namespace

SampledMinimum search_broad_minimum(const SampledCurve& curve, BiasSteps steps)
{
    return MinimumSearch{curve, steps}.run();
}

} // namespace gnomon::analysis
