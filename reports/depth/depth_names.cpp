#include "reports/depth/depth_names.hpp"

#include <fmt/format.h>

namespace gnomon::reports {

std::string_view clip_range_name(scene::ClipRange range)
{
    return range == scene::ClipRange::zero_to_one ? "zero_to_one" : "minus_one_to_one";
}

std::string range_text(const scene::DepthRange& range)
{
    return fmt::format("{}, near {} m, far {} m, clip {}{}",
                       scene::projection_name(range.projection), range.near_m, range.far_m,
                       range.clip_range == scene::ClipRange::zero_to_one ? "[0, 1]" : "[-1, 1]",
                       range.reversed ? ", reversed" : "");
}

std::string mapping_text(const analysis::DepthMapping& mapping)
{
    return mapping.stores_gl_depth() ? range_text(mapping.range())
                                     : fmt::format("{} over far, near {} m, far {} m",
                                                   scene::map_content_name(mapping.content()),
                                                   mapping.near_m(), mapping.far_m());
}

std::string_view distance_symbol(const analysis::DepthMapping& mapping)
{
    return mapping.measure() == scene::Measure::ray ? "r" : "z";
}

std::string metres(double length_m)
{
    return fmt::format("{:.4g} m", length_m);
}

} // namespace gnomon::reports
