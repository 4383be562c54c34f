#pragma once

#include "scene/camera/camera.hpp"
#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/light/frustum.hpp"
#include "scene/light/light.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace gnomon::scene {

inline constexpr int least_cascades = 2;
inline constexpr int most_cascades = 8;

/// Where the slices of the camera's view end.
enum class CascadeSplit : std::uint8_t {
    uniform,     ///< all equally deep
    logarithmic, ///< each deeper than the one before by the same factor
    practical,   ///< between the two, by `split_lambda`
};

/// What a cascade's map covers of its slice.
enum class CascadeFit : std::uint8_t {
    tight,      ///< the smallest light-view box around its corners
    stabilised, ///< a sphere around it, on a grid of texels that stands still in the world
};

/// Which cascade a receiver reads.
enum class CascadeSelect : std::uint8_t {
    view_depth, ///< that of the slice in which it lies
    containing, ///< the first whose map contains it
};

/// "uniform", "logarithmic", "practical".
[[nodiscard]] std::string_view cascade_split_name(CascadeSplit split);
/// "tight", "stabilised".
[[nodiscard]] std::string_view cascade_fit_name(CascadeFit fit);
/// "view_depth", "containing".
[[nodiscard]] std::string_view cascade_select_name(CascadeSelect select);

/// The part of `[shadow_map]` that is for `layout = "cascades"`.
struct CascadeSettings {
    int count = 4; ///< [2, 8]
    CascadeSplit split = CascadeSplit::practical;
    double split_lambda = 0.5;    ///< [0, 1]; practical: 0 is uniform, 1 logarithmic
    std::optional<double> near_m; ///< view depth at which the first slice begins; empty: auto
    std::optional<double> far_m;  ///< view depth at which the last slice ends; empty: auto
    CascadeFit fit = CascadeFit::tight;
    CascadeSelect select = CascadeSelect::view_depth;
    /// [0, 0.999]: the share of a slice, at its end, in which the next one is mixed in.
    double blend = 0;
};

/// Where the slices of a camera's view begin and end: k + 1 view depths, ascending [m].
///
///     uniform:      n + (f − n)·i/k
///     logarithmic:  n·(f/n)^(i/k)
///     practical:    λ·logarithmic + (1 − λ)·uniform
///
/// n and f are the settings', or the view depths of the nearest and the farthest point of receiving
/// triangles inside the camera's view; occlusion is ignored.
/// Source: F. Zhang, H. Sun, L. Xu, L. K. Lun 2006, "Parallel-split shadow maps for large-scale
/// virtual environments".
/// @throws InputError  if n is not below f.
[[nodiscard]] std::vector<double> split_view(const CascadeSettings& settings,
                                             const TriangleScene& scene, const Camera& camera,
                                             ImageSize image);

/// What cascades are fitted to.
struct CascadeInputs {
    const CascadeSettings& cascades;
    const FrustumSettings& frustum;
    const LightSettings& light_settings;
    const Light& light; ///< directional
    const TriangleScene& scene;
    const Camera& camera;
    ImageSize image;
    int resolution_texels = 1; ///< of each map; a power of two where they are stabilised
};

/// The light's cameras, one for each slice between `splits`, nearest first; where neighbours are
/// mixed, a slice begins where the mixing does.
///
/// `tight`: the sides enclose the slice's eight corners; auto near and far are those of
/// `fit_light_frustum` within these sides, each map's own. `stabilised`: the sides enclose the
/// smallest sphere around the slice that is centred on the camera's axis, and half a texel more;
/// near and far are the same for all maps and, auto, around the whole scene. As long as the
/// settings and the image stay the same, the matrix's linear rows are the same bits wherever the
/// camera is and looks; its translation along u and v is a multiple of 2/N, N the resolution.
/// Source: M. Valient 2008, "Stable rendering of cascaded shadow maps", ShaderX6.
/// @throws InputError  as `fit_light_frustum`.
[[nodiscard]] std::vector<LightFrustum> fit_cascades(const CascadeInputs& inputs,
                                                     const std::vector<double>& splits);

} // namespace gnomon::scene
