#include "analysis/recommendation/broad_minimum.hpp"

#include "analysis/bias/bias_curve.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace gnomon::analysis {

namespace {

constexpr double broad_ratio = 1.5; // between a run's ends

bool is_broad(const BiasInterval& run)
{
    return run.lo <= 0 || double{run.hi} >= broad_ratio * double{run.lo};
}

/// The lowest broad run of neighbouring pieces whose errors are at most `level`.
std::optional<BiasInterval> broad_run(std::span<const ErrorPiece> pieces, double level)
{
    std::optional<BiasInterval> run;
    for (const ErrorPiece& piece : pieces) {
        if (piece.error <= level) {
            run = BiasInterval{run ? run->lo : piece.lo, piece.hi};
        } else if (run && is_broad(*run)) {
            break;
        } else {
            run.reset();
        }
    }
    return run && is_broad(*run) ? run : std::nullopt;
}

/// The lowest sufficient level and its run, found by bisection: higher levels have longer runs.
std::optional<BroadMinimum> at_least_level(std::span<const ErrorPiece> pieces, double least,
                                           double first_level)
{
    if (const auto run = broad_run(pieces, first_level)) {
        return BroadMinimum{*run, least, first_level};
    }
    std::vector<double> levels;
    for (const ErrorPiece& piece : pieces) {
        if (piece.error > first_level) {
            levels.push_back(piece.error);
        }
    }
    std::optional<BroadMinimum> broad_minimum;
    for (auto first = levels.begin(), last = levels.end(); first != last;) {
        const auto middle = first + (last - first) / 2;
        std::nth_element(first, middle, last); // cheaper in total than sorting
        if (const auto run = broad_run(pieces, *middle)) {
            broad_minimum = BroadMinimum{*run, least, *middle};
            last = middle;
        } else {
            first = middle + 1;
        }
    }
    return broad_minimum;
}

} // namespace

std::vector<ErrorPiece> error_pieces(std::span<const float> lit, std::span<const float> blocked)
{
    const auto positive = [](std::span<const float> criticals) {
        const auto first = std::ranges::upper_bound(criticals, 0.0F);
        return criticals.subspan(static_cast<std::size_t>(first - criticals.begin()));
    };
    const std::span<const float> lit_from = positive(lit);
    const std::span<const float> blocked_from = positive(blocked);
    const std::uint64_t lit_at_zero = blocked.size() - blocked_from.size(); // despite being blocked
    std::vector<ErrorPiece> pieces;
    pieces.reserve(lit_from.size() + blocked_from.size() + 1);
    for_each_interval(lit_from, blocked_from,
                      [&](const BiasInterval& interval, const ErrorCounts& errors) {
                          pieces.push_back({std::max(interval.lo, 0.0F), interval.hi,
                                            static_cast<double>(errors.total() + lit_at_zero)});
                      });
    return pieces;
}

std::optional<BroadMinimum> find_broad_minimum(std::span<const ErrorPiece> pieces)
{
    if (pieces.empty()) {
        return std::nullopt;
    }
    const double least = std::ranges::min_element(pieces, {}, &ErrorPiece::error)->error;
    return at_least_level(pieces, least, least + std::sqrt(least));
}

std::optional<float> allowed_bias(const BiasInterval& run, float recommended,
                                  std::span<const BiasInterval> allowed)
{
    std::optional<float> nearest;
    for (const BiasInterval& interval : allowed) {
        const float lo = std::max(interval.lo, run.lo);
        const float hi = std::min(interval.hi, run.hi);
        const float candidate = std::clamp(recommended, lo, std::max(lo, hi));
        const auto distance = [&](float bias) {
            return std::abs(double{bias} - double{recommended});
        };
        if (lo <= hi && (!nearest || distance(candidate) < distance(*nearest))) {
            nearest = candidate;
        }
    }
    if (nearest) {
        return nearest;
    }
    return allowed.empty() ? std::nullopt : std::optional{allowed.front().lo};
}

} // namespace gnomon::analysis
