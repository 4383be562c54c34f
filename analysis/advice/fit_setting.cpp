#include "analysis/advice/fit_setting.hpp"

#include <fmt/format.h>

namespace gnomon::analysis {

std::string fit_setting(scene::Fit own, scene::Fit fit)
{
    const bool replaces_fixed = own == scene::Fit::fixed && fit != scene::Fit::fixed;
    return fmt::format("fit = \"{}\"{}", scene::fit_name(fit),
                       replaces_fixed ? " # and remove half_extent or fov_deg" : "");
}

} // namespace gnomon::analysis
