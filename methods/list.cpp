#include "methods/list.hpp"

#include "methods/depth/depth_map.hpp"
#include "methods/esm/exponential_map.hpp"
#include "methods/evsm/exponential_variance_map.hpp"
#include "methods/msm/moment_map.hpp"
#include "methods/pcf/percentage_closer.hpp"
#include "methods/pcss/soft_shadows.hpp"
#include "methods/primitive_id/primitive_map.hpp"
#include "methods/second_layer/second_layer.hpp"
#include "methods/shadow_volumes/shadow_volumes.hpp"
#include "methods/vsm/variance_map.hpp"

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
