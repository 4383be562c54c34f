#pragma once

#include "analysis/environment.hpp"
#include "renderers/rasterizer.hpp"
#include "renderers/reference.hpp"

namespace gnomon::analysis {

/// Both renderers of one scene, which must outlive this.
struct Renderers {
    renderers::Rasterizer& rasterizer;
    const renderers::Reference& reference;
    Environment environment;
};

} // namespace gnomon::analysis
