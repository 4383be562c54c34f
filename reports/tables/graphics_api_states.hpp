#pragma once

#include "analysis/tune/tune.hpp"
#include "methods/polygon_offset.hpp"
#include "store/json.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::reports {

/// What a setting is in one graphics interface.
struct ApiState {
    std::string api;                ///< "GL", "Direct3D", "Vulkan"
    std::vector<std::string> lines; ///< of code, or why there is none
};

/// The states that draw and look up such a map: format, comparison, culling, polygon offset; and
/// the lines of the lookup's shader that the setting's biases belong to.
/// @param offset        of the job; a tuned setting has none of its own.
/// @param other_biases  that the job sets beside them, "bias.slope_kernels = 1".
[[nodiscard]] std::vector<ApiState>
api_states(const analysis::TunedSetting& setting,
           const std::optional<methods::PolygonOffset>& offset = {},
           std::span<const std::string> other_biases = {});

} // namespace gnomon::reports
