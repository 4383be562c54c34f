#pragma once

#include "methods/lookup_traits.hpp"
#include "methods/passes.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/settings/job.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace gnomon::methods {

/// A kernel of a blur: weights along a line, of sum 1.
/// @param weights       "box" (equal) or "gaussian" (binomial coefficients over their sum).
/// @param width_texels  1, 3, 5, 7 or 9.
[[nodiscard]] const Kernel& blur_kernel(std::string_view weights, int width_texels);

/// A separable blur of a method's function of depth: along rows, then along columns. Its snippets
/// are compiled with KERNEL_ACROSS, CONTENT (float, vec2 or vec4, by the format) and COMPONENTS (r,
/// rg or rgba), and get the uniform `kernel`, the weights.
struct Blur {
    GlslSnippet rows;
    GlslSnippet columns;
    TexelFormat format = TexelFormat::rg32f;
};

/// A method's function of depth, to be averaged.
struct ContentOfDepths {
    std::string_view rows; ///< GLSL from `with_mean_of_rows`, in static memory
    std::vector<Definition> definitions = {};
    std::vector<Uniform> uniforms = {};
    TexelFormat format = TexelFormat::rg32f;
};
/// @param content  GLSL that defines `CONTENT content(float z)`.
/// @return  `content`, followed by its mean along rows.
[[nodiscard]] std::string with_mean_of_rows(std::string_view content);
[[nodiscard]] Blur mean_of(const ContentOfDepths& content);

/// Puts GLSL for a monotone `float exponential(float x)` in front of a snippet.
[[nodiscard]] std::string with_exponential(std::string_view snippet);

/// The keys of methods that blur their map: kernel, width, samples, levels, anisotropy.
[[nodiscard]] std::vector<scene::Key> blur_keys();
/// `method.bits`, the bits of each stored number: 16 or 32.
[[nodiscard]] const scene::Key& bits_key();
/// `method.bleeding_reduction`.
[[nodiscard]] const scene::Key& reduction_key();

/// A key's value in a job.
template <typename Value>
[[nodiscard]] Value value_in(const scene::Job& job, const scene::Key& key)
{
    return std::get<Value>(key.value_of(job.method));
}
/// Whether the job stores numbers in 16 bits.
[[nodiscard]] bool is_16_bit(const scene::Job& job);

/// The passes of the job's blur and the sampling of its last texture. The caller sets the lookup.
[[nodiscard]] Passes blur_passes(const scene::Job& job, const Blur& blur);
/// The uniforms `bleeding_reduction` and `stretch` of the job's lookup.
[[nodiscard]] std::vector<Uniform> reduction_uniforms(const scene::Job& job);

/// Traits of a verdict from the blurred texture that is exactly monotone in the bias and found by
/// bisection. Footprint, samples and memory follow from the job.
[[nodiscard]] LookupTraits blur_traits(const scene::Job& job, TexelFormat format);

/// Refuses point lights, maps of distances, colour formats and kernels wider than the map.
/// @throws scene::InputError
void check_blur(const scene::Job& job);

} // namespace gnomon::methods
