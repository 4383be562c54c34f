#include "analysis/causes.hpp"

#include "analysis/lookup/exact_lookup.hpp"
#include "analysis/lookup/footprint.hpp"
#include "analysis/lookup/texel_hits.hpp"
#include "analysis/own_sheets.hpp"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gnomon::analysis {

using scene::Outside;
using scene::PixelClass;

namespace {

/// Taps that a thread holds at most: bounds the memory, whatever the image and filter.
constexpr double taps_at_once = 0x1p18;
/// Pixels along a side of a square that is explained at once: neighbours share texels, so that it
/// should not be too small, and what is kept of them fits a core's cache.
constexpr int largest_square_px = 128;
/// Pixels are collected in squares of this side, as neighbours share triangles too.
constexpr int step_px = 4;

int square_side_px(std::size_t taps_each)
{
    const double side = std::sqrt(taps_at_once / static_cast<double>(taps_each));
    return std::min(largest_square_px, static_cast<int>(side) / step_px * step_px);
}

class CauseFinder {
public:
    CauseFinder(const CauseInputs& inputs, CauseMemory* memory)
        : inputs_{inputs},
          memory_{memory},
          rule_{inputs.rule()},
          footprint_{inputs.lookup, inputs.resolution_texels},
          causes_{inputs.truth.pixel_class.size()}
    {
    }

    scene::Image<PixelCause> find()
    {
        const auto [width_px, height_px] = causes_.size();
        const int side = square_side_px(footprint_.tap_count());
        const tbb::blocked_range2d<int> squares{0, (height_px + side - 1) / side, 1,
                                                0, (width_px + side - 1) / side,  1};
        tbb::parallel_for(
            squares,
            [&](const tbb::blocked_range2d<int>& range) {
                for (int row = range.rows().begin(); row != range.rows().end(); ++row) {
                    for (int column = range.cols().begin(); column != range.cols().end();
                         ++column) {
                        explain({column * side, std::min(width_px, (column + 1) * side)},
                                {row * side, std::min(height_px, (row + 1) * side)});
                    }
                }
            },
            tbb::simple_partitioner{});
        return std::move(causes_);
    }

private:
    /// Coordinates from `begin` to before `end`.
    struct Range {
        int begin;
        int end;
    };

    /// Explains the pixels of a rectangle.
    void explain(const Range& columns, const Range& rows)
    {
        if (memory_ != nullptr && recall(columns, rows)) {
            return;
        }
        Lookups lit{{}, {}, footprint_.tap_count()};
        Lookups blocked{{}, {}, footprint_.tap_count()};
        const auto pixels = static_cast<std::size_t>(rows.end - rows.begin) *
                            static_cast<std::size_t>(columns.end - columns.begin);
        lit.pixels.reserve(pixels);
        lit.taps.reserve(pixels * lit.taps_each);
        for (int y0 = rows.begin; y0 < rows.end; y0 += step_px) {
            for (int x0 = columns.begin; x0 < columns.end; x0 += step_px) {
                for (int y = y0; y < std::min(y0 + step_px, rows.end); ++y) {
                    for (int x = x0; x < std::min(x0 + step_px, columns.end); ++x) {
                        collect(pixel_at(x, y), lit, blocked);
                    }
                }
            }
        }
        const TracedLookups traced_lit{std::move(lit), inputs_.light, inputs_.known_hits};
        const TracedLookups traced_blocked{std::move(blocked), inputs_.light, inputs_.known_hits};
        explain_lit(traced_lit);
        explain_blocked(traced_blocked);
        remember(traced_lit);
        remember(traced_blocked);
    }

    /// Takes over what is remembered of the rectangle's wrong pixels; true if that is all of them.
    /// Without branches: which pixels are wrong is hardly to be foreseen.
    bool recall(const Range& columns, const Range& rows)
    {
        constexpr PixelCause right;
        unsigned unknown = 0;
        for (int y = rows.begin; y < rows.end; ++y) {
            const std::size_t last = pixel_at(columns.end - 1, y);
            for (std::size_t pixel = pixel_at(columns.begin, y); pixel <= last; ++pixel) {
                const bool is_wrong_here = is_wrong(pixel);
                unknown |= static_cast<unsigned>(is_wrong_here) &
                           static_cast<unsigned>(!memory_->knows(pixel));
                causes_[pixel] = *(is_wrong_here ? &memory_->known(pixel) : &right);
            }
        }
        return unknown == 0;
    }

    /// Whether the map is wrong about it without any bias.
    [[nodiscard]] bool is_wrong(std::size_t pixel) const
    {
        const PixelClass truth = inputs_.truth.pixel_class[pixel];
        const bool is_lit = scene::is_lit(inputs_.unbiased.samples[pixel].verdict);
        return (static_cast<unsigned>(truth == PixelClass::lit && !is_lit) |
                static_cast<unsigned>(truth == PixelClass::blocked && is_lit)) != 0;
    }

    void remember(const TracedLookups& lookups)
    {
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            remember(lookups.pixel(i));
        }
    }
    void remember(std::size_t pixel)
    {
        if (memory_ != nullptr) {
            memory_->remember(pixel, causes_[pixel]);
        }
    }

    [[nodiscard]] std::size_t pixel_at(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(causes_.size().width_px) +
               static_cast<std::size_t>(x);
    }

