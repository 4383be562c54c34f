#include "scene/job/job.hpp"

#include "scene/light/cube_faces.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace gnomon::scene {
namespace {

constexpr int fewest_unorm_bits = 8;
constexpr int most_unorm_bits = 24;
constexpr std::array<std::pair<std::string_view, DepthFormat>, 4> gl_depth_formats{
    {{"d16", {DepthFormat::Kind::d16, 16}},
     {"d24", {DepthFormat::Kind::d24, 24}},
     {"d32", {DepthFormat::Kind::d32, 32}},
     {"d32f", {DepthFormat::Kind::d32f, 32}}}};

constexpr std::array<std::string_view, 3> outside_names{"lit", "shadowed", "clamp"};
constexpr std::array<std::string_view, 2> position_names{"vertex", "pixel"};
constexpr std::array<std::string_view, 3> cull_names{"none", "front", "back"};
constexpr std::array<std::string_view, 2> layout_names{"single", "cube"};
constexpr std::array<std::string_view, 2> content_names{"depth", "distance"};
constexpr std::array<std::string_view, 3> fit_names{"scene", "camera", "fixed"};

} // namespace

std::optional<DepthFormat> depth_format_from_name(std::string_view name)
{
    for (const auto& [format_name, format] : gl_depth_formats) {
        if (name == format_name) {
            return format;
        }
    }
    for (int bits = fewest_unorm_bits; bits <= most_unorm_bits; ++bits) {
        if (name == fmt::format("u{}", bits)) {
            return DepthFormat{DepthFormat::Kind::unorm, bits};
        }
    }
    return std::nullopt;
}

std::string depth_format_name(DepthFormat format)
{
    for (const auto& [format_name, gl_format] : gl_depth_formats) {
        if (format.kind == gl_format.kind) {
            return std::string{format_name};
        }
    }
    return fmt::format("u{}", format.bits);
}

std::string_view lookup_position_name(LookupPosition position)
{
    return position_names.at(static_cast<std::size_t>(position));
}

std::string_view outside_name(Outside outside)
{
    return outside_names.at(static_cast<std::size_t>(outside));
}

std::string_view cull_name(Cull cull)
{
    return cull_names.at(static_cast<std::size_t>(cull));
}

std::string_view fit_name(Fit fit)
{
    return fit_names.at(static_cast<std::size_t>(fit));
}

std::string_view map_layout_name(MapLayout layout)
{
    return layout_names.at(static_cast<std::size_t>(layout));
}

std::string_view map_content_name(MapContent content)
{
    return content_names.at(static_cast<std::size_t>(content));
}

MapLayout map_layout(const Job& job)
{
    const bool is_point = job.light && job.light->type == LightType::point;
    return job.shadow_map.layout.value_or(is_point ? MapLayout::cube : MapLayout::single);
}

std::size_t map_count(const Job& job)
{
    return map_layout(job) == MapLayout::cube ? cube_face_count : 1;
}

LookupPosition lookup_position(const Job& job)
{
    return job.lookup.position.value_or(map_count(job) > 1 ? LookupPosition::pixel
                                                           : LookupPosition::vertex);
}

} // namespace gnomon::scene
