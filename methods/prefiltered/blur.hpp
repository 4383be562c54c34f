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

/// What a method stores of depths, averaged by the job's kernel along rows and then along columns.
/// Its pieces are compiled with KERNEL_ACROSS, CONTENT (float, vec2 or vec4, by the format) and
/// COMPONENTS (r, rg or rgba), and given `kernel`, its weights.
struct Blur {
    GlslSnippet rows;
    GlslSnippet columns;
    TexelFormat format = TexelFormat::rg32f;
};

/// What a method stores of a depth, to be averaged by sums.
struct ContentOfDepths {
    std::string_view rows; ///< GLSL from `with_mean_of_rows`; it stands for ever
    std::vector<Definition> definitions = {};
    std::vector<Uniform> uniforms = {};
    TexelFormat format = TexelFormat::rg32f;
};
/// @param content  GLSL that defines `CONTENT content(float z)`.
/// @return  It, and the mean of it along rows.
[[nodiscard]] std::string with_mean_of_rows(std::string_view content);
[[nodiscard]] Blur mean_of(const ContentOfDepths& content);

/// GLSL of `float exponential(float x)`, which never falls when x rises, and then the piece's.
[[nodiscard]] std::string with_exponential(std::string_view snippet);

/// Keys of all methods that blur their map: kernel, width, samples, levels, anisotropy.
[[nodiscard]] std::vector<scene::Key> blur_keys();
/// `method.bits`, of each number that is stored: 16 or 32.
[[nodiscard]] const scene::Key& bits_key();
/// `method.bleeding_reduction`.
[[nodiscard]] const scene::Key& reduction_key();

/// A key's value in a job, of its own type.
template <typename Value>
[[nodiscard]] Value value_in(const scene::Job& job, const scene::Key& key)
{
    return std::get<Value>(key.value_of(job.method));
}
/// Whether the job's numbers are stored in 16 bits.
[[nodiscard]] bool is_16_bit(const scene::Job& job);

/// The passes of the job's blur, and how its last texture is sampled; the lookup is left to set.
[[nodiscard]] Passes blur_passes(const scene::Job& job, const Blur& blur);
/// The uniforms `bleeding_reduction` and `stretch` of the job's lookup.
[[nodiscard]] std::vector<Uniform> reduction_uniforms(const scene::Job& job);

/// Promises of a verdict by the blurred texture, bounded or not, that rises exactly with the bias
/// and is found by bisection: footprint, samples and memory follow from the job.
[[nodiscard]] LookupTraits blur_traits(const scene::Job& job, TexelFormat format);

/// Refuses point lights, distances, colour formats and kernels wider than the map.
/// @throws scene::InputError
void check_blur(const scene::Job& job);

} // namespace gnomon::methods
