#include "cli/renderer/last_mask.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace gnomon::cli {

bool LastMask::take(const scene::Image<float>& mask, const std::string& opened)
{
    bool is_again = opened != opened_ && mask.size() == mask_.size();
    for (std::size_t i = 0; is_again && i < mask.pixel_count(); ++i) {
        is_again = std::bit_cast<std::uint32_t>(mask[i]) == std::bit_cast<std::uint32_t>(mask_[i]);
    }
    mask_ = mask;
    opened_ = opened;
    return is_again;
}

bool LastMask::must_differ(const analysis::Metrics& measured)
{
    constexpr std::uint64_t parts = 100;
    const std::uint64_t blocked = measured.pixels.of(scene::PixelClass::blocked);
    const std::uint64_t lit = measured.pixels.of(scene::PixelClass::lit);
    const bool lights_all = measured.false_shadow == 0 && measured.false_lit == blocked;
    const bool lights_none = measured.false_lit == 0 && measured.false_shadow == lit;
    const std::uint64_t before = std::exchange(blocked_, blocked);
    const std::uint64_t change = std::max(before, blocked) - std::min(before, blocked);
    return !lights_all && !lights_none && parts * change > lit + blocked;
}

} // namespace gnomon::cli
