#include "methods/depth/bias_terms.hpp"

#include "methods/depth/terms/constant.hpp"
#include "methods/depth/terms/normal_offset.hpp"
#include "methods/depth/terms/slope.hpp"

#include <array>

namespace gnomon::methods {
namespace {

constexpr auto term_table = std::to_array<BiasTerm>({
    constant_bias,
    slope_bias,
    normal_offset,
});

} // namespace

std::span<const BiasTerm> bias_terms()
{
    return term_table;
}

} // namespace gnomon::methods
