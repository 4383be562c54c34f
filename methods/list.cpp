#include "methods/list.hpp"

#include "methods/all_methods.hpp"
#include "methods/depth/depth_map.hpp"

#include <array>

namespace gnomon::methods {

std::span<const Method> methods()
{
    static const std::array list{depth_map(),
                                 variance_map(),
                                 exponential_map(),
                                 exponential_variance_map(),
                                 moment_map(),
                                 primitive_map(),
                                 shadow_volumes(),
                                 percentage_closer(),
                                 percentage_closer_soft_shadows(),
                                 second_layer_map()};
    return list;
}

} // namespace gnomon::methods
