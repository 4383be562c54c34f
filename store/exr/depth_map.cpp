#include "store/exr/aov.hpp"

#include "analysis/depth/depth_mapping.hpp"
#include "scene/pixels/map_texels.hpp"
#include "store/exr/header.hpp"
#include "store/images/exr.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace gnomon::store {

namespace {

/// @param depths  of all maps; must outlive the channels.
std::vector<ExrChannel> channels_of(const scene::LightFrustum& frustum,
                                    const scene::Image<float>& depths, std::size_t map)
{
    const auto side = static_cast<std::size_t>(depths.size().width_px);
    const auto depth = [&depths, first = map * side * side](std::size_t i) {
        return depths[first + i];
    };
    const auto distance_m = [depth, mapping = analysis::DepthMapping{frustum.stored_range()},
                             farthest = frustum.reversed ? 0.0F : 1.0F](std::size_t i) {
        return depth(i) == farthest
                   ? std::numeric_limits<float>::quiet_NaN()
                   : static_cast<float>(mapping.light_distance_m(double{depth(i)}));
    };
    return {{"depth", ChannelType::float32,
             [depth](std::size_t i) { return std::bit_cast<std::uint32_t>(depth(i)); }},
            {"light_distance_m", ChannelType::float32,
             [distance_m](std::size_t i) { return std::bit_cast<std::uint32_t>(distance_m(i)); }}};
}

} // namespace

void write_depth_map(const std::filesystem::path& path, const analysis::Comparison& comparison,
                     const scene::Image<float>& depths)
{
    const int side = comparison.job.shadow_map.resolution_texels;
    const std::size_t maps = comparison.view.maps.size();
    if (depths.size() != scene::maps_image_size(side, maps)) {
        throw std::invalid_argument(
            fmt::format("write_depth_map: depths are {}x{} but there are {} maps of {} texels",
                        depths.size().width_px, depths.size().height_px, maps, side));
    }
    std::vector<std::vector<ExrChannel>> channels;
    for (std::size_t map = 0; map < maps; ++map) {
        channels.push_back(channels_of(comparison.view.maps[map], depths, map));
    }
    const std::vector<ExrAttribute> header = exr_header(comparison);
    std::vector<ExrPart> parts;
    for (std::size_t map = 0; map < maps; ++map) {
        parts.push_back({{side, side},
                         channels[map],
                         header,
                         maps == 1 ? std::string{} : comparison.view.map_name(map)});
    }
    write_file(path, encode_exr(parts));
}

} // namespace gnomon::store
