#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/image.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/view/view.hpp"

#include <cstddef>
#include <memory>

namespace gnomon::benchmarks {

/// The floor of any shadow truth: one `rtcOccluded16` pass over native triangles, ROBUST scene,
/// coherent flag, prebuilt packets of 4×4 pixels, tnear 1e-4 × the scene's diagonal, all cores.
class RawEmbreePass {
public:
    /// Builds the hierarchy and the packets: a shadow ray for every pixel that is scored.
    RawEmbreePass(const scene::TriangleScene& triangles, const scene::View& view,
                  const scene::Truth& truth, const scene::Image<scene::Vec3f>& points);
    ~RawEmbreePass();
    RawEmbreePass(const RawEmbreePass&) = delete;
    RawEmbreePass& operator=(const RawEmbreePass&) = delete;

    /// Traces all packets; returns how many rays are occluded.
    std::size_t run();
    [[nodiscard]] std::size_t ray_count() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::benchmarks
