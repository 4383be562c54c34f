#pragma once

#include "analysis/bias/kept_terms.hpp"
#include "analysis/lookup/lookup_rule.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/vec.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::analysis {

/// What the reach of biases follows from.
struct GapReachInputs {
    const scene::Job& job;
    const scene::View& view;
    const LookupRule& rule;
    const scene::LookupLayers& lookup;
    const KeptTerms* terms; ///< nullptr: only constant and slope, or not recorded
    const scene::Image<float>& light_distance_m;
    const scene::Image<std::uint32_t>& receivers;
};

/// How far the biases of a lookup reach from a receiver to what should have shadowed it: the length
/// of the normal offset, and that of all depth biases at P together.
class GapReach {
public:
    /// What the inputs refer to must outlive this.
    explicit GapReach(const GapReachInputs& inputs);

    /// @param constant, slope  depth units
    /// @return  [m]; infinite where the other terms are not known.
    [[nodiscard]] double metres(std::size_t pixel, float constant, float slope) const;

private:
    /// How far the point that is looked up is moved [m].
    [[nodiscard]] double moved_m(std::size_t pixel) const;
    /// What the terms beside constant and slope bring the receiver's depth nearer to the light by:
    /// where taps differ, the most that a tap inside of the kernel's width has.
    [[nodiscard]] double nearer(std::size_t pixel) const;
    [[nodiscard]] double offset_of_map(std::size_t pixel) const;
    [[nodiscard]] std::size_t map_of(std::size_t pixel) const
    {
        return static_cast<std::size_t>(scene::map_of(in_.lookup.maps, pixel));
    }

    GapReachInputs in_;
    /// By map, the length that renderers which do not tell their terms offset along the normal: at
    /// ζ = 0, and what it grows by per metre of ζ; empty where that is not all that is not told.
    std::optional<std::vector<scene::Vec2d>> untold_m_;
};

} // namespace gnomon::analysis
