#include "scene/job/keys/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {
namespace {

/// The light's matrix affects the receivers' light clip coordinates and the map.
constexpr Stages light_matrix = Stage::receivers | Stage::shadow_map;

Key depth_format_key()
{
    WordDomain formats;
    formats.listing = depth_format_listing();
    for (const DepthFormat format : depth_formats()) {
        formats.words.push_back(depth_format_name(format));
    }
    return job_key(
        make_key("shadow_map.depth_format",
                 "GL's own depth formats; colour formats: r32f, r16f, and rgba8, "
                 "packed as lessons do; or u8 to u24: n-bit unorm, written by the "
                 "shader",
                 "\"d24\"", only(Stage::shadow_map)),
        std::move(formats),
        [](Job& job, const JobValue& value) {
            job.shadow_map.depth_format =
                depth_format_from_name(std::get<std::string>(value)).value();
        },
        [](const Job& job) -> std::optional<JobValue> {
            return held(depth_format_name(job.shadow_map.depth_format));
        });
}

/// Omitted for a single map, as before layouts existed.
Key layout_key()
{
    Key spec = word_key<MapLayout>(
        make_key(
            "shadow_map.layout",
            "how many maps, and what they see: one; of a point light, which has no other, the "
            "six faces of a cube; or of a directional light one for each slice of the camera's "
            "view",
            "\"single\"", light_matrix),
        3, map_layout_name, [](Job & job) -> auto& { return job.shadow_map.layout; }, map_layout);
    spec.get = [](const Job& job) -> std::optional<JobValue> {
        const MapLayout layout = map_layout(job);
        return layout == MapLayout::single ? std::nullopt
                                           : held(std::string{map_layout_name(layout)});
    };
    return spec;
}

/// "what the map stores: depth, or of a spot or point light …, or …"
std::string meaning_of_contents()
{
    std::vector<std::string_view> written; // by a shader
    for (const MapContentTraits& content : map_contents()) {
        if (!content.is_gl_depth()) {
            written.push_back(content.meaning);
        }
    }
    return fmt::format("what the map stores: depth, or of a spot or point light {}",
                       fmt::join(written, ", or "));
}

/// Omitted for depth, as before other contents existed.
Key content_key()
{
    Key spec = word_key<MapContent>(
        make_key("shadow_map.content", meaning_of_contents(), "\"depth\"", light_matrix),
        static_cast<int>(map_contents().size()), map_content_name,
        [](auto& job) -> auto& { return job.shadow_map.frustum.content; });
    spec.get = [](const Job& job) -> std::optional<JobValue> {
        const MapContentTraits& content = traits_of(job.shadow_map.frustum.content);
        return content.is_gl_depth() ? std::nullopt : held(std::string{content.name});
    };
    return spec;
}

/// `near` or `far`: metres from the light's camera, or "auto".
Key plane_key(std::string name, std::string description,
              std::optional<double> FrustumSettings::*plane)
{
    return number_or_auto_key(
        make_key(std::move(name), std::move(description), "\"auto\"", light_matrix, "m"),
        RealDomain{.lower = -farthest_m, .upper = farthest_m, .or_auto = true},
        [plane](auto& job) -> auto& { return job.shadow_map.frustum.*plane; });
}

Key half_extent_key()
{
    Key spec = member_key<double>(
        make_key("shadow_map.half_extent",
                 "half the side of the map's square [{unit}]; fit = \"fixed\", directional light",
                 "20", light_matrix, "m"),
        RealDomain{.lower = 1e-6, .upper = farthest_m},
        [](auto& job) -> auto& { return job.shadow_map.frustum.half_extent_m; });
    spec.get = [](const Job& job) -> std::optional<JobValue> {
        const FrustumSettings& frustum = job.shadow_map.frustum;
        return frustum.fit == Fit::fixed ? held(frustum.half_extent_m) : std::nullopt;
    };
    return of_lights(std::move(spec), {LightType::directional});
}

Key fov_key()
{
    Key spec = job_key(
        make_key("shadow_map.fov_deg",
                 "full opening angle of the map [{unit}]; fit = \"fixed\", spot; left "
                 "out: the light's cone",
                 "", light_matrix, "deg"),
        opening_angle_deg,
        [](Job& job, const JobValue& value) {
            job.shadow_map.frustum.fov_deg = std::get<double>(value);
        },
        [](const Job& job) -> std::optional<JobValue> {
            const FrustumSettings& frustum = job.shadow_map.frustum;
            const bool is_given = frustum.fit == Fit::fixed && frustum.fov_deg;
            return is_given ? held(*frustum.fov_deg) : std::nullopt;
        },
        "60");
    return of_lights(std::move(spec), {LightType::spot});
}

std::vector<Key> frustum_keys()
{
    return {word_key<Fit>(
                make_key("shadow_map.fit",
                         "what the map covers: the scene, what the camera sees, or fixed "
                         "by half_extent or fov_deg",
                         "\"scene\"", light_matrix),
                3, fit_name, [](auto& job) -> auto& { return job.shadow_map.frustum.fit; }),
            half_extent_key(),
            fov_key(),
            member_key<double>(
                make_key("shadow_map.roll_deg",
                         "turns the texel grid about the light's axis "
                         "[{unit}]",
                         "0", light_matrix, "deg"),
                RealDomain{.lower = -360, .upper = 360},
                [](auto& job) -> auto& { return job.shadow_map.frustum.roll_deg; }),
            plane_key("shadow_map.near",
                      "near plane [{unit}], by distance from the light's "
                      "camera",
                      &FrustumSettings::near_m),
            plane_key("shadow_map.far",
                      "far plane [{unit}], by distance from the light's "
                      "camera",
                      &FrustumSettings::far_m)};
}

/// The key of a bias: normal numbers only, because GL may flush subnormals to zero.
template <typename Access>
Key bias_key(Key key, double largest, Access access)
{
    return member_key<double>(std::move(key),
                              RealDomain{.lower = -largest, .upper = largest, .normal_float = true},
                              access);
}

/// Omitted if the bias is given in another unit.
Key constant_key(const BiasUnit& unit)
{
    return job_key(
        make_key(std::string{unit.key}, std::string{unit.meaning}, std::string{unit.default_text},
                 only(Stage::bias), std::string{unit.symbol}),
        RealDomain{.lower = -unit.largest, .upper = unit.largest, .normal_float = true},
        [&unit](Job& job, const JobValue& value) {
            set_constant(job.bias, unit, std::get<double>(value));
        },
        [&unit](const Job& job) -> std::optional<JobValue> {
            return &bias_unit_of(job.bias) == &unit ? held(constant_in_unit(job.bias))
                                                    : std::nullopt;
        },
        std::string{unit.example});
}

Key filter_key()
{
    return word_key<Filter>(
        make_key("lookup.filter", "how the map is filtered", "\"nearest\"", only(Stage::lookup)),
        static_cast<int>(filter_count), filter_name,
        [](auto& job) -> auto& { return job.lookup.filter; });
}

std::vector<Key> lookup_and_bias_keys()
{
    constexpr double steepest = 1000;
    std::vector<Key> specs{
        filter_key(),
        word_key<Outside>(
            make_key("lookup.outside", "the verdict beyond the map's edge or its far plane",
                     "\"lit\"", only(Stage::lookup)),
            3, outside_name, [](auto& job) -> auto& { return job.lookup.outside; }),
        word_key<LookupPosition>(
            make_key("lookup.position",
                     "where a receiver's light clip position is computed: at the vertices, and "
                     "interpolated, or at each pixel from its world position, which several "
                     "maps need",
                     "\"vertex\"", only(Stage::lookup)),
            2, lookup_position_name, [](Job & job) -> auto& { return job.lookup.position; },
            lookup_position)};
    for (const BiasUnit& unit : bias_units) {
        specs.push_back(constant_key(unit));
    }
    specs.push_back(bias_key(
        make_key("bias.slope",
                 "slope bias, {unit} between the "
                 "geometric normal and the light",
                 "0", only(Stage::bias), "depth units per unit of the tangent"),
        steepest, [](auto& job) -> auto& { return job.bias.slope; }));
    specs.push_back(bias_key(
        make_key("bias.normal_texels", "moves the lookup along the normal [{unit}]", "0",
                 only(Stage::lookup), "texel widths"),
        steepest, [](auto& job) -> auto& { return job.bias.normal_texels; }));
    return specs;
}

} // namespace

