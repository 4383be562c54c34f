#include "analysis/bias_rows.hpp"

#include "analysis/metrics.hpp"
#include "analysis/pixel_runs.hpp"
#include "analysis/radix_sort.hpp"
#include "analysis/wrong_biases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace gnomon::analysis {

using scene::PixelClass;

namespace {

/// Every thread counts for all of them: this bounds the memory.
constexpr std::size_t biases_at_once = 4096;

void require_ascending(std::span<const float> biases, std::string_view function)
{
    if (std::adjacent_find(biases.begin(), biases.end(), std::greater_equal<>{}) != biases.end()) {
        throw std::invalid_argument(fmt::format("{}: biases: must ascend", function));
    }
}

void require_equal_sizes(const BiasRowInputs& inputs, std::string_view function)
{
    const scene::ImageSize size = inputs.classes.size();
    if (inputs.deciding.samples.size() != size || inputs.critical_bias.size() != size ||
        inputs.causes.size() != size) {
        throw std::invalid_argument(fmt::format("{}: inputs: the images differ in size", function));
    }
}

/// How the counts of wrong pixels, by cause and label, change from one bias to the next. Sums of
/// integers: the same in whatever order.
class Changes {
public:
    explicit Changes(std::size_t biases) : stride_{biases + 1}, changes_(cells * stride_) {}

    /// Counts a pixel of this truth that is wrong at the biases [first, last).
    void add(std::size_t first, std::size_t last, PixelClass truth, Cause cause, Label label)
    {
        if (first < last) {
            std::int64_t* const changes = of_cell(cell_of(truth, cause, label));
            ++changes[first];
            --changes[last];
        }
    }

    void add(const Changes& other)
    {
        std::transform(changes_.begin(), changes_.end(), other.changes_.begin(), changes_.begin(),
                       std::plus<>{});
    }

    [[nodiscard]] std::vector<BiasRow> rows() const
    {
        std::vector<BiasRow> rows(stride_ - 1);
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const std::int64_t* const changes = changes_.data() + cell * stride_;
            std::int64_t count = 0;
            for (std::size_t i = 0; i < rows.size(); ++i) {
                count += changes[i];
                add_cell(rows[i], cell, static_cast<std::uint64_t>(count));
            }
        }
        return rows;
    }

private:
    static constexpr std::size_t labels = label_names.size();
    static constexpr std::size_t cells = 2 * cause_names.size() * labels;

    std::int64_t* of_cell(std::size_t cell) { return changes_.data() + cell * stride_; }
    static std::size_t cell_of(PixelClass truth, Cause cause, Label label)
    {
        const std::size_t side = truth == PixelClass::blocked ? 1 : 0;
        return (side * cause_names.size() + static_cast<std::size_t>(cause)) * labels +
               static_cast<std::size_t>(label);
    }
    static void add_cell(BiasRow& row, std::size_t cell, std::uint64_t count)
    {
        row.causes.by_cause[cell / labels % cause_names.size()] += count;
        row.causes.by_label[cell % labels] += count;
        (cell < cells / 2 ? row.errors.false_shadow : row.errors.false_lit) += count;
    }

    std::size_t stride_;
    std::vector<std::int64_t> changes_; ///< by cell, then bias: few cells are in use
};

/// Adds those that only a bias makes wrong: all of the curve's that are not in the row yet.
void add_wrong_by_bias(BiasRow& row, const ErrorCounts& all)
{
    const auto add = [&](Label label, std::uint64_t count) {
        row.causes.by_cause[static_cast<std::size_t>(Cause::bias)] += count;
        row.causes.by_label[static_cast<std::size_t>(label)] += count;
    };
    add(Label::overshadow, all.false_shadow - row.errors.false_shadow);
    add(Label::peter_panning, all.false_lit - row.errors.false_lit);
    row.errors = all;
}

/// Order statistics of a growing set of values that are all known in advance: a Fenwick tree over
/// their ranks. Source: P. M. Fenwick, "A new data structure for cumulative frequency tables",
/// Software: Practice and Experience 24 (1994).
class GrowingQuantiles {
public:
    explicit GrowingQuantiles(const std::vector<float>& values)
        : order_(values.size()),
          rank_(values.size()),
          values_(values.size()),
          tree_(values.size() + 1)
    {
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        radix_sort(order_, [&](std::size_t i) { return sort_key(values[i]); });
        for (std::size_t i = 0; i < order_.size(); ++i) {
            rank_[order_[i]] = i;
            values_[i] = values[order_[i]];
        }
    }

