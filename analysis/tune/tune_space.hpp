#pragma once

#include "analysis/advice/judged_views.hpp"
#include "analysis/advice/tune_limits.hpp"
#include "scene/job/job.hpp"

#include <cstdint>
#include <vector>

namespace gnomon::analysis {

/// Resolutions and formats to try.
struct MapSize {
    int resolution_texels = 0;
    scene::DepthFormat format;
    int cascades = 0; ///< how many; 0: the layout is another

    std::uint64_t bytes = 0; ///< that the job's method takes for it

    friend bool operator==(const MapSize&, const MapSize&) = default;
};
/// Powers of two from 256 up and the job's own, in d16, d24, d32f and the job's own format, of
/// cascades 2, 3, 4 and the job's own number: from the fewest bytes, of as many the smaller
/// resolution first.
[[nodiscard]] std::vector<MapSize> map_sizes(const scene::Job& job, const TuneLimits& limits);

/// What the maps see.
struct MapShape {
    scene::FrustumSettings frustum;
    scene::CascadeSettings cascades; ///< but their number
};
/// The job's own, near and far, and the same with near and far fitted. One map: fitted to the scene
/// and to what the camera sees, too. Cascades: tight and, as far as the job has what it takes,
/// stabilised, split practically by 1/2 and 9/10. Each once.
[[nodiscard]] std::vector<MapShape> map_shapes(const scene::Job& job);

/// Those of them that make maps in every view, and are not another's in all views.
[[nodiscard]] std::vector<MapShape>
distinct_shapes(const scene::Job& job, const scene::SceneFile& file, const JudgedViews& views);

/// Whether a stabilised cascade's grid has the power of two that it needs; other maps need none.
[[nodiscard]] bool can_be_stable(const scene::ShadowMapSettings& map);

/// The kinds of culling other than the job's.
[[nodiscard]] std::vector<scene::Cull> other_culls(const scene::Job& job);

/// nearest, linear, pcf3, pcf5 and the job's own, by ascending taps; the job's own alone where its
/// method has none.
[[nodiscard]] std::vector<scene::Filter> tuned_filters(const scene::Job& job);

/// Normal offsets to try [texels], and slopes for a map [depth units per unit of tan θ]; ascending,
/// the job's own among them. Fewer for a filter whose verdicts are fractions: each costs as much as
/// a hundred others.
[[nodiscard]] std::vector<double> normal_offsets(const scene::Job& job, scene::Filter filter);
[[nodiscard]] std::vector<double> slopes(const scene::Job& job, scene::Filter filter,
                                         const scene::LightFrustum& frustum, int resolution_texels);

/// The job with this filter in place of its own.
[[nodiscard]] scene::Job with_filter(scene::Job job, scene::Filter filter);

} // namespace gnomon::analysis
