#pragma once

#include "analysis/advice/checked_views.hpp"
#include "scene/settings/job.hpp"

#include <optional>
#include <vector>

namespace gnomon::analysis {

/// The space that the maps cover.
struct MapShape {
    scene::FrustumSettings frustum;
    scene::CascadeSettings cascades; ///< without their number, if the layout is the job's own
    std::optional<scene::MapLayout> layout = {}; ///< empty: the job's own
};
/// Shapes of maps to try, each once: the job's own, and that with near and far fitted. A single map
/// is also fitted to the scene, and to what the camera sees. Cascades are also tight and, if the
/// job has near and far, stabilised, with practical splits of 1/2 and 9/10.
[[nodiscard]] std::vector<MapShape> map_shapes(const scene::Job& job);

/// Those of `map_shapes` that are valid in every view, without duplicates.
[[nodiscard]] std::vector<MapShape>
distinct_shapes(const scene::Job& job, const scene::SceneFile& file, const CheckedViews& views);

/// More shapes for a directional light with one map: a map around all that is in shadow in the
/// views, and two and four tight cascades. Only shapes that are valid in every view.
[[nodiscard]] std::vector<MapShape>
shapes_of_sun(const scene::Job& job, const scene::SceneFile& file, const CheckedViews& views);

/// The job with a shape's maps.
[[nodiscard]] scene::Job with_shape(scene::Job job, const MapShape& shape);

/// `half_extent_m` of a directional light's map that holds all shadowed receivers of the views [m].
/// @return  Also empty if the views' lights differ, or everything outside the map is in shadow.
[[nodiscard]] std::optional<double> half_extent_of_shadows_m(const scene::Job& job,
                                                             const scene::SceneFile& file,
                                                             const CheckedViews& views);

/// Depth formats to try, by ascending bytes: d16, d24, d32f and the job's own.
[[nodiscard]] std::vector<scene::DepthFormat> tuned_formats(const scene::Job& job);

/// Sides to try, descending: powers of two from 256 to the limit, and the job's own up to it. With
/// several maps the largest is half as large, so that four take as many bytes.
[[nodiscard]] std::vector<int> tuned_resolutions(const scene::Job& job, int most_texels);

/// Whether a stabilised cascade's grid has the power of two that it needs; other maps pass.
[[nodiscard]] bool can_be_stable(const scene::ShadowMapSettings& map);

/// The kinds of culling other than the job's.
[[nodiscard]] std::vector<scene::Cull> other_culls(const scene::Job& job);

/// nearest, linear, pcf3, pcf5 and the job's own, by ascending taps; only the job's own if its
/// method has no filters.
[[nodiscard]] std::vector<scene::Filter> tuned_filters(const scene::Job& job);

/// Normal offsets to try [texels], and slopes for a map [depth units per unit of tan θ]; ascending,
/// with the job's own. Fewer if verdicts are fractions: each then costs as much as a hundred
/// others.
[[nodiscard]] std::vector<double> normal_offsets(const scene::Job& job, scene::Filter filter);
[[nodiscard]] std::vector<double> slopes(const scene::Job& job, scene::Filter filter,
                                         const scene::LightFrustum& frustum, int resolution_texels);

/// The job with this filter in place of its own.
[[nodiscard]] scene::Job with_filter(scene::Job job, scene::Filter filter);

} // namespace gnomon::analysis