    /// Leaves out a value that is not finite, as `find_quantiles` does.
    void insert(std::size_t index)
    {
        if (!std::isfinite(values_[rank_[index]])) {
            return;
        }
        for (std::size_t i = rank_[index] + 1; i < tree_.size(); i += i & (~i + 1)) {
            ++tree_[i];
        }
        ++count_;
    }

    [[nodiscard]] std::optional<Quantiles> quantiles() const
    {
        if (count_ == 0) {
            return std::nullopt;
        }
        return Quantiles{count_, nth(1), nth(quantile_rank(count_, 50)),
                         nth(quantile_rank(count_, 95)), nth(count_)};
    }

private:
    /// The n-th smallest value in the set, n counted from 1.
    [[nodiscard]] float nth(std::size_t n) const
    {
        std::size_t position = 0;
        for (std::size_t step = std::bit_floor(tree_.size()); step > 0; step /= 2) {
            if (position + step < tree_.size() && tree_[position + step] < n) {
                position += step;
                n -= tree_[position];
            }
        }
        return values_[position];
    }

    std::vector<std::size_t> order_;
    std::vector<std::size_t> rank_;
    std::vector<float> values_; ///< ascending
    std::vector<std::size_t> tree_;
    std::size_t count_ = 0;
};

} // namespace

std::vector<BiasRow> count_rows(const BiasRowInputs& inputs, const BiasCurve& curve,
                                std::span<const float> biases)
{
    require_ascending(biases, "count_rows");
    require_equal_sizes(inputs, "count_rows");
    std::vector<BiasRow> rows;
    for (std::size_t first = 0; first < biases.size(); first += biases_at_once) {
        const auto part = biases.subspan(first, std::min(biases_at_once, biases.size() - first));
        const WrongBiases wrong{inputs, part};
        const auto count = [&](std::size_t begin, std::size_t end, Changes& sum) {
            for (std::size_t pixel = begin; pixel != end; ++pixel) {
                wrong.visit_unbiased(
                    pixel, [&](std::size_t from, std::size_t to, Cause cause, Label label) {
                        sum.add(from, to, inputs.classes[pixel], cause, label);
                    });
            }
        };
        const Changes changes =
            sum_over_runs(inputs.classes.pixel_count(), Changes{part.size()}, count);
        const std::vector<BiasRow> counted = changes.rows();
        rows.insert(rows.end(), counted.begin(), counted.end());
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        add_wrong_by_bias(rows[i], curve.at(biases[i]));
    }
    return rows;
}

CauseLayers classify_errors(const BiasRowInputs& inputs, float bias)
{
    require_equal_sizes(inputs, "classify_errors");
    const std::array<float, 1> biases{bias};
    const WrongBiases wrong{inputs, biases};
    CauseLayers layers{
        scene::Image<Cause>{inputs.classes.size()}, scene::Image<Label>{inputs.classes.size()}, {}};
    for (std::size_t i = 0; i < inputs.classes.pixel_count(); ++i) {
        const auto set = [&](std::size_t first, std::size_t last, Cause cause, Label label) {
            if (first < last) {
                layers.cause[i] = cause;
                layers.label[i] = label;
                ++layers.counts.by_cause[static_cast<std::size_t>(cause)];
                ++layers.counts.by_label[static_cast<std::size_t>(label)];
            }
        };
        wrong.visit_unbiased(i, set);
        wrong.visit_biased(i, set);
    }
    return layers;
}

std::vector<Gaps> find_gaps_at(std::vector<PanningGap> gaps, std::span<const float> biases)
{
    require_ascending(biases, "find_gaps_at");
    radix_sort(gaps, [](const PanningGap& gap) { return sort_key(gap.critical_bias); });
    std::vector<float> metres;
    std::vector<float> texels;
    for (const PanningGap& gap : gaps) {
        metres.push_back(gap.gap.metres);
        texels.push_back(gap.gap.texels);
    }
    GrowingQuantiles in_metres{metres};
    GrowingQuantiles in_texels{texels};
    std::vector<Gaps> rows;
    std::size_t next = 0;
    for (const float bias : biases) {
        for (; next < gaps.size() && gaps[next].critical_bias <= bias; ++next) {
            in_metres.insert(next);
            in_texels.insert(next);
        }
        rows.push_back({in_metres.quantiles(), in_texels.quantiles()});
    }
    return rows;
}

} // namespace gnomon::analysis
