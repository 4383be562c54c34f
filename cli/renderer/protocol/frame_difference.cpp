#include "cli/renderer/protocol/frame_difference.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace gnomon::cli {
namespace {

template <typename Pixel>
std::string difference(std::string_view name, const scene::Image<Pixel>& a,
                       const scene::Image<Pixel>& b)
{
    static_assert(std::is_trivially_copyable_v<Pixel>);
    if (a.size() != b.size()) {
        return fmt::format("{} is {}x{} in one and {}x{} in the other", name, a.size().width_px,
                           a.size().height_px, b.size().width_px, b.size().height_px);
    }
    using Bits = std::array<std::byte, sizeof(Pixel)>; // NaN is NaN, bit by bit
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < a.pixel_count(); ++i) {
        if (std::bit_cast<Bits>(a[i]) != std::bit_cast<Bits>(b[i])) {
            first = count == 0 ? i : first;
            ++count;
        }
    }
    const auto width = static_cast<std::size_t>(a.size().width_px);
    return count == 0 ? std::string{}
                      : fmt::format("{} differs at {} pixel{}, first at ({}, {})", name, count,
                                    count == 1 ? "" : "s", first % width, first / width);
}

} // namespace

std::string frame_difference(const scene::CaseLayers& a, const scene::CaseLayers& b)
{
    for (const std::string& found :
         {difference("the mask", a.mask, b.mask), difference("P", a.position, b.position),
          difference("Ng", a.normal, b.normal),
          difference("id.geom", a.object_number, b.object_number),
          difference("z.light", a.z_light, b.z_light), difference("z.map", a.z_map, b.z_map),
          difference("texel", a.texels, b.texels), difference("map_index", a.maps, b.maps),
          difference("kernel_axis", a.kernel_axes, b.kernel_axes),
          difference("tan_theta", a.tan_theta, b.tan_theta),
          difference("moved", a.terms.moved, b.terms.moved),
          difference("tap_gradient", a.terms.gradients, b.terms.gradients),
          difference("unmoved", a.unmoved.samples, b.unmoved.samples),
          difference("unmoved.texel", a.unmoved.texels, b.unmoved.texels),
          difference("map.d", a.map_depths, b.map_depths)}) {
        if (!found.empty()) {
            return found;
        }
    }
    return {};
}

} // namespace gnomon::cli
