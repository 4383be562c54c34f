#include "cpp/picture.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace engine {

std::vector<Floats> mask_of_pictures(const std::vector<float>& shadowed,
                                     const std::vector<float>& unshadowed, const Scene& scene)
{
    constexpr float least_light = 1e-6F;
    Floats shadow{"shadow", scene.width, scene.height, 1, {}};
    Floats valid{"valid", scene.width, scene.height, 1, {}};
    for (std::size_t i = 0; i < shadowed.size(); i += 4) {
        const bool is_told = unshadowed[i] > least_light; // not so of NaN, where nothing is seen
        shadow.values.push_back(is_told ? std::clamp(shadowed[i] / unshadowed[i], 0.0F, 1.0F) : 0);
        valid.values.push_back(is_told ? 1.0F : 0.0F);
    }
    return {std::move(shadow), std::move(valid)};
}

} // namespace engine
