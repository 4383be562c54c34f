#pragma once

#include "analysis/comparison/comparison.hpp"
#include "temporary_folder.hpp"

namespace gnomon::store {

struct ExampleOptions {
    scene::ImageSize image{96, 64};
    int sphere_segments = 8;
    int resolution_texels = 48;
    double bias_constant = 0.002;
};

/// A small comparison with every kind of error, made without GL and Embree: a sphere and a box on
/// the ground under a directional light, rendered by brute-force rays.
struct Example {
    scene::SceneFile file;
    analysis::Comparison comparison;
    scene::Image<scene::Vec3f> points; ///< P of each pixel

    explicit Example(const ExampleOptions& options = {});
    Example(const Example&) = delete; // the comparison points to the file's triangles
    Example& operator=(const Example&) = delete;
};

/// The default example, which is computed once.
[[nodiscard]] const Example& example();

using tests::read_text;
using tests::TemporaryFolder;

} // namespace gnomon::store
