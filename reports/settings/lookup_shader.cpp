#include "reports/settings/lookup_shader.hpp"

#include "methods/bias_term.hpp"
#include "methods/depth/terms/normal_offset.hpp"
#include "methods/depth/terms/receiver_plane.hpp"
#include "methods/depth/terms/texel_bias.hpp"
#include "methods/job_method.hpp"
#include "reports/settings/shader_writer.hpp"
#include "scene/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstddef>
#include <string_view>
#include <utility>

namespace gnomon::reports {
namespace {

using methods::number_in;
using scene::InputError;

void require_writable(const scene::Job& job, const methods::LookupTraits& traits)
{
    if (job.method.name != "depth") {
        throw InputError(
            fmt::format("method.name = \"{}\": Gnomon writes the lookups of \"depth\"; "
                        "set it with --set method.name=depth",
                        job.method.name));
    }
    if (scene::map_layout(job) == scene::MapLayout::cube) {
        throw InputError("shadow_map.layout = \"cube\": Gnomon does not write lookups in a cube; "
                         "try --engine gl, direct3d or vulkan");
    }
    if (job.shadow_map.depth_format.kind == scene::DepthFormat::Kind::rgba8) {
        throw InputError("shadow_map.depth_format = \"rgba8\": Gnomon does not write lookups of "
                         "packed depths; choose another format");
    }
    if (traits.samples > 1) {
        throw InputError("Gnomon does not write lookups in a map of several samples per texel; "
                         "draw it with one");
    }
}

/// Writes the lookup of one job.
class LookupWriter {
public:
    LookupWriter(ShaderLanguage language, const scene::Job& job, const scene::View& view,
                 float constant)
        : out_{language, view.maps.size()},
          job_{job},
          view_{view},
          traits_{methods::traits(job)},
          constant_{constant},
          unit_m_{job.scene.unit_m.value_or(1)},
          is_positional_{view.light.has_position()},
          is_reversed_{view.first_map().reversed},
          resolution_{shader_number(1.0 * job.shadow_map.resolution_texels)}
    {
    }

    [[nodiscard]] LookupShader run() &&
    {
        add_declarations();
        if (follows_plane()) {
            add_plane_rise(out_, resolution_, is_reversed_);
        }
        if (is_by_derivatives()) {
            add_derived_rise(out_, resolution_, is_reversed_);
        }
        if (is_fetched()) {
            add_tap_visibility(out_, job_.shadow_map.resolution_texels, job_.lookup.outside,
                               is_reversed_);
        }
        add_lookup_function();
        list_what_is_missing();
        result_.lines = out_.take_lines();
        return std::move(result_);
    }

private:
    /// Adds a line with arguments for its braces.
    template <typename... Arguments>
    void add(fmt::format_string<Arguments...> line, Arguments&&... arguments)
    {
        out_.add(fmt::format(line, std::forward<Arguments>(arguments)...));
    }

