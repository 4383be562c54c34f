#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <memory>

namespace gnomon::benchmarks {

/// The lower limit of a shadow truth's time: one `rtcOccluded16` pass over native triangles, with a
/// ROBUST scene, coherent flag, prebuilt packets of 4×4 pixels, tnear of 1e-4 × the scene's
/// diagonal, all cores.
class RawEmbreePass {
public:
    /// Builds the hierarchy and the packets, with a shadow ray for each scored pixel.
    RawEmbreePass(const scene::TriangleScene& triangles, const scene::View& view,
                  const scene::Truth& truth, const scene::Image<scene::Vec3f>& points);
    ~RawEmbreePass();
    RawEmbreePass(const RawEmbreePass&) = delete;
    RawEmbreePass& operator=(const RawEmbreePass&) = delete;

    /// Traces all packets; returns the number of occluded rays.
    std::size_t run();
    [[nodiscard]] std::size_t ray_count() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::benchmarks
