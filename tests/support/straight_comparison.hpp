#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/renderers.hpp"

#include <utility>

namespace gnomon::tests {

/// Compares the view of a begun comparison step by step. A sweep's plan must give the same.
inline analysis::Comparison compare_straight(analysis::Comparison begun,
                                             const analysis::Renderers& renderers)
{
    renderers::Drawn drawn{
        renderers.rasterizer.draw_receivers(begun.view),
        renderers::draw_filtered_map(renderers.rasterizer, begun.job, begun.view)};
    begun.receivers = drawn.receivers->layers();
    begun.lookup = renderers.rasterizer.look_up({drawn, begun.job, begun.view});
    begun.truth = renderers.reference.find_truth(begun.view, begun.receivers,
                                                 drawn.receivers->raster_facts());
    measure_fully(begun, std::move(drawn), renderers, {begun.view.bias.constant});
    return begun;
}

} // namespace gnomon::tests
