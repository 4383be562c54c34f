#pragma once

#include "analysis/depth/depth_mapping.hpp"

#include <vector>

namespace gnomon::analysis::test {

/// The textbook lesson's frustum: near 4, far 50.
inline scene::DepthRange
lesson_range(scene::Projection projection = scene::Projection::perspective, bool reversed = false,
             scene::ClipRange clip_range = scene::ClipRange::minus_one_to_one)
{
    return {projection, 4, 50, reversed, clip_range};
}

/// Near 4, far 50, in every projection, direction and clip range.
inline std::vector<DepthMapping> all_mappings()
{
    std::vector<DepthMapping> mappings;
    for (const auto projection :
         {scene::Projection::perspective, scene::Projection::orthographic}) {
        for (const bool reversed : {false, true}) {
            for (const auto clip_range :
                 {scene::ClipRange::minus_one_to_one, scene::ClipRange::zero_to_one}) {
                mappings.emplace_back(lesson_range(projection, reversed, clip_range));
            }
        }
    }
    return mappings;
}

} // namespace gnomon::analysis::test
