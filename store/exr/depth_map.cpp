#include "store/exr/depth_map.hpp"

#include "analysis/depth/depth_mapping.hpp"
#include "store/exr/header.hpp"
#include "store/images/image_encoding.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace gnomon::store {

void write_depth_map(const std::filesystem::path& path, const analysis::Comparison& comparison,
                     const scene::Image<float>& depths)
{
    const scene::ShadowMapSettings& map = comparison.job.shadow_map;
    const scene::ImageSize size{map.resolution_texels, map.resolution_texels};
    if (depths.size() != size) {
        throw std::invalid_argument(
            fmt::format("write_depth_map: depths are {}x{} but the map has {} texels",
                        depths.size().width_px, depths.size().height_px, map.resolution_texels));
    }
    const analysis::DepthMapping mapping{comparison.view.first_map().depth_range()};
    const float farthest = mapping.range().reversed ? 0.0F : 1.0F;
    const auto distance_m = [&](std::size_t i) {
        return depths[i] == farthest
                   ? std::numeric_limits<float>::quiet_NaN()
                   : static_cast<float>(mapping.light_distance_m(double{depths[i]}));
    };
    const std::array<ExrChannel, 2> channels{{
        {"depth", ChannelType::float32,
         [&](std::size_t i) { return std::bit_cast<std::uint32_t>(depths[i]); }},
        {"light_distance_m", ChannelType::float32,
         [&](std::size_t i) { return std::bit_cast<std::uint32_t>(distance_m(i)); }},
    }};
    write_file(path, encode_exr(size, channels, exr_header(comparison)));
}

} // namespace gnomon::store
