#pragma once

#include "scene/job.hpp"
#include "scene/layers.hpp"
#include "scene/triangles.hpp"

#include <cstdint>
#include <memory>

namespace gnomon::reference_rt {

enum class TruthMethod : std::uint8_t {
    judged, ///< Embree proposes, double arithmetic judges each proposal
    plain,  ///< float Embree rays alone, `--truth float`: for comparing speed
};

struct TruthOptions {
    TruthMethod method = TruthMethod::judged;
    int threads = 0; ///< 0: all cores
};

/// GL's state that the explanation of unmatched pixels needs.
struct RasterFacts {
    int subpixel_bits = 8;
};

/// The scene in Embree's hands; built once, then read by any number of threads.
class ReferenceScene {
public:
    /// @throws scene::EnvironmentError  if Embree fails.
    explicit ReferenceScene(const scene::TriangleScene& triangles, int threads = 0);
    ~ReferenceScene();
    ReferenceScene(ReferenceScene&&) noexcept;
    ReferenceScene& operator=(ReferenceScene&&) noexcept;

    [[nodiscard]] const scene::TriangleScene& triangles() const;

    struct Implementation;
    [[nodiscard]] const Implementation& implementation() const { return *implementation_; }

private:
    std::unique_ptr<Implementation> implementation_;
};

/// Decides the class of every pixel (DESIGN §3) for GL's triangle in each.
///
/// Independent of every shadow-map setting. Deterministic for any number of threads.
/// @param receivers  GL's triangle per pixel, of size `view.image`.
/// @throws std::invalid_argument  if sizes differ or an index is out of range.
[[nodiscard]] scene::TruthLayers compute_truth(const ReferenceScene& reference,
                                               const scene::View& view,
                                               const scene::Image<std::uint32_t>& receivers,
                                               const RasterFacts& raster,
                                               const TruthOptions& options = {});

/// P of each pixel, the pixel-centre ray ∩ plane(T), computed in double and rounded to float32;
/// NaN where there is no receiver.
[[nodiscard]] scene::Image<scene::Vec3f>
receiver_points(const scene::TriangleScene& triangles, const scene::View& view,
                const scene::Image<std::uint32_t>& receivers);

/// "Embree 3.13.5", for the environment record.
[[nodiscard]] std::string embree_version();

} // namespace gnomon::reference_rt