std::vector<Key> map_keys()
{
    std::vector<Key> specs;
    specs.push_back(member_key<std::int64_t>(
        make_key("shadow_map.resolution", "{unit} along each side of the map", "1024",
                 only(Stage::shadow_map), "texels"),
        IntegerDomain{1, largest_side},
        [](auto& job) -> auto& { return job.shadow_map.resolution_texels; }));
    specs.push_back(layout_key());
    for (Key& spec : cascade_keys()) {
        specs.push_back(std::move(spec));
    }
    specs.push_back(content_key());
    specs.push_back(depth_format_key());
    for (Key& spec : frustum_keys()) {
        specs.push_back(std::move(spec));
    }
    specs.push_back(word_key<Cull>(
        make_key("shadow_map.cull", "the faces that the map leaves out", "\"none\"",
                 only(Stage::shadow_map)),
        3, cull_name, [](auto& job) -> auto& { return job.shadow_map.cull; }));
    specs.push_back(member_key<bool>(
        make_key("shadow_map.reversed", "clip range [0, 1] with near at 1 and far at 0", "false",
                 light_matrix),
        FlagDomain{}, [](auto& job) -> auto& { return job.shadow_map.frustum.reversed; }));
    for (Key& spec : lookup_and_bias_keys()) {
        specs.push_back(std::move(spec));
    }
    return specs;
}

} // namespace gnomon::scene
