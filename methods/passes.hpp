#pragma once

#include "methods/lookup_traits.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::methods {

/// How GL is to sample a texture.
enum class Sampling : std::uint8_t {
    fetched,      ///< texel by texel
    interpolated, ///< bilinearly
    compared,     ///< comparisons of depths with 2 × 2 texels, bilinearly
};

/// What a texture's texels hold.
enum class TexelFormat : std::uint8_t { r16f, r32f, rg16, rg16f, rg32f, rgba16, rgba16f, rgba32f };

/// Preprocessor definitions that a piece is compiled with.
struct Definition {
    std::string name;
    std::string value;
};

/// Defined by pieces that read `Receiver::vertex_normal`: receivers must be drawn with normals.
inline constexpr std::string_view vertex_normals_definition = "VERTEX_NORMALS";

/// The value of a uniform of a piece: a float, or an array of floats.
struct Uniform {
    std::string name;
    std::vector<float> values;
};

/// A piece of GLSL, and what it is given.
struct GlslSnippet {
    std::string_view glsl; ///< its text, which stands for ever
    std::vector<Definition> definitions = {};
    std::vector<Uniform> uniforms = {};
};

/// A pass of the stage *prefilter*: makes a texture as large as the map from the one before it, the
/// first from the depths that were drawn. Its piece defines
///
///     vec4 texel(ivec2 at)
///
/// what the texel holds; raster_gl/shaders/prefilter_source.glsl is what it may call, and SAMPLES
/// is how many depths of each texel the first reads (`Passes::depths_of_texel`), the others 1.
struct PrefilterPass {
    GlslSnippet snippet;
    TexelFormat format = TexelFormat::rg32f;
};

/// How the sides of shadow volumes are drawn.
enum class Extrusion : std::uint8_t {
    silhouette, ///< of the casters' silhouettes
    triangle,   ///< of each caster
};

/// Shadow volumes, which the camera's view is counted with: a receiver is in shadow that is in any.
struct ShadowVolumes {
    Extrusion extrusion = Extrusion::silhouette;
    Casters casters = Casters::all;

    friend bool operator==(const ShadowVolumes&, const ShadowVolumes&) = default;
};

/// What GL is to do for a job, after the casters' depths are drawn. The lookup's piece defines
///
///     float visibility(float r, float bias, vec2 uv, vec2 texel, out float d)
///
/// the verdict in [0, 1], and d, the depth looked up; raster_gl/shaders/lookup_map.glsl is what it
/// may call, and TAPS_ACROSS is `Promises::width_texels`.
struct Passes {
    std::vector<PrefilterPass> prefilter;
    int samples = 1; ///< of each texel, that the casters are drawn with for the first pass
    int layers = 1; ///< 2: the casters are drawn again for the first pass, what lies first and what
                    ///< lies behind it
    bool draws_primitives = false; ///< beside depths, which triangle each texel shows
    GlslSnippet lookup;
    Sampling sampling = Sampling::fetched; ///< of the last pass's texture, else of the depths
    bool makes_mipmaps = false;            ///< of the last pass's texture
    int anisotropy = 1;                    ///< most samples along a pixel's longer side there
    /// What the last pass makes of depth 0, and of depth 1: beyond the map's edge, by border mode.
    std::array<std::array<float, 4>, 2> of_ends{{{0, 0, 0, 0}, {1, 1, 1, 1}}};
    std::optional<ShadowVolumes> volumes; ///< in place of all else: there is no map

    /// How many depths of each texel the first pass reads.
    [[nodiscard]] int depths_of_texel() const { return layers > 1 ? layers : samples; }
    /// Whether the lookup's piece has `uv_dx` and `uv_dy`, the change of uv to the next pixel.
    [[nodiscard]] bool has_gradients() const { return makes_mipmaps || anisotropy > 1; }
};

} // namespace gnomon::methods
