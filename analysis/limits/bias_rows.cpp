#include "analysis/limits/bias_rows.hpp"

#include "analysis/limits/error_segments.hpp"
#include "analysis/pixels/checks.hpp"
#include "analysis/pixels/pixel_runs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>

namespace gnomon::analysis {

using scene::PixelClass;

namespace {

/// Bounds the memory, since every thread has counters for all of them.
constexpr std::size_t biases_at_once = 4096;

void require_row_sizes(std::string_view function, const BiasRowInputs& inputs)
{
    require_equal_sizes(
        function, inputs.classes.size(),
        {inputs.deciding.samples.size(), inputs.critical_bias.size(), inputs.causes.pixels.size()});
}

/// Errors on one side of the truth with one cause and one label.
struct ErrorKinds {
    static constexpr std::size_t labels = label_names.size();
    static constexpr std::size_t count = 2 * cause_names.size() * labels;

    static std::size_t of(PixelClass truth, Cause cause, Label label)
    {
        const std::size_t side = scene::is_blocked(truth) ? 1 : 0;
        return (side * cause_names.size() + static_cast<std::size_t>(cause)) * labels +
               static_cast<std::size_t>(label);
    }
    static bool is_blocked(std::size_t cell) { return cell >= count / 2; }
    static std::size_t cause(std::size_t cell) { return cell / labels % cause_names.size(); }
    static std::size_t label(std::size_t cell) { return cell % labels; }
};

void add_count(std::size_t cell, std::uint64_t pixels, BiasRow& row)
{
    row.causes.by_cause[ErrorKinds::cause(cell)] += pixels;
    row.causes.by_label[ErrorKinds::label(cell)] += pixels;
    (ErrorKinds::is_blocked(cell) ? row.errors.false_lit : row.errors.false_shadow) += pixels;
}

/// Amounts by cause and label, as integers in fractions of a pixel.
class AmountUnits {
public:
    void add(std::size_t cell, std::int64_t units)
    {
        by_cause_[ErrorKinds::cause(cell)] += units;
        by_label_[ErrorKinds::label(cell)] += units;
        const std::size_t side = ErrorKinds::is_blocked(cell) ? 1 : 0;
        by_side_.at(side) += units;
        const bool is_soft = ErrorKinds::cause(cell) == static_cast<std::size_t>(Cause::filter) &&
                             ErrorKinds::label(cell) == static_cast<std::size_t>(Label::edge);
        softening_.at(side) += is_soft ? units : 0;
    }
    void add(const AmountUnits& other)
    {
        const auto add_all = [](auto& values, const auto& others) {
            std::ranges::transform(values, others, values.begin(), std::plus<>{});
        };
        add_all(by_cause_, other.by_cause_);
        add_all(by_label_, other.by_label_);
        add_all(by_side_, other.by_side_);
        add_all(softening_, other.softening_);
    }
    [[nodiscard]] std::int64_t of(PixelClass truth) const
    {
        return by_side_.at(scene::is_blocked(truth) ? 1 : 0);
    }
    /// @param units  Units of a pixel; 0: verdicts are not fractions, and amounts equal counts.
    [[nodiscard]] CauseAmounts amounts(std::int64_t units) const
    {
        const auto whole = static_cast<double>(std::max<std::int64_t>(units, 1));
        const auto pixels = [&](std::int64_t value) { return static_cast<double>(value) / whole; };
        CauseAmounts amounts;
        std::ranges::transform(by_cause_, amounts.by_cause.begin(), pixels);
        std::ranges::transform(by_label_, amounts.by_label.begin(), pixels);
        amounts.shadow_softening = units > 0 ? pixels(softening_[0]) : 0;
        amounts.light_softening = units > 0 ? pixels(softening_[1]) : 0;
        return amounts;
    }

private:
    std::array<std::int64_t, cause_names.size()> by_cause_{};
    std::array<std::int64_t, label_names.size()> by_label_{};
    std::array<std::int64_t, 2> by_side_{}; ///< lit, blocked
    std::array<std::int64_t, 2> softening_{};
};

/// The counts at one bias.
struct CountedRow {
    BiasRow row; ///< without the amounts
    AmountUnits units;
};

/// Differences of the errors, by cell, between neighbouring biases. Sums of integers, so their
/// order does not matter.
class Changes {
public:
    /// @param units  Units of a pixel in which amounts are counted; 0: amounts equal counts.
    Changes(std::size_t biases, std::int64_t units)
        : stride_{biases + 1},
          units_{units},
          counts_(ErrorKinds::count * stride_),
          amounts_(units > 0 ? counts_.size() : 0)
    {
    }

    void add(PixelClass truth, const ErrorSegment& segment)
    {
        if (segment.is_wrong) {
            add_span(counts_, ErrorKinds::of(truth, segment.cause, segment.label), segment, 1);
        }
        if (units_ > 0) {
            add_span(amounts_, ErrorKinds::of(truth, segment.cause, Label::acne), segment,
                     segment.acne);
            add_span(amounts_, ErrorKinds::of(truth, segment.cause, segment.rest_label), segment,
                     segment.rest);
        }
    }

