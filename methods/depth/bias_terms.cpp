#include "methods/depth/bias_terms.hpp"

#include "methods/depth/terms/adaptive.hpp"
#include "methods/depth/terms/constant.hpp"
#include "methods/depth/terms/kernel_slope.hpp"
#include "methods/depth/terms/normal_length.hpp"
#include "methods/depth/terms/normal_offset.hpp"
#include "methods/depth/terms/polygon_offset.hpp"
#include "methods/depth/terms/receiver_plane.hpp"
#include "methods/depth/terms/slope.hpp"
#include "methods/depth/terms/texel_bias.hpp"

#include <array>

namespace gnomon::methods {
namespace {

constexpr auto term_table = std::to_array<BiasTerm>({
    constant_bias,
    slope_bias,
    normal_offset,
    normal_length,
    texel_bias,
    polygon_offset,
    kernel_slope,
    adaptive_bias,
    receiver_plane,
});

} // namespace

std::span<const BiasTerm> bias_terms()
{
    return term_table;
}

} // namespace gnomon::methods
