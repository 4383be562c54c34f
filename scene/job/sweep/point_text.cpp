#include "scene/job/sweep/point_text.hpp"

#include "scene/one_line.hpp"

#include <fmt/format.h>

#include <string_view>

namespace gnomon::scene {

std::string point_text(const SweepSpace& space, const SweepPoint& point, bool with_bias)
{
    std::string text{space.case_name(point)};
    for (std::size_t i = 0; i < space.axes().size(); ++i) {
        const SweepAxis& axis = space.axes()[i];
        if (space.concerns(i, point) && (with_bias || !space.is_bias_axis(i))) {
            text += text.empty() ? "" : ", ";
            text += fmt::format("{} {}", axis.key, axis.values[point.values[i]]);
        }
    }
    if (const std::string_view light = space.light_name(point); !light.empty()) {
        text += fmt::format("{}light {}", text.empty() ? "" : ", ", light);
    }
    return one_line(text);
}

} // namespace gnomon::scene
