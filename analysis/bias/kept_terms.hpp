#pragma once

#include "analysis/bias/map_offsets.hpp"
#include "renderers/rasterizer.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <optional>

namespace gnomon::analysis {

/// The bias terms beside constant and slope, as V2 keeps them for a lit pixel (docs/causes.md).
struct KeptTerms {
    scene::LookupTerms lookup;
    std::optional<MapOffsets> offsets; ///< of the map; empty where it is drawn without
    bool compares_at_once = false;     ///< GL compares all taps with one depth
    bool is_reversed = false;

    /// What the terms of taps add to the receiver's depth before it is compared with a tap.
    /// @param centre  of the tap's texel, before any clamping.
    /// @param point   that is looked up; both in texels.
    [[nodiscard]] float rise(std::size_t pixel, const scene::Vec2f& centre,
                             const scene::Vec2f& point) const;
};

/// Those of a job, of which this is known; empty where no such term acts.
[[nodiscard]] std::optional<KeptTerms> make_kept_terms(const scene::Job& job,
                                                       const scene::View& view,
                                                       scene::LookupTerms terms,
                                                       std::optional<MapOffsets> offsets);

/// Those of a job that is drawn; empty where no such term acts.
/// @param triangles  must outlive it.
[[nodiscard]] std::optional<KeptTerms> find_kept_terms(const scene::Job& job,
                                                       const scene::View& view,
                                                       const scene::TriangleScene& triangles,
                                                       const renderers::Drawn& drawn,
                                                       renderers::Rasterizer& rasterizer);

} // namespace gnomon::analysis