    [[nodiscard]] bool is_hlsl() const { return out_.is_hlsl(); }
    [[nodiscard]] bool is_compared_by_sampler() const
    {
        return traits_.weights == methods::Weights::bilinear_of_gl;
    }
    [[nodiscard]] bool is_mean_depth() const
    {
        return traits_.compares == methods::Compares::mean_depth;
    }
    [[nodiscard]] bool is_fetched() const { return !is_compared_by_sampler() && !is_mean_depth(); }
    [[nodiscard]] bool clamps() const { return job_.lookup.outside == scene::Outside::clamp; }
    [[nodiscard]] bool lights_outside() const
    {
        return job_.lookup.outside != scene::Outside::shadowed;
    }
    [[nodiscard]] double number(std::string_view key) const { return number_in(job_, key); }
    [[nodiscard]] bool has_receiver_plane() const { return methods::has_receiver_plane(job_); }
    [[nodiscard]] bool is_by_derivatives() const
    {
        return methods::receiver_plane_of(job_) == "derivatives";
    }
    [[nodiscard]] bool follows_plane() const
    {
        return number("bias.slope_kernels") != 0 || (has_receiver_plane() && !is_by_derivatives());
    }
    [[nodiscard]] bool needs_light_distance() const
    {
        return is_positional_ &&
               (job_.bias.normal_texels != 0 || number("bias.constant_texels") != 0);
    }
    /// Biases are subtracted from a depth, and added to a reversed one.
    [[nodiscard]] std::string_view towards_light() const { return is_reversed_ ? "+" : "-"; }
    /// Whether clip space has depths in [0, 1].
    [[nodiscard]] bool is_zero_to_one() const { return is_hlsl() || is_reversed_; }
    [[nodiscard]] scene::Measure measure() const
    {
        return traits_of(view_.first_map().content).measure;
    }
    template <typename Value>
    [[nodiscard]] std::string by_map(std::string_view name, const Value& value)
    {
        std::vector<float> values;
        for (std::size_t map = 0; map < view_.maps.size(); ++map) {
            values.push_back(static_cast<float>(value(map)));
        }
        return out_.by_map(name, values);
    }

    /// How to sample the map.
    [[nodiscard]] std::string sampler_text() const
    {
        if (is_fetched()) {
            return "no comparison, read texel by texel";
        }
        return fmt::format(
            "linear filter, {}, {}",
            is_mean_depth() ? "no comparison"
            : is_reversed_  ? "compares GEQUAL"
                            : "compares LEQUAL",
            clamps() ? "clamped to the edge"
                     : fmt::format("border {}", lights_outside() != is_reversed_ ? 1 : 0));
    }

    void add_declarations()
    {
        const std::string map = fmt::format("shadow_map; // {0} x {0}, {1}",
                                            job_.shadow_map.resolution_texels, sampler_text());
        const std::string_view layers = out_.has_cascades() ? "Array" : "";
        if (is_hlsl()) {
            add("Texture2D{}<float> {}", layers, map);
            if (!is_fetched()) {
                add("{} shadow_sampler;",
                    is_mean_depth() ? "SamplerState" : "SamplerComparisonState");
            }
            add("float4x4 light_clip_from_world{}; // for column vectors", out_.count());
        } else {
            add("uniform sampler2D{}{} {}", layers, is_compared_by_sampler() ? "Shadow" : "", map);
            add("uniform mat4 light_clip_from_world{};{}", out_.count(),
                is_reversed_ ? " // with depths in [0, 1]" : "");
        }
        if (measure() == scene::Measure::ray) {
            add("{}vec3 light_position;", is_hlsl() ? "" : "uniform ");
        }
    }

    void add_lookup_function()
    {
        add("");
        add("// N: the triangle's normal, L: towards the light; both unit. 0: shadow, 1: lit");
        add("float visibility(vec3 position, vec3 N, vec3 L{})", out_.parameter());
        add("{{");
        if (has_receiver_plane()) {
            add_receiver_plane();
        }
        if (needs_light_distance()) {
            add("    float light_distance = ({}).w;", out_.clip_of("position"));
        }
        add("    vec3 p = position{};", offset());
        add("    vec4 clip = {};", out_.clip_of("p"));
        add("    vec3 ndc = clip.xyz / clip.w;");
        add("    vec2 uv = ndc.xy * {} + 0.5;", is_hlsl() ? "vec2(0.5, -0.5)" : "0.5");
        if (is_fetched()) {
            add("    vec2 texel = uv * {};", resolution_);
        }
        add_depth();
        add("    float bias = {};", curve_bias());
        if (is_fetched()) {
            add_taps();
        } else {
            add_sample();
        }
        add("}}");
    }

    void add_receiver_plane()
    {
        add("    vec2 rise = {}{});",
            is_by_derivatives() ? "derived_rise(position" : "plane_rise(position, N",
            out_.argument());
        const double most = number("bias.receiver_plane_clamp");
        if (most > 0) {
            add("    float steepness = 2.0 * (abs(rise.x) + abs(rise.y));");
            add("    rise *= steepness > {0} ? {0} / steepness : 1.0;",
                shader_number(static_cast<float>(most)));
        }
    }

