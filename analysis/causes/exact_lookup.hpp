#pragma once

#include "analysis/bias/kept_terms.hpp"
#include "analysis/lookup/footprint.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "analysis/lookup/texel_hits.hpp"
#include "renderers/light_queries.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::analysis {

/// The lookups of some receivers, flattened: all have equally many taps.
struct Lookups {
    std::vector<std::size_t> pixels;
    std::vector<Tap> taps;
    std::size_t taps_each = 1;
    std::vector<scene::Texel> first_taps; ///< lower left tap of each lookup, before any clamping
    std::vector<scene::MapPoint> points;  ///< where each lookup reads

    [[nodiscard]] std::span<const Tap> taps_of(std::size_t i) const
    {
        return std::span{taps}.subspan(i * taps_each, taps_each);
    }
};

/// Lookups, with the first surface that the light sees through each tap's texel.
class TracedLookups {
public:
    /// @param known  Hits that need no tracing; may be null; must outlive this.
    TracedLookups(Lookups lookups, const renderers::LightQueries& light,
                  const TexelHits* known = nullptr);
    TracedLookups(const TracedLookups&) = delete; // `hits_` points into `texels_`
    TracedLookups& operator=(const TracedLookups&) = delete;

    [[nodiscard]] std::size_t size() const { return lookups_.pixels.size(); }
    [[nodiscard]] std::size_t pixel(std::size_t i) const { return lookups_.pixels[i]; }
    [[nodiscard]] scene::Texel first_tap(std::size_t i) const { return lookups_.first_taps[i]; }
    [[nodiscard]] std::span<const Tap> taps_of(std::size_t i) const { return lookups_.taps_of(i); }
    /// Hits of a lookup's taps; null where there is no texel.
    [[nodiscard]] std::span<const renderers::TexelHit* const> hits_of(std::size_t i) const
    {
        return std::span{hits_}.subspan(i * lookups_.taps_each, lookups_.taps_each);
    }
    [[nodiscard]] std::size_t tap_count() const { return hits_.size(); }
    /// Where a lookup reads.
    [[nodiscard]] const scene::MapPoint& at(std::size_t i) const { return lookups_.points[i]; }

private:
    Lookups lookups_;
    TexelHits texels_;
    std::vector<const renderers::TexelHit*> hits_;
};

/// The share of a lookup's weight that is lit.
enum class LitShare {
    any,  ///< more than 1/256
    half, ///< at least one half
    full, ///< all but at most 1/256
};

/// How to compare the depths of receivers and taps.
struct ExactComparison {
    const LookupRule& rule;
    const renderers::LightQueries& light;
    /// The bias terms to keep; null if there are none.
    const KeptTerms* kept = nullptr;
    /// Taps that count as lit at any bias, by lookup; may be empty. Ignored if depths are
    /// interpolated.
    std::span<const TapSet> always_lit = {};
};

/// V2: for each receiver the smallest bias at which its lookup over exact depths reaches this share
/// of light (docs/causes.md). −∞ or +∞ if the taps that the border mode decides suffice. A lookup
/// with one comparison is either lit or not.
[[nodiscard]] std::vector<float> exact_critical_biases(const ExactComparison& comparison,
                                                       const TracedLookups& lookups,
                                                       LitShare share);

/// V2n: as `exact_critical_biases`, for one tap of each lookup.
/// @param taps  Index of the tap in the footprint, by lookup.
[[nodiscard]] std::vector<float> exact_tap_biases(const ExactComparison& comparison,
                                                  const TracedLookups& lookups,
                                                  std::span<const std::size_t> taps);

} // namespace gnomon::analysis
