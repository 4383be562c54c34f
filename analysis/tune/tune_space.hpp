#pragma once

#include "analysis/advice/checked_views.hpp"
#include "scene/settings/job.hpp"

#include <optional>
#include <vector>

namespace gnomon::analysis {

/// What the maps see.
struct MapShape {
    scene::FrustumSettings frustum;
    scene::CascadeSettings cascades; ///< but their number, where the layout is the job's own
    std::optional<scene::MapLayout> layout = {}; ///< empty: the job's own
};
/// The job's own, near and far, and the same with near and far fitted. One map: fitted to the scene
/// and to what the camera sees, too. Cascades: tight and, as far as the job has what it takes,
/// stabilised, split practically by 1/2 and 9/10. Each once.
[[nodiscard]] std::vector<MapShape> map_shapes(const scene::Job& job);

/// Those of them that make maps in every view, and are not another's in all views.
[[nodiscard]] std::vector<MapShape>
distinct_shapes(const scene::Job& job, const scene::SceneFile& file, const CheckedViews& views);

/// Beside these, for a directional light with one map: a map about all that is in shadow in the
/// views, and two and four tight cascades. Only such as make maps in every view.
[[nodiscard]] std::vector<MapShape>
shapes_of_sun(const scene::Job& job, const scene::SceneFile& file, const CheckedViews& views);

/// The job with a shape's maps.
[[nodiscard]] scene::Job with_shape(scene::Job job, const MapShape& shape);

/// `half_extent_m` of a directional light's map that holds all receivers in shadow in the views
/// [m].
/// @return  Empty, too, where the views' lights differ, or what lies outside the map would be in
///          shadow.
[[nodiscard]] std::optional<double> half_extent_of_shadows_m(const scene::Job& job,
                                                             const scene::SceneFile& file,
                                                             const CheckedViews& views);

/// Depth formats to try: d16, d24, d32f and the job's own, from the fewest bytes.
[[nodiscard]] std::vector<scene::DepthFormat> tuned_formats(const scene::Job& job);

/// Sides to try, descending: powers of two from 256 up to the limit, and the job's own where that
/// is not larger. Of several maps the largest is half as large, and the bytes of four are as many.
[[nodiscard]] std::vector<int> tuned_resolutions(const scene::Job& job, int most_texels);

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
