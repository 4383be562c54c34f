#pragma once

#include "analysis/depth/depth_study.hpp"
#include "raster_gl/context.hpp"
#include "scene/depth/measured_planes.hpp"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::api {

/// A way to store depth, and GL's format for it where there is one.
struct DepthChoice {
    analysis::DepthCoding coding = analysis::DepthCoding::unorm(24);
    std::optional<scene::DepthFormat> format; ///< empty: theory only
    std::string name;                         ///< "d24", or "27-bit unorm"
    bool is_named = false; ///< it was asked for by its name, and no other will do
};

/// The format of a name, or of a number of bits: d16, d24, d32, else u8 … u24; 25 to 31 have none.
/// @param format  "" if `bits` decide.
/// @throws scene::InputError  naming the argument.
[[nodiscard]] DepthChoice choose_format(const std::string& format, std::optional<int> bits);

/// The formulas alone.
[[nodiscard]] analysis::DepthStudy study_theory(const DepthChoice& choice,
                                                const scene::MeasuredPlaneSettings& planes,
                                                const std::string& not_measured_because);

/// Theory and measurement of several formats on the same planes.
///
/// A format that this driver does not have is left unmeasured and says so.
/// @throws scene::InputError  if the planes cannot be made, or GL clips all of them.
[[nodiscard]] std::vector<analysis::DepthStudy>
study_formats(const raster_gl::Context& context, const std::vector<DepthChoice>& choices,
              const scene::MeasuredPlaneSettings& settings);

} // namespace gnomon::api