    /// Keeps a wrong pixel that is not remembered.
    void collect(std::size_t pixel, Lookups& lit, Lookups& blocked)
    {
        if (!is_wrong(pixel) || (memory_ != nullptr && memory_->knows(pixel))) {
            return;
        }
        const bool is_lit_truth = inputs_.truth.pixel_class[pixel] == PixelClass::lit;
        const scene::LookupSample& sample = inputs_.unbiased.samples[pixel];
        Lookups& lookups = is_lit_truth ? lit : blocked;
        const std::size_t before = lookups.taps.size();
        footprint_.append_taps(inputs_.unbiased.texels[pixel], lookups.taps);
        if (rule_.is_policy(sample.receiver_depth, std::span{lookups.taps}.subspan(before))) {
            causes_[pixel] = {Cause::coverage, false, std::numeric_limits<float>::infinity()};
            remember(pixel);
            lookups.taps.resize(before);
            return;
        }
        lookups.pixels.push_back(pixel);
    }

    void explain_lit(const TracedLookups& lookups)
    {
        const auto critical = exact_critical_biases(rule_, lookups, inputs_.light);
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            const std::size_t pixel = lookups.pixel(i);
            // V3: nothing crosses the segment, so only a policy can shadow.
            const bool is_lit = !is_uncovered(pixel) || inputs_.lookup.outside == Outside::lit;
            causes_[pixel] = {is_lit ? Cause::resolution : Cause::coverage, false, critical[i]};
        }
        const auto own = sees_own_sheets(inputs_, lookups);
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            causes_[lookups.pixel(i)].sees = own[i];
        }
    }

    /// True where an infinitely fine map has nothing to say of P.
    [[nodiscard]] bool is_uncovered(std::size_t pixel) const
    {
        return !footprint_.is_inside(inputs_.unbiased.texels[pixel]) ||
               rule_.is_beyond_far(inputs_.unbiased.samples[pixel].receiver_depth);
    }

    void explain_blocked(const TracedLookups& lookups)
    {
        const auto critical = exact_critical_biases(rule_, lookups, inputs_.light);
        std::vector<std::size_t> lost; // exact depths do not help
        for (std::size_t i = 0; i < lookups.size(); ++i) {
            if (critical[i] > 0) {
                causes_[lookups.pixel(i)].unbiased = Cause::precision;
            } else {
                lost.push_back(lookups.pixel(i));
            }
        }
        const auto crossed = inputs_.light.are_crossed(lost);
        std::vector<std::size_t> between_texels;
        for (std::size_t i = 0; i < lost.size(); ++i) {
            const bool is_shadowed = is_uncovered(lost[i])
                                         ? inputs_.lookup.outside == Outside::shadowed
                                         : crossed[i] != 0;
            causes_[lost[i]].unbiased = is_shadowed ? Cause::resolution : Cause::coverage;
            if (is_shadowed) {
                between_texels.push_back(lost[i]);
            }
        }
        look_around(between_texels);
    }

    /// `sees`: some texel around the taps sees the blocker, or anything as near to the light.
    void look_around(std::span<const std::size_t> pixels)
    {
        std::vector<scene::Texel> texels;
        std::vector<std::size_t> ends;
        for (const std::size_t pixel : pixels) {
            const auto ring = footprint_.ring(inputs_.unbiased.texels[pixel]);
            texels.insert(texels.end(), ring.begin(), ring.end());
            ends.push_back(texels.size());
        }
        const TexelHits hits{inputs_.light, texels, scene::HitDetail::placed};
        const auto blockers = inputs_.light.find_blockers(pixels);
        std::size_t next = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const double middle_m = 0.5 * (blockers[i].zeta_m + blockers[i].receiver_zeta_m);
            for (; next < ends[i]; ++next) {
                causes_[pixels[i]].sees |= hits[texels[next]].zeta_m < middle_m;
            }
        }
    }

    const CauseInputs& inputs_;
    CauseMemory* memory_;
    LookupRule rule_;
    Footprint footprint_;
    scene::Image<PixelCause> causes_;
};

void require_sizes(const CauseInputs& inputs)
{
    const scene::ImageSize size = inputs.truth.pixel_class.size();
    if (inputs.unbiased.samples.size() != size || inputs.unbiased.texels.size() != size) {
        throw std::invalid_argument("find_causes: the lookup is not of the truth's size");
    }
    const scene::ImageSize map{inputs.resolution_texels, inputs.resolution_texels};
    if (!scene::promises(inputs.lookup.filter).has_one_tap() && inputs.map_depths.size() != map) {
        throw std::invalid_argument("find_causes: map_depths is not of the map's size");
    }
}

} // namespace

scene::Image<PixelCause> find_causes(const CauseInputs& inputs, CauseMemory* memory)
{
    require_sizes(inputs);
    if (memory != nullptr && !scene::promises(inputs.lookup.filter).has_one_tap()) {
        throw std::invalid_argument("find_causes: memory: only for the filter nearest");
    }
    return CauseFinder{inputs, memory}.find();
}

Label label_of(const PixelCause& pixel, PixelClass truth, Cause cause)
{
    if (truth == PixelClass::lit) {
        const bool is_by_map = cause == Cause::precision || cause == Cause::resolution;
        return !is_by_map ? Label::overshadow : (pixel.sees ? Label::acne : Label::edge);
    }
    if (cause == Cause::bias) {
        return Label::peter_panning;
    }
    return cause == Cause::resolution && pixel.sees ? Label::edge : Label::leak;
}

} // namespace gnomon::analysis