    /// " + 0.02 * (dot(N, L) < 0.0 ? -N : N)"; may be empty.
    [[nodiscard]] std::string offset()
    {
        std::vector<std::string> lengths;
        if (job_.bias.normal_texels != 0) {
            lengths.push_back(by_map("texel_offset", [&](std::size_t map) {
                return job_.bias.normal_texels *
                       view_.maps[map].texel_width_m(1.0, job_.shadow_map.resolution_texels) /
                       (is_positional_ ? 1 : unit_m_);
            }));
            lengths.back() += is_positional_ ? " * light_distance" : "";
        }
        if (const double metres = number("bias.normal_m"); metres != 0) {
            lengths.push_back(shader_number(static_cast<float>(metres / unit_m_)));
        }
        const std::string sum = fmt::format("{}", fmt::join(lengths, " + "));
        return lengths.empty() ? std::string{}
                               : fmt::format(" + {} * (dot(N, L) < 0.0 ? -N : N)",
                                             lengths.size() == 1 ? sum : "(" + sum + ")");
    }

    /// The receiver's depth without the biases of the curve, and what happens beyond the map.
    void add_depth()
    {
        add("    float r = {};", depth_text());
        if (number("bias.constant_texels") != 0) {
            add("    r {}= {};", towards_light(), texel_bias());
        }
        if (const double kernels = number("bias.slope_kernels"); kernels != 0) {
            add("    vec2 slope_rise = plane_rise(position, N{});", out_.argument());
            add("    r {}= {} * (abs(slope_rise.x) + abs(slope_rise.y));", towards_light(),
                shader_number(static_cast<float>(kernels * 0.5 * traits_.width_texels)));
        }
        if (clamps()) {
            add("    r = clamp(r, 0.0, 1.0);");
            return;
        }
        add("    if (clip.w <= 0.0 || r {}) {{", is_reversed_ ? "< 0.0" : "> 1.0");
        add("        return {};", lights_outside() ? "1.0" : "0.0");
        add("    }}");
    }

    [[nodiscard]] std::string depth_text() const
    {
        if (measure() == scene::Measure::clip_depth) {
            return is_zero_to_one() ? "ndc.z" : "ndc.z * 0.5 + 0.5";
        }
        const scene::DepthRange stored = view_.first_map().stored_range();
        return fmt::format("({} - {}) / {}",
                           measure() == scene::Measure::ray ? "length(p - light_position)"
                                                            : "clip.w",
                           shader_number(static_cast<float>(stored.near_m / unit_m_)),
                           shader_number(static_cast<float>(stored.range_m() / unit_m_)));
    }

    /// bias.constant_texels in depth units.
    [[nodiscard]] std::string texel_bias()
    {
        const bool is_linear = measure() != scene::Measure::clip_depth;
        const double per_unit = !is_positional_ ? 1 : is_linear ? unit_m_ : 1 / unit_m_;
        const std::string bias = by_map("texel_bias", [&](std::size_t map) {
            return per_unit * methods::depth_of_texels(view_.maps[map],
                                                       number("bias.constant_texels"),
                                                       job_.shadow_map.resolution_texels);
        });
        return is_positional_ ? fmt::format("{} {} light_distance", bias, is_linear ? "*" : "/")
                              : bias;
    }

    /// The constant and slope bias.
    [[nodiscard]] std::string curve_bias()
    {
        std::vector<std::string> terms;
        if (constant_ != 0) {
            terms.push_back(by_map("constant_bias", [&](std::size_t map) {
                return view_.bias_scales.empty() ? constant_ : constant_ * view_.bias_scales[map];
            }));
        }
        if (job_.bias.slope != 0) {
            terms.push_back(slope_term(job_.bias.slope));
        }
        return terms.empty() ? "0.0" : fmt::format("{}", fmt::join(terms, " + "));
    }

