#pragma once

#include "analysis/tune/tune.hpp"
#include "methods/polygon_offset.hpp"
#include "store/json.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::reports {

/// What a setting is in one graphics interface.
struct ApiState {
    std::string api;                ///< "GL", "Direct3D", "Vulkan"
    std::vector<std::string> lines; ///< of code, or why there is none
};

/// The states that draw and look up such a map: format, comparison, culling, polygon offset. Other
/// biases are not among them: they are subtracted from the receiver's depth in the shader.
/// @param offset  of the job; a tuned setting has none of its own.
[[nodiscard]] std::vector<ApiState>
api_states(const analysis::TunedSetting& setting,
           const std::optional<methods::PolygonOffset>& offset = {});

} // namespace gnomon::reports
