#include "methods/prefiltered/blur.hpp"

#include "methods/depth/depth_map.hpp"
#include "methods/gl_depth.hpp"
#include "methods/glsl.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <utility>

namespace gnomon::methods {
namespace {

/// The kernels' weights along a line.
constexpr std::array<float, 1> one{1.0F};
constexpr std::array<float, 3> box3{1 / 3.0F, 1 / 3.0F, 1 / 3.0F};
constexpr std::array<float, 5> box5{0.2F, 0.2F, 0.2F, 0.2F, 0.2F};
constexpr std::array<float, 7> box7{1 / 7.0F, 1 / 7.0F, 1 / 7.0F, 1 / 7.0F,
                                    1 / 7.0F, 1 / 7.0F, 1 / 7.0F};
constexpr std::array<float, 9> box9{1 / 9.0F, 1 / 9.0F, 1 / 9.0F, 1 / 9.0F, 1 / 9.0F,
                                    1 / 9.0F, 1 / 9.0F, 1 / 9.0F, 1 / 9.0F};
/// Binomial coefficients over their sum: exact.
constexpr std::array<float, 3> gaussian3{0.25F, 0.5F, 0.25F};
constexpr std::array<float, 5> gaussian5{1 / 16.0F, 4 / 16.0F, 6 / 16.0F, 4 / 16.0F, 1 / 16.0F};
constexpr std::array<float, 7> gaussian7{1 / 64.0F,  6 / 64.0F, 15 / 64.0F, 20 / 64.0F,
                                         15 / 64.0F, 6 / 64.0F, 1 / 64.0F};
constexpr std::array<float, 9> gaussian9{1 / 256.0F,  8 / 256.0F,  28 / 256.0F,
                                         56 / 256.0F, 70 / 256.0F, 56 / 256.0F,
                                         28 / 256.0F, 8 / 256.0F,  1 / 256.0F};
constexpr std::array<Kernel, 5> box_kernels{{{one}, {box3}, {box5}, {box7}, {box9}}};
constexpr std::array<Kernel, 5> gaussian_kernels{
    {{one}, {gaussian3}, {gaussian5}, {gaussian7}, {gaussian9}}};

} // namespace

const Kernel& blur_kernel(std::string_view weights, int width_texels)
{
    const auto& kernels = weights == "box" ? box_kernels : gaussian_kernels;
    return kernels.at(static_cast<std::size_t>(width_texels / 2));
}

namespace {

using scene::Key;
using scene::Stage;

const Key& blur_kernel_key()
{
    static const Key key =
        scene::added_key(scene::make_key("method.kernel", "weights of the blur's mean", "",
                                         scene::only(Stage::prefilter)),
                         scene::WordDomain{.words = {"box", "gaussian"}}, std::string{"box"},
                         {.values = {std::string{"gaussian"}}});
    return key;
}
const Key& blur_width_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.kernel_width", "{unit} across that the map is averaged over", "",
                        scene::only(Stage::prefilter), "texels"),
        scene::IntegerDomain{1, 9, 2}, std::int64_t{5},
        {.values = {std::int64_t{3}, std::int64_t{9}}});
    return key;
}
const Key& blur_samples_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.samples",
                        "depths of each texel that the mean is of, at GL's places of so many", "",
                        scene::only(Stage::prefilter), "samples"),
        scene::IntegerDomain{.lower = 1, .upper = 8, .is_power_of_two = true}, std::int64_t{1},
        {.values = {std::int64_t{4}}});
    return key;
}
const Key& blur_mips_key()
{
    static const Key key =
        scene::added_key(scene::make_key("method.mips",
                                         "averages over a pixel, by coarser levels of the "
                                         "blurred map",
                                         "", scene::only(Stage::prefilter)),
                         scene::FlagDomain{}, false, {.values = {true}});
    return key;
}
const Key& blur_anisotropy_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.anisotropy", "most {unit} along a pixel's longer side", "",
                        scene::only(Stage::lookup), "samples"),
        scene::IntegerDomain{1, 16}, std::int64_t{1}, {.values = {std::int64_t{4}}});
    return key;
}

const Kernel& kernel_in(const scene::Job& job)
{
    return blur_kernel(value_in<std::string>(job, blur_kernel_key()),
                       static_cast<int>(value_in<std::int64_t>(job, blur_width_key())));
}

int samples_in(const scene::Job& job)
{
    return static_cast<int>(value_in<std::int64_t>(job, blur_samples_key()));
}

/// A format's components in GLSL.
struct GlslComponents {
    std::string type;
    std::string swizzle;
    std::uint64_t bytes = 0; ///< of all of them
};

GlslComponents components_of(TexelFormat format)
{
    switch (format) {
    case TexelFormat::r16f:
        return {"float", "r", 2};
    case TexelFormat::r32f:
        return {"float", "r", 4};
    case TexelFormat::rg16:
    case TexelFormat::rg16f:
        return {"vec2", "rg", 4};
    case TexelFormat::rg32f:
        return {"vec2", "rg", 8};
    case TexelFormat::rgba16:
    case TexelFormat::rgba16f:
        return {"vec4", "rgba", 8};
    case TexelFormat::rgba32f:
        return {"vec4", "rgba", 16};
    }
    return {};
}

/// A pass with the snippet and the job's kernel.
PrefilterPass pass_of(GlslSnippet snippet, const Kernel& kernel, TexelFormat format)
{
    const GlslComponents components = components_of(format);
    snippet.definitions.push_back({"KERNEL_ACROSS", std::to_string(kernel.width_texels())});
    snippet.definitions.push_back({"CONTENT", components.type});
    snippet.definitions.push_back({"COMPONENTS", components.swizzle});
    snippet.uniforms.push_back({"kernel", {kernel.weights.begin(), kernel.weights.end()}});
    return {std::move(snippet), format};
}

