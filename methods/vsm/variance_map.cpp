#include "methods/vsm/variance_map.hpp"

#include "methods/depth/bias_terms.hpp"
#include "methods/depth/depth_map.hpp"
#include "methods/glsl.hpp"
#include "scene/error.hpp"
#include "scene/job/keys.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>

namespace gnomon::methods {
namespace {

using scene::HandedKey;
using scene::Stage;

constexpr auto vsm_sources = std::to_array<Source>({
    {"W. Donnelly, A. Lauritzen", 2006, "Variance shadow maps", {}},
    {"A. Lauritzen", 2007, "Summed-area variance shadow maps (GPU Gems 3, chapter 8)",
     "least variance, reduction of light bleeding"},
});
constexpr auto vsm_tables = std::to_array<std::string_view>({"shadow_map", "lookup", "bias"});

/// 32-bit floats: the kernels' weights, along a line.
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

const HandedKey& content_key()
{
    static const HandedKey key{scene::make_key("method.content", "what the moments are stored as",
                                               "", scene::only(Stage::prefilter)),
                               scene::WordDomain{.words = {"rg16", "rg16f", "rg32f"}},
                               std::string{"rg32f"}};
    return key;
}
const HandedKey& kernel_key()
{
    static const HandedKey key{scene::make_key("method.kernel", "weights of the moments' mean", "",
                                               scene::only(Stage::prefilter)),
                               scene::WordDomain{.words = {"box", "gaussian"}}, std::string{"box"}};
    return key;
}
const HandedKey& width_key()
{
    static const HandedKey key{scene::make_key("method.kernel_width",
                                               "{unit} across that the moments are averaged over",
                                               "", scene::only(Stage::prefilter), "texels"),
                               scene::IntegerDomain{1, 9, 2}, std::int64_t{5}};
    return key;
}
const HandedKey& samples_key()
{
    static const HandedKey key{
        scene::make_key("method.samples",
                        "depths of each texel that the moments are of, at "
                        "GL's places of so many",
                        "", scene::only(Stage::prefilter), "samples"),
        scene::IntegerDomain{.lower = 1, .upper = 8, .is_power_of_two = true}, std::int64_t{1}};
    return key;
}
const HandedKey& mips_key()
{
    static const HandedKey key{scene::make_key("method.mips",
                                               "averages over a pixel, by coarser levels of the "
                                               "moments",
                                               "", scene::only(Stage::prefilter)),
                               scene::FlagDomain{}, false};
    return key;
}
const HandedKey& anisotropy_key()
{
    static const HandedKey key{scene::make_key("method.anisotropy",
                                               "most {unit} along a pixel's longer side", "",
                                               scene::only(Stage::lookup), "samples"),
                               scene::IntegerDomain{1, 16}, std::int64_t{1}};
    return key;
}
const HandedKey& reduction_key()
{
    static const HandedKey key{
        scene::make_key("method.bleeding_reduction",
                        "verdicts up to this count as shadow, and the others are stretched", "",
                        scene::only(Stage::lookup)),
        scene::RealDomain{.lower = 0, .upper = 0.99}, 0.0};
    return key;
}
const HandedKey& variance_key()
{
    static const HandedKey key{
        scene::make_key("method.min_variance", "least variance of the depths [{unit}]", "",
                        scene::only(Stage::lookup), "depth units squared"),
        scene::RealDomain{.lower = 0, .upper = 1, .normal_float = true}, 1e-6};
    return key;
}

template <typename Value>
Value value_of(const HandedKey& key, const scene::Job& job)
{
    return std::get<Value>(key.value_of(job));
}

const Kernel& kernel_of(const scene::Job& job)
{
    const auto& kernels =
        value_of<std::string>(kernel_key(), job) == "box" ? box_kernels : gaussian_kernels;
    return kernels.at(static_cast<std::size_t>(value_of<std::int64_t>(width_key(), job) / 2));
}

TexelFormat format_of(const scene::Job& job)
{
    const std::string content = value_of<std::string>(content_key(), job);
    return content == "rg16"    ? TexelFormat::rg16
           : content == "rg16f" ? TexelFormat::rg16f
                                : TexelFormat::rg32f;
}

int samples_of(const scene::Job& job)
{
    return static_cast<int>(value_of<std::int64_t>(samples_key(), job));
}

void vsm_check(const scene::Job& job)
{
    if (scene::map_layout(job) == scene::MapLayout::cube) {
        throw scene::InputError(
            "method.name = \"vsm\": its kernels do not lead over a cube's seams, "
            "so that a point light's maps have none; use \"depth\"");
    }
    if (job.shadow_map.frustum.content == scene::MapContent::distance) {
        throw scene::InputError("method.name = \"vsm\": its moments are of depths; remove "
                                "shadow_map.content = \"distance\"");
    }
    if (const scene::DepthFormat format = job.shadow_map.depth_format;
        traits_of(format).is_colour) {
        throw scene::InputError(fmt::format(
            "shadow_map.depth_format = \"{}\": the moments of method.name = \"vsm\" are made of a "
            "depth texture, and stored as method.content says; use d16, d24 or d32f",
            depth_format_name(format)));
    }
    const auto width = value_of<std::int64_t>(width_key(), job);
    if (width > job.shadow_map.resolution_texels) {
        throw scene::InputError(fmt::format(
            "method.kernel_width = {}: wider than the map of {} texels; choose a narrower kernel, "
            "or raise shadow_map.resolution",
            width, job.shadow_map.resolution_texels));
    }
}

/// Along rows, and where the kernel has several, along columns.
Passes vsm_passes(const scene::Job& job)
{
    const Kernel& kernel = kernel_of(job);
    const Definition across{"KERNEL_ACROSS", std::to_string(kernel.width_texels())};
    const Uniform weights{"kernel", {kernel.weights.begin(), kernel.weights.end()}};
    const TexelFormat format = format_of(job);
    Passes made;
    made.samples = samples_of(job);
    made.prefilter.push_back({{glsl_source("moments_of_rows.glsl"), {across}, {weights}}, format});
    if (kernel.width_texels() > 1) {
        made.prefilter.push_back(
            {{glsl_source("mean_of_columns.glsl"), {across}, {weights}}, format});
    }
    const auto reduction = static_cast<float>(value_of<double>(reduction_key(), job));
    made.lookup = {glsl_source("chebyshev.glsl"),
                   {},
                   {{"min_variance", {static_cast<float>(value_of<double>(variance_key(), job))}},
                    {"bleeding_reduction", {reduction}},
                    {"stretch", {1 / (1 - reduction)}}}};
    made.sampling = Sampling::interpolated;
    made.makes_mipmaps = value_of<bool>(mips_key(), job);
    made.anisotropy = static_cast<int>(value_of<std::int64_t>(anisotropy_key(), job));
    return made;
}

/// The depths that were drawn, at centres and at samples, and a texture of each pass.
std::uint64_t bytes_of(const scene::Job& job)
{
    const auto side = static_cast<std::uint64_t>(job.shadow_map.resolution_texels);
    const std::uint64_t texel = format_of(job) == TexelFormat::rg32f ? 8 : 4;
    const Passes passes = vsm_passes(job);
    std::uint64_t texels = passes.prefilter.size() * side * side;
    for (std::uint64_t level = side / 2; level > 0 && passes.makes_mipmaps; level /= 2) {
        texels += level * level;
    }
    texels *= scene::map_count(job);
    const std::uint64_t drawn = map_bytes(job);
    const std::uint64_t sampled =
        passes.samples > 1 ? static_cast<std::uint64_t>(passes.samples) * drawn : 0;
    return drawn + sampled + texels * texel;
}

Promises vsm_promises(const scene::Job& job)
{
    const Kernel& kernel = kernel_of(job);
    return {.verdict = Verdict::fraction,
            .compares = Compares::none,
            .rises = {Rise::exactly, 0},
            .curve = Curve::by_bisection,
            .width_texels = kernel.width_texels() + 1,
            .weights = Weights::bilinear,
            .kernel = kernel,
            .reads = vsm_passes(job).has_gradients() ? Reads::whole_map : Reads::footprint,
            .samples = samples_of(job),
            .map_bytes = bytes_of(job)};
}

} // namespace

Method variance_map()
{
    return {.name = "vsm",
            .sentence = "keeps mean and variance of depths, and bounds by them how much of the "
                        "light gets through",
            .sources = vsm_sources,
            .page = "docs/methods/vsm.md",
            .key_tables = vsm_tables,
            .keys = {content_key(), kernel_key(), width_key(), samples_key(), mips_key(),
                     anisotropy_key(), reduction_key(), variance_key()},
            .filters = {},
            .bias_terms = bias_terms(),
            .promises = vsm_promises,
            .passes = vsm_passes,
            .check = vsm_check};
}

} // namespace gnomon::methods
