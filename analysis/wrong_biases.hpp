#pragma once

#include "analysis/bias_index.hpp"
#include "analysis/bias_rows.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace gnomon::analysis {

/// With which of several biases a pixel is wrong, and why: it changes its verdict at its critical
/// bias, and a lit one its cause at the bias with which exact depths repair it.
class WrongBiases {
public:
    /// @param biases  Ascending; like the inputs, they must outlive this.
    WrongBiases(const BiasRowInputs& inputs, std::span<const float> biases)
        : inputs_{inputs},
          biases_{biases},
          index_{biases}
    {
    }

    /// Calls `visit(first, last, cause, label)` for the biases [first, last) with which a scored
    /// pixel that the map without any bias gets wrong is wrong.
    template <typename Visit>
    void visit_unbiased(std::size_t pixel, const Visit& visit) const
    {
        const PixelCause& why = inputs_.causes[pixel];
        if (why.unbiased == Cause::none) {
            return;
        }
        const scene::PixelClass truth = inputs_.classes[pixel];
        const std::size_t change = index_.first_from(inputs_.critical_bias[pixel]);
        if (truth == scene::PixelClass::blocked) {
            visit(change, biases_.size(), why.unbiased, label_of(why, truth, why.unbiased));
        } else if (truth == scene::PixelClass::lit && change > 0) {
            const float slope_term = inputs_.rule.slope * inputs_.deciding.samples[pixel].tan_theta;
            const std::size_t middle =
                std::min(change, first_repaired(why.exact_critical_bias, slope_term));
            visit(0, middle, why.unbiased, label_of(why, truth, why.unbiased));
            visit(middle, change, Cause::precision, label_of(why, truth, Cause::precision));
        }
    }

    /// The same for a scored pixel that only a bias makes wrong.
    template <typename Visit>
    void visit_biased(std::size_t pixel, const Visit& visit) const
    {
        if (inputs_.causes[pixel].unbiased != Cause::none) {
            return;
        }
        const scene::PixelClass truth = inputs_.classes[pixel];
        const std::size_t change = index_.first_from(inputs_.critical_bias[pixel]);
        if (truth == scene::PixelClass::lit) {
            visit(0, change, Cause::bias, Label::overshadow);
        } else if (truth == scene::PixelClass::blocked) {
            visit(change, biases_.size(), Cause::bias, Label::peter_panning);
        }
    }

private:
    /// Index of the first bias that with the slope's part is not below `exact_critical`.
    [[nodiscard]] std::size_t first_repaired(float exact_critical, float slope_term) const
    {
        if (slope_term == 0) {
            return index_.first_from(exact_critical);
        }
        const auto first = std::partition_point(biases_.begin(), biases_.end(), [&](float bias) {
            return !(bias + slope_term >= exact_critical);
        });
        return static_cast<std::size_t>(first - biases_.begin());
    }

    const BiasRowInputs& inputs_;
    std::span<const float> biases_;
    BiasIndex index_;
};

} // namespace gnomon::analysis