bool has_several_levels(const scene::Job& job)
{
    return value_in<bool>(job, blur_mips_key());
}

int anisotropy_in(const scene::Job& job)
{
    return static_cast<int>(value_in<std::int64_t>(job, blur_anisotropy_key()));
}

/// Memory of the drawn depths, at centres and samples, and of each pass's texture.
std::uint64_t blur_bytes(const scene::Job& job, TexelFormat format)
{
    const auto side = static_cast<std::uint64_t>(job.shadow_map.resolution_texels);
    const std::uint64_t passes = kernel_in(job).width_texels() > 1 ? 2 : 1;
    std::uint64_t texels = passes * side * side;
    for (std::uint64_t level = side / 2; level > 0 && has_several_levels(job); level /= 2) {
        texels += level * level;
    }
    texels *= scene::map_count(job);
    const std::uint64_t drawn = map_bytes(job);
    const auto samples = static_cast<std::uint64_t>(samples_in(job));
    return drawn + (samples > 1 ? samples * drawn : 0) + texels * components_of(format).bytes;
}

} // namespace

const Key& bits_key()
{
    static const Key key =
        scene::added_key(scene::make_key("method.bits", "{unit} of each number that a texel stores",
                                         "", scene::only(Stage::prefilter), "bits"),
                         scene::IntegerDomain{.lower = 16, .upper = 32, .is_power_of_two = true},
                         std::int64_t{32}, {.values = {std::int64_t{16}}});
    return key;
}

const Key& reduction_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.bleeding_reduction",
                        "verdicts up to this count as shadow, and the others are stretched", "",
                        scene::only(Stage::lookup)),
        scene::RealDomain{.lower = 0, .upper = 0.99}, 0.0, {.values = {0.1, 0.3}});
    return key;
}

std::vector<Key> blur_keys()
{
    return {blur_kernel_key(), blur_width_key(), blur_samples_key(), blur_mips_key(),
            blur_anisotropy_key()};
}

bool is_16_bit(const scene::Job& job)
{
    return value_in<std::int64_t>(job, bits_key()) == 16;
}

std::string with_mean_of_rows(std::string_view content)
{
    return fmt::format("{}{}", content, glsl_source("mean_of_rows.glsl"));
}

std::string with_exponential(std::string_view snippet)
{
    return fmt::format("{}{}", glsl_source("exponential.glsl"), snippet);
}

Blur mean_of(const ContentOfDepths& content)
{
    return {{content.rows, content.definitions, content.uniforms},
            {glsl_source("mean_of_columns.glsl")},
            content.format};
}

Passes blur_passes(const scene::Job& job, const Blur& blur)
{
    const Kernel& kernel = kernel_in(job);
    Passes made;
    made.samples = samples_in(job);
    made.prefilter.push_back(pass_of(blur.rows, kernel, blur.format));
    if (kernel.width_texels() > 1) {
        made.prefilter.push_back(pass_of(blur.columns, kernel, blur.format));
    }
    made.sampling = Sampling::interpolated;
    made.makes_mipmaps = has_several_levels(job);
    made.anisotropy = anisotropy_in(job);
    return made;
}

std::vector<Uniform> reduction_uniforms(const scene::Job& job)
{
    const auto reduction = static_cast<float>(value_in<double>(job, reduction_key()));
    return {{"bleeding_reduction", {reduction}}, {"stretch", {1 / (1 - reduction)}}};
}

LookupTraits blur_traits(const scene::Job& job, TexelFormat format)
{
    const Kernel& kernel = kernel_in(job);
    const bool has_gradients = has_several_levels(job) || anisotropy_in(job) > 1;
    return {.verdict = Verdict::fraction,
            .compares = Compares::none,
            .monotonicity = {Monotone::exactly, 0},
            .curve = Curve::by_bisection,
            .width_texels = kernel.width_texels() + 1,
            .weights = Weights::bilinear,
            .kernel = kernel,
            .reads = has_gradients ? Reads::whole_map : Reads::footprint,
            .samples = samples_in(job),
            .map_bytes = blur_bytes(job, format)};
}

void check_blur(const scene::Job& job)
{
    const std::string& name = job.method.name;
    if (scene::map_layout(job) == scene::MapLayout::cube) {
        throw scene::InputError(
            fmt::format("method.name = \"{}\": its kernels do not cross the seams of a cube, so it "
                        "does not support point lights; use \"depth\"",
                        name));
    }
    require_gl_depth(job,
                     "method.name = \"{1}\": it averages functions of depths; remove "
                     "shadow_map.content = \"{0}\"",
                     name);
    if (const scene::DepthFormat format = job.shadow_map.depth_format;
        traits_of(format).is_colour) {
        throw scene::InputError(
            fmt::format("shadow_map.depth_format = \"{}\": method.name = \"{}\" reads a depth "
                        "texture, and stores averages in its own format; use d16, d24 or d32f",
                        depth_format_name(format), name));
    }
    const auto width = value_in<std::int64_t>(job, blur_width_key());
    if (width > job.shadow_map.resolution_texels) {
        throw scene::InputError(fmt::format(
            "method.kernel_width = {}: wider than the map of {} texels; choose a narrower kernel, "
            "or raise shadow_map.resolution",
            width, job.shadow_map.resolution_texels));
    }
}

} // namespace gnomon::methods
