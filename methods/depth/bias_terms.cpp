#include "methods/depth/bias_terms.hpp"

#include <array>

namespace gnomon::methods {
namespace {

constexpr auto constant_keys =
    std::to_array<std::string_view>({"bias.constant", "bias.constant_m"});
constexpr auto slope_keys = std::to_array<std::string_view>({"bias.slope"});
constexpr auto normal_keys = std::to_array<std::string_view>({"bias.normal_texels"});

constexpr auto term_table = std::to_array<BiasTerm>({
    {"constant", constant_keys, BiasPlace::receiver_depth,
     "b = constant, or constant_m / (far − near): lit if fl(r − fl(b + s)) ≤ d, with s the slope "
     "term"},
    {"slope", slope_keys, BiasPlace::receiver_depth,
     "s = fl(slope · tan θ), added to b; θ lies between the geometric normal and the light"},
    {"normal offset", normal_keys, BiasPlace::lookup_position,
     "looks up P + normal_texels · w · n in place of P: w a texel's width there, n the geometric "
     "normal on the light's side"},
});

} // namespace

std::span<const BiasTerm> bias_terms()
{
    return term_table;
}

} // namespace gnomon::methods
