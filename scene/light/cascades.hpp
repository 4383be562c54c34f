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
    uniform,     ///< equally deep slices
    logarithmic, ///< each slice deeper by the same factor
    practical,   ///< a mix of both, by `split_lambda`
};

/// How a cascade's map encloses its slice.
enum class CascadeFit : std::uint8_t {
    tight,      ///< the smallest light-view box around its corners
    stabilised, ///< a sphere around it, on a grid of texels that stands still in the world
};

/// Which cascade a receiver reads.
enum class CascadeSelect : std::uint8_t {
    view_depth, ///< the cascade of its slice
    containing, ///< the first cascade whose map contains it
};

/// "uniform", "logarithmic", "practical".
[[nodiscard]] std::string_view cascade_split_name(CascadeSplit split);
/// "tight", "stabilised".
[[nodiscard]] std::string_view cascade_fit_name(CascadeFit fit);
/// "view_depth", "containing".
[[nodiscard]] std::string_view cascade_select_name(CascadeSelect select);

/// The keys of `[shadow_map]` for `layout = "cascades"`.
struct CascadeSettings {
    int count = 4; ///< [2, 8]
    CascadeSplit split = CascadeSplit::practical;
    double split_lambda = 0.5;    ///< [0, 1]; practical: 0 is uniform, 1 logarithmic
    std::optional<double> near_m; ///< view depth at which the first slice begins; empty: auto
    std::optional<double> far_m;  ///< view depth at which the last slice ends; empty: auto
    CascadeFit fit = CascadeFit::tight;
    CascadeSelect select = CascadeSelect::view_depth;
    /// [0, 0.999]: the share of a slice, at its end, that is blended with the next cascade.
    double blend = 0;
};

/// Where the slices of a camera's view begin and end: k + 1 view depths, ascending [m].
///
///     uniform:      n + (f − n)·i/k
///     logarithmic:  n·(f/n)^(i/k)
///     practical:    λ·logarithmic + (1 − λ)·uniform
///
/// n and f come from the settings, or are the view depths of the nearest and farthest point of
/// receiving triangles in the camera's view, ignoring occlusion.
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
    int resolution_texels = 1; ///< of each map; a power of two if stabilised
};

/// The light's cameras, one for each slice between `splits`, nearest first. If neighbours are
/// blended, a slice begins where the blending does.
///
/// `tight`: the sides enclose the slice's eight corners; each map's auto near and far are those of
/// `fit_light_frustum` within these sides. `stabilised`: the sides enclose the smallest sphere
/// around the slice with its centre on the camera's axis, plus half a texel. All maps share near
/// and far; if auto, around the whole scene. With constant settings and image, the linear part of
/// the matrix is bit-identical for every camera pose, and the translation along u and v is a
/// multiple of 2/N, N the resolution.
/// Source: M. Valient 2008, "Stable rendering of cascaded shadow maps", ShaderX6.
/// @throws InputError  as `fit_light_frustum`.
[[nodiscard]] std::vector<LightFrustum> fit_cascades(const CascadeInputs& inputs,
                                                     const std::vector<double>& splits);

} // namespace gnomon::scene
