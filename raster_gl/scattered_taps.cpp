#include "raster_gl/scattered_taps.hpp"

#include "methods/taps/tap_kernel.hpp"

#include <fmt/format.h>

#include <span>
#include <vector>

namespace gnomon::raster_gl {
namespace {

std::vector<float> coordinates(std::span<const scene::Vec2f> vectors)
{
    std::vector<float> all;
    for (const scene::Vec2f& vector : vectors) {
        all.insert(all.end(), {vector.x, vector.y});
    }
    return all;
}

} // namespace

std::string tap_places(const methods::ScatteredTaps& taps)
{
    return taps.places.empty() ? std::string{}
                               : fmt::format("#line 1 9\n{}", shader_source("scattered_taps.glsl"));
}

void add_definitions(const methods::ScatteredTaps& taps, Definitions& definitions)
{
    const bool is_scattered = !taps.places.empty();
    const auto flag = [](bool on) { return on ? "1" : "0"; };
    definitions.emplace_back("SCATTERED", flag(is_scattered));
    if (is_scattered) {
        definitions.emplace_back("TAPS", std::to_string(taps.places.size()));
        definitions.emplace_back("RADIUS_IN_METRES", flag(taps.is_in_metres));
        definitions.emplace_back("TURNED", flag(taps.is_turned));
        definitions.emplace_back("ROTATIONS", std::to_string(methods::rotation_count));
    }
}

void set_uniforms(const Program& lookup, const methods::ScatteredTaps& taps,
                  const scene::View& view, int resolution_texels)
{
    if (taps.places.empty()) {
        return;
    }
    std::vector<float> widths_m;
    for (const scene::LightFrustum& map : view.maps) {
        widths_m.push_back(static_cast<float>(map.texel_width_m(1.0, resolution_texels)));
    }
    set_uniform(lookup, "tap_places", coordinates(taps.places));
    set_uniform(lookup, "kernel_radius", static_cast<float>(taps.radius));
    set_uniform(lookup, "rotations", coordinates(methods::rotations()));
    set_uniform(lookup, "texel_width_m", widths_m);
    set_uniform(lookup, "largest_radius", static_cast<float>(methods::largest_radius_texels));
}

} // namespace gnomon::raster_gl
