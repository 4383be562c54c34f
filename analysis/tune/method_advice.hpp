#pragma once

#include "analysis/tune/method_tune.hpp"

namespace gnomon::analysis {

/// Adds to a comparison's advice the setting of each method that is least wrong over all views, and
/// says which methods were passed over.
/// @param views  The job's own first.
/// @throws scene::InputError  as `tune_methods`.
void advise_methods(Comparison& comparison, const CheckedViews& views, const scene::SceneFile& file,
                    const Renderers& renderers, const MethodRequest& request,
                    const MethodProgress& progress);

} // namespace gnomon::analysis
