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

/// Receivers with the taps of their lookups, flattened: as many taps for each.
struct Lookups {
    std::vector<std::size_t> pixels;
    std::vector<Tap> taps;
    std::size_t taps_each = 1;
    std::vector<scene::Texel> first_taps; ///< of each the lower left tap, before any clamping
    std::vector<scene::MapPoint> points;  ///< where each reads

    [[nodiscard]] std::span<const Tap> taps_of(std::size_t i) const
    {
        return std::span{taps}.subspan(i * taps_each, taps_each);
    }
};

/// Lookups, and what the light sees through the texel of each tap.
class TracedLookups {
public:
    /// @param known  hits that need not be traced again; may be null, and must outlive the lookups.
    TracedLookups(Lookups lookups, const renderers::LightQueries& light,
                  const TexelHits* known = nullptr);
    TracedLookups(const TracedLookups&) = delete; // `hits_` points into `texels_`
    TracedLookups& operator=(const TracedLookups&) = delete;

    [[nodiscard]] std::size_t size() const { return lookups_.pixels.size(); }
    [[nodiscard]] std::size_t pixel(std::size_t i) const { return lookups_.pixels[i]; }
    [[nodiscard]] scene::Texel first_tap(std::size_t i) const { return lookups_.first_taps[i]; }
    [[nodiscard]] std::span<const Tap> taps_of(std::size_t i) const { return lookups_.taps_of(i); }
    /// Of each tap of a lookup; null where there is no texel.
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

/// How much of a lookup's weight is lit.
enum class LitShare {
    any,  ///< more than 1/256
    half, ///< at least one half
    full, ///< all but at most 1/256
};

/// How the depths of receivers and of taps are compared.
struct ExactComparison {
    const LookupRule& rule;
    const renderers::LightQueries& light;
    /// The bias terms that are kept; nullptr: none.
    const KeptTerms* kept = nullptr;
    /// Taps that count as lit whatever the bias, by lookup; may be empty. Not read where depths are
    /// interpolated.
    std::span<const TapSet> always_lit = {};
};

/// V2: for each receiver the smallest bias with which exact depths at the lookup's taps are lit to
/// this share (docs/causes.md); −∞ or +∞ where taps that the border mode decides are enough. A
/// lookup with one comparison is lit or not.
[[nodiscard]] std::vector<float> exact_critical_biases(const ExactComparison& comparison,
                                                       const TracedLookups& lookups,
                                                       LitShare share);

/// V2n: the same of one tap each.
/// @param taps  its place in the footprint, by lookup.
[[nodiscard]] std::vector<float> exact_tap_biases(const ExactComparison& comparison,
                                                  const TracedLookups& lookups,
                                                  std::span<const std::size_t> taps);

} // namespace gnomon::analysis
