#include "random_depths.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::tests {

scene::Image<float> random_depths(std::mt19937& random, int side)
{
    std::uniform_real_distribution<double> share{0, 1};
    scene::Image<float> depths{{side, side}};
    constexpr int block = 8;
    for (int y = 0; y < side; y += block) {
        for (int x = 0; x < side; x += block) {
            const double middle = share(random);
            const double spread = std::exp2(-26 * share(random)) - 0x1p-26;
            for (int j = y; j < std::min(side, y + block); ++j) {
                for (int i = x; i < std::min(side, x + block); ++i) {
                    depths(i, j) = static_cast<float>(
                        std::clamp(middle + spread * (share(random) - 0.5), 0.0, 1.0));
                }
            }
        }
    }
    return depths;
}

} // namespace gnomon::tests
