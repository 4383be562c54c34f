#pragma once

#include "reference_rt/exact/predicates.hpp"
#include "reference_rt/light/depth_term.hpp"
#include "reference_rt/light/light_depth.hpp"
#include "reference_rt/pixels/pixel_packets.hpp"

#include <cstddef>

namespace gnomon::reference_rt {

/// P as it stands to the light; made again only as far as it changes.
class LitPoint {
public:
    /// @param distance  what maps hold in place of depths, or nullptr.
    LitPoint(const SeenPixels& seen, const LightDepth& depth, const LightDistance* distance)
        : seen_{seen},
          depth_{depth},
          distance_{distance},
          has_eye_{seen.view.camera.projection == scene::Projection::perspective}
    {
    }

    void move_to(std::size_t pixel)
    {
        if (pixel == pixel_) {
            return;
        }
        pixel_ = pixel;
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
    /// Its depth, found when first asked for.
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
            return DepthTerm{*distance_, receiver_, distance_->at(receiver_)};
        }
        return DepthTerm{
            depth_, receiver_,
            depth_.closely_at(depth_.plainly_along(ray_.ray), parameter_of(receiver_))};
    }

    const SeenPixels& seen_;
    const LightDepth& depth_;
    const LightDistance* distance_;
    bool has_eye_;
    std::size_t pixel_ = static_cast<std::size_t>(-1);
    ExactTriangle face_;
    Filtered<8> nu_; ///< of all rays from one eye
    CameraRay ray_;
    Receiver receiver_;
    bool has_term_ = false;
    DepthTerm term_;
};

} // namespace gnomon::reference_rt