    /// The depth that `tap` is compared with.
    [[nodiscard]] std::string tap_depth() const
    {
        return fmt::format("r{} {} bias",
                           has_receiver_plane() ? " + dot(rise, tap + 0.5 - texel)" : "",
                           towards_light());
    }

    /// Compares with each texel of the filter.
    void add_taps()
    {
        if (traits_.width_texels == 1) {
            add("    vec2 tap = floor(texel);");
            add("    return tap_visibility(tap, {}{});", tap_depth(), out_.argument());
            return;
        }
        const bool is_weighted = !traits_.kernel.weights.empty();
        const int width = traits_.width_texels;
        const int before = (width - 1) / 2; // taps before the texel itself
        if (is_weighted) {
            std::vector<float> padded{0};
            padded.insert(padded.end(), traits_.kernel.weights.begin(),
                          traits_.kernel.weights.end());
            padded.push_back(0);
            out_.add_array("kernel", padded);
            add("    vec2 upper = texel - 0.5 - floor(texel - 0.5);");
        }
        add("    vec2 first = floor(texel{}) - {};", is_weighted ? " - 0.5" : "",
            shader_number(static_cast<double>(before)));
        add("    float lit = 0.0;");
        add("    float all = 0.0;");
        add("    for (int y = 0; y < {}; ++y) {{", width);
        add("        for (int x = 0; x < {}; ++x) {{", width);
        add("            vec2 tap = first + vec2(x, y);");
        add("            vec2 weights = {};",
            is_weighted
                ? "mix(vec2(kernel[x + 1], kernel[y + 1]), vec2(kernel[x], kernel[y]), upper)"
                : "vec2(1.0, 1.0)");
        add("            lit += weights.x * weights.y * tap_visibility(tap, {}{});", tap_depth(),
            out_.argument());
        add("            all += weights.x * weights.y;");
        add("        }}");
        add("    }}");
        add("    return lit / all;");
    }

    /// Lets the sampler filter.
    void add_sample()
    {
        if (has_receiver_plane()) { // one depth serves all four taps
            add("    r {}= 2.0 * (abs(rise.x) + abs(rise.y));", towards_light());
        }
        scene::ShadowMapSettings map = job_.shadow_map;
        map.layout = scene::map_layout(job_);
        add("    {} {}", is_mean_depth() ? "bool" : "float",
            comparison(map, job_.lookup.filter, fmt::format("r {} bias", towards_light()),
                       out_.language()));
        add("    return {};", is_mean_depth() ? "lit ? 1.0 : 0.0" : "lit");
    }

    void list_what_is_missing()
    {
        if (const double metres = number("bias.adaptive_m"); metres != 0) {
            result_.cannot.push_back(fmt::format("bias.adaptive_m = {}", metres));
        }
        if (methods::follows_vertex_normals(job_) &&
            (job_.bias.normal_texels != 0 || number("bias.normal_m") != 0)) {
            result_.cannot.emplace_back("bias.normal_from = \"vertices\"");
        }
        result_.has_all_biases = result_.cannot.empty();
        if (!view_.slices.mixed_from.empty()) {
            result_.cannot.push_back(
                fmt::format("shadow_map.blend = {}", job_.shadow_map.cascades.blend));
        }
    }

    ShaderWriter out_;
    const scene::Job& job_;
    const scene::View& view_;
    methods::LookupTraits traits_;
    float constant_; ///< in the first map [depth units]
    double unit_m_;
    bool is_positional_;
    bool is_reversed_;
    std::string resolution_;
    LookupShader result_;
};

} // namespace

LookupShader lookup_shader(ShaderLanguage language, const scene::Job& job, const scene::View& view,
                           float constant)
{
    require_writable(job, methods::traits(job));
    return LookupWriter{language, job, view, constant}.run();
}

} // namespace gnomon::reports
