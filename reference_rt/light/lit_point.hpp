#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/critical_bias.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/pixels/pixel_packets.hpp"

#include <algorithm>
#include <cstddef>

namespace gnomon::reference_rt {

/// A pixel's point P and its depth for the light; recomputes only what changes between pixels.
class LitPoint {
public:
    /// @param distance  the distance that maps store instead of depths, or null.
    LitPoint(const SeenPixels& seen, const LightDepth& depth, const LightDistance* distance)
        : seen_{seen},
          depth_{depth},
          distance_{distance},
          has_eye_{seen.view.camera.projection == scene::Projection::perspective}
    {
    }

    /// @param moved  the pixel's `ReceiverRule::moved`; must be constant for a pixel.
    void move_to(std::size_t pixel, const scene::Vec4f& moved = scene::Vec4f{0})
    {
        if (pixel == pixel_) {
            return;
        }
        pixel_ = pixel;
        offset_ = scene::Vec3d{moved};
        // Numbers this large compare as infinity does.
        constexpr double largest = 0x1p100;
        const double nearer = std::clamp(double{moved.w}, -largest, largest);
        shift_ = depth_.is_reversed() ? nearer : -nearer;
        ray_ = seen_.ray_of(pixel);
        const bool is_same_face = seen_.receivers[pixel] == face_.triangle;
        if (!is_same_face) {
            face_ = seen_.face_of(pixel);
        }
        if (!is_same_face || !has_eye_) {
            nu_ = nu_of(face_, ray_.ray.origin);
        }
        SignCounts counts;
        receiver_ = Receiver{face_, ray_, nu_, counts};
        has_term_ = false;
    }
    [[nodiscard]] const Receiver& receiver() const { return receiver_; }
    /// P′ − P
    [[nodiscard]] const scene::Vec3d& offset() const { return offset_; }
    /// The depth of P′, moved nearer to the light; computed on first use.
    [[nodiscard]] const DepthTerm& term()
    {
        if (!has_term_) {
            term_ = receiver_.delta_sign == 0 ? DepthTerm{} : found_term();
            has_term_ = true;
        }
        return term_;
    }

private:
    [[nodiscard]] DepthTerm found_term() const
    {
        if (distance_ != nullptr) {
            return DepthTerm{*distance_, receiver_, distance_->at(receiver_, offset_), offset_}
                .shifted(shift_);
        }
        const ClipLine line = offset_ == scene::Vec3d{0.0}
                                  ? depth_.plainly_along(ray_.ray)
                                  : depth_.plainly_along(ray_.ray, offset_);
        return DepthTerm{depth_, receiver_, depth_.closely_at(line, parameter_of(receiver_)),
                         offset_}
            .shifted(shift_);
    }

    const SeenPixels& seen_;
    const LightDepth& depth_;
    const LightDistance* distance_;
    bool has_eye_;
    std::size_t pixel_ = static_cast<std::size_t>(-1);
    ExactTriangle face_;
    Filtered<8> nu_; ///< shared by all rays from one eye
    CameraRay ray_;
    Receiver receiver_;
    scene::Vec3d offset_{0.0};
    double shift_ = 0; ///< added to the depth
    bool has_term_ = false;
    DepthTerm term_;
};

} // namespace gnomon::reference_rt