    void add(const Changes& other)
    {
        add_all(counts_, other.counts_);
        add_all(amounts_, other.amounts_);
    }

    [[nodiscard]] std::vector<CountedRow> rows() const
    {
        std::vector<CountedRow> rows(stride_ - 1);
        for (std::size_t cell = 0; cell < ErrorKinds::count; ++cell) {
            std::int64_t count = 0;
            std::int64_t amount = 0;
            for (std::size_t i = 0; i < rows.size(); ++i) {
                count += counts_[cell * stride_ + i];
                add_count(cell, static_cast<std::uint64_t>(count), rows[i].row);
                amount = units_ > 0 ? amount + amounts_[cell * stride_ + i] : count;
                rows[i].units.add(cell, amount);
            }
        }
        return rows;
    }

private:
    using Values = std::vector<std::int64_t>; ///< by cell, then bias; few cells are used

    void add_span(Values& values, std::size_t cell, const ErrorSegment& segment,
                  std::int64_t value) const
    {
        values[cell * stride_ + segment.first] += value;
        values[cell * stride_ + segment.last] -= value;
    }
    static void add_all(Values& values, const Values& others)
    {
        std::transform(values.begin(), values.end(), others.begin(), values.begin(), std::plus<>{});
    }

    std::size_t stride_;
    std::int64_t units_;
    Values counts_;
    Values amounts_; ///< empty if amounts equal counts
};

/// Units of amounts; 0 if amounts equal counts.
std::int64_t amount_units(const LookupRule& rule)
{
    return rule.traits.has_fractions() ? ErrorSegments::units_of(rule.traits) : 0;
}

/// Adds the errors that only the bias causes: all that are not in the row yet.
/// @param units  As in `AmountUnits::amounts`.
void add_errors_by_bias(CountedRow& counted, const ErrorCounts& all, const ErrorAmounts& amounts,
                        std::int64_t units)
{
    const auto add = [&](PixelClass truth, Label label, std::uint64_t count, double amount) {
        const std::size_t cell = ErrorKinds::of(truth, Cause::bias, label);
        const auto whole = static_cast<double>(std::max<std::int64_t>(units, 1));
        add_count(cell, count, counted.row);
        counted.units.add(cell, std::llrint(amount * whole) - counted.units.of(truth));
    };
    const ErrorCounts found = counted.row.errors;
    add(PixelClass::lit, Label::overshadow, all.false_shadow - found.false_shadow, amounts.shadow);
    add(PixelClass::blocked, Label::peter_panning, all.false_lit - found.false_lit, amounts.light);
}

} // namespace

std::vector<BiasRow> count_rows(const BiasRowInputs& inputs, const BiasCurve& curve,
                                std::span<const ErrorAmounts> amounts,
                                std::span<const float> biases)
{
    require_ascending("count_rows", biases);
    require_row_sizes("count_rows", inputs);
    const std::int64_t units = amount_units(inputs.rule);
    const auto may_be_other = [&](std::size_t pixel) {
        return !inputs.causes.pixels[pixel].is_of_bias_alone();
    };
    std::vector<BiasRow> rows;
    for (std::size_t first = 0; first < biases.size(); first += biases_at_once) {
        const auto part = biases.subspan(first, std::min(biases_at_once, biases.size() - first));
        const ErrorSegments segments{inputs, part};
        const auto count = [&](std::size_t begin, std::size_t end, Changes& sum) {
            segments.visit(begin, end, may_be_other,
                           [&](std::size_t pixel, const ErrorSegment& segment) {
                               sum.add(inputs.classes[pixel], segment);
                           });
        };
        auto counted =
            sum_over_runs(inputs.classes.pixel_count(), Changes{part.size(), units}, count).rows();
        for (std::size_t i = 0; i < part.size(); ++i) {
            add_errors_by_bias(counted[i], curve.at(part[i]), amounts[first + i], units);
            rows.push_back(counted[i].row);
            rows.back().amounts = counted[i].units.amounts(units);
        }
    }
    return rows;
}

CauseLayers classify_errors(const BiasRowInputs& inputs, float bias)
{
    require_row_sizes("classify_errors", inputs);
    const std::array<float, 1> biases{bias};
    const ErrorSegments segments{inputs, biases};
    CauseLayers layers{scene::Image<Cause>{inputs.classes.size()},
                       scene::Image<Label>{inputs.classes.size()},
                       {},
                       {}};
    const auto every_pixel = [](std::size_t) { return true; };
    const std::int64_t units = amount_units(inputs.rule);
    const auto classify = [&](std::size_t begin, std::size_t end, Changes& sum) {
        segments.visit(begin, end, every_pixel,
                       [&](std::size_t pixel, const ErrorSegment& segment) {
                           layers.cause[pixel] = segment.cause;
                           layers.label[pixel] = segment.label;
                           sum.add(inputs.classes[pixel], segment);
                       });
    };
    const CountedRow counted =
        sum_over_runs(inputs.classes.pixel_count(), Changes{1, units}, classify).rows().front();
    layers.counts = counted.row.causes;
    layers.amounts = counted.units.amounts(units);
    return layers;
}

} // namespace gnomon::analysis
