#include "analysis/advice/map_cost.hpp"

namespace gnomon::analysis {

namespace {

/// Bytes of a texel: a whole number of GL's smallest formats; u-formats as if GL had them.
std::uint64_t texel_bytes(scene::DepthFormat format)
{
    return format.bits <= 16 ? 2 : 4;
}

} // namespace

std::uint64_t map_bytes(const scene::ShadowMapSettings& map)
{
    const auto side = static_cast<std::uint64_t>(map.resolution_texels);
    return side * side * texel_bytes(map.depth_format);
}

int tap_count(scene::Filter filter)
{
    return static_cast<int>(scene::promises(filter).tap_count());
}

} // namespace gnomon::analysis
