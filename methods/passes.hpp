#pragma once

#include "methods/lookup_traits.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::methods {

/// How GL samples a texture.
enum class Sampling : std::uint8_t {
    fetched,      ///< texel by texel
    interpolated, ///< bilinearly
    compared,     ///< comparisons of depths with 2 × 2 texels, bilinearly
};

/// The format of a texture's texels.
enum class TexelFormat : std::uint8_t { r16f, r32f, rg16, rg16f, rg32f, rgba16, rgba16f, rgba32f };

/// A preprocessor definition for a snippet.
struct Definition {
    std::string name;
    std::string value;
};

/// Defined by snippets that read `Receiver::vertex_normal`; receivers are then drawn with normals.
inline constexpr std::string_view vertex_normals_definition = "VERTEX_NORMALS";

/// The value of a snippet's uniform: a float or an array of floats.
struct Uniform {
    std::string name;
    std::vector<float> values;
};

/// A GLSL snippet with its definitions and uniforms.
struct GlslSnippet {
    std::string_view glsl; ///< its text, in static memory
    std::vector<Definition> definitions = {};
    std::vector<Uniform> uniforms = {};
};

/// A pass of the stage *prefilter*. It renders a texture as large as the map from the previous one;
/// the first reads the drawn depths. Its snippet defines
///
///     vec4 texel(ivec2 at)
///
/// the value of the texel. It may call raster_gl/shaders/prefilter_source.glsl. SAMPLES is the
/// number of depths that the first pass reads per texel (`Passes::depths_of_texel`); 1 in other
/// passes.
struct PrefilterPass {
    GlslSnippet snippet;
    TexelFormat format = TexelFormat::rg32f;
};

/// How the sides of shadow volumes are drawn.
enum class Extrusion : std::uint8_t {
    silhouette, ///< of the casters' silhouettes
    triangle,   ///< of each caster
};

/// Shadow volumes, counted in the camera's view: receivers inside any volume are in shadow.
struct ShadowVolumes {
    Extrusion extrusion = Extrusion::silhouette;
    Casters casters = Casters::all;

    friend bool operator==(const ShadowVolumes&, const ShadowVolumes&) = default;
};

/// The GL passes of a job after the casters' depths are drawn. The lookup's snippet defines
///
///     float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
///
/// the verdict in [0, 1], and d, the depth looked up. It may call
/// raster_gl/shaders/lookup_map.glsl. TAPS_ACROSS is `LookupTraits::width_texels`.
struct Passes {
    std::vector<PrefilterPass> prefilter;
    int samples = 1;               ///< of each texel, when casters are drawn for the first pass
    int layers = 1;                ///< 2: the first pass also gets the surface behind the first one
    bool draws_primitives = false; ///< draws each texel's triangle, too
    GlslSnippet lookup;
    Sampling sampling = Sampling::fetched; ///< of the last pass's texture, else of the depths
    bool makes_mipmaps = false;            ///< of the last pass's texture
    int anisotropy = 1;                    ///< most samples along a pixel's longer side there
    /// The last pass's texels for depths 0 and 1, used beyond the map's edge by border mode.
    std::array<std::array<float, 4>, 2> of_ends{{{0, 0, 0, 0}, {1, 1, 1, 1}}};
    std::optional<ShadowVolumes> volumes; ///< instead of everything else: no map

    /// Number of depths per texel that the first pass reads.
    [[nodiscard]] int depths_of_texel() const { return layers > 1 ? layers : samples; }
    /// Whether the lookup's snippet gets `uv_dx` and `uv_dy`, the change of uv to the next pixel.
    [[nodiscard]] bool has_gradients() const { return makes_mipmaps || anisotropy > 1; }
};

} // namespace gnomon::methods
