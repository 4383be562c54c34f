#pragma once

#include "scene/image.hpp"
#include "scene/light/frustum.hpp"
#include "scene/pixels/pixel_class.hpp"
#include "scene/settings/job.hpp"
#include "store/images/layer_file.hpp"
#include "store/json_values.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::reports {

/// The settings from which a configuration's pixel values are derived.
struct PixelRules {
    /// @param detail  The output of `compare --json`.
    /// @throws nlohmann::json::exception  if a member is missing.
    explicit PixelRules(const store::Json& detail);

    [[nodiscard]] double texel_m(double light_distance_m) const
    {
        const bool is_perspective = light.projection == scene::Projection::perspective;
        return is_perspective ? texel_side_m * light_distance_m : texel_side_m;
    }

    store::Json frustum;
    std::string filter; ///< empty: the method has none
    double slope;
    std::string outside;
    double bias;         ///< constant, in depth units
    double texel_side_m; ///< perspective: at ζ = 1 m
    std::optional<scene::DepthFormat> format;
    scene::LightFrustum light; ///< only projection, near, far and direction
};

/// The layers of a file from which others may be derived.
class ImageLayers {
public:
    /// @param rules  must outlive this.
    /// @throws scene::InputError  as `LayerFile` does.
    ImageLayers(store::LayerFile& file, const PixelRules& rules);

    [[nodiscard]] const scene::Image<float>& receiver_depth() const { return receiver_depth_; }
    [[nodiscard]] const scene::Image<float>& map_depth() const { return map_depth_; }
    [[nodiscard]] const scene::Image<float>& light_distance_m() const { return light_distance_m_; }
    [[nodiscard]] const scene::Image<float>& critical() const { return critical_; }
    [[nodiscard]] const scene::Image<float>& needed_m() const { return needed_m_; }
    [[nodiscard]] const scene::Image<float>& needed_texels() const { return needed_texels_; }
    [[nodiscard]] bool has_biases() const { return has_biases_; }
    [[nodiscard]] bool has_diagnosis() const { return has_diagnosis_; }

    /// For each scored pixel, the rank of its critical bias (`bias_rank`) minus the rank of the
    /// difference of its two depths, modulo 2^32; 0 elsewhere. Most are near 0 and compress well.
    [[nodiscard]] std::vector<std::uint32_t> critical_steps() const;
    /// Whether the needed bias of every scored pixel, in metres and texels, follows bit for bit
    /// from its critical bias and light distance, computed in double and rounded once.
    [[nodiscard]] bool can_derive_lengths() const;

private:
    /// The bias that a lit pixel needs, or the largest that a blocked one allows.
    [[nodiscard]] float limit(std::size_t i) const;
    template <typename Holds>
    [[nodiscard]] bool all_scored(const Holds& holds) const;

    const PixelRules& rules_;
    scene::Image<scene::PixelClass> classes_;
    scene::Image<float> receiver_depth_;
    scene::Image<float> map_depth_;
    scene::Image<float> light_distance_m_;
    scene::Image<float> critical_;
    scene::Image<float> needed_m_;
    scene::Image<float> needed_texels_;
    bool has_biases_;
    bool has_diagnosis_;
};

} // namespace gnomon::reports
