#include "reference_rt/light/depth_term.hpp"

#include "reference_rt/light/float_rounding.hpp"

#include <limits>

namespace gnomon::reference_rt {

Wide DepthTerm::sharp() const
{
    if (hit_ == nullptr) {
        return {bounded_.value, 0, bounded_.error};
    }
    if (!hit_->is_well_scaled()) {
        return Wide{0, 0, std::numeric_limits<double>::infinity()};
    }
    return distance_ != nullptr ? distance_->widely_at(*hit_) : depth_->widely_at(*hit_);
}

ExactDepth DepthTerm::exact() const
{
    if (hit_ == nullptr) {
        return {Fraction::number(bounded_.value), false};
    }
    return distance_ != nullptr ? distance_->exactly_at(*hit_)
                                : ExactDepth{depth_->exactly_at(*hit_), false};
}

DepthTerm DepthTerm::clamped() const
{
    const Bounded rest = Bounded{1, 0} - bounded_;
    if (bounded_.is_certainly_positive() && rest.is_certainly_positive()) {
        return *this;
    }
    const Fraction depth = exact().number; // or its square, which is on the same side of 0 and 1
    if (depth.sign() < 0) {
        return DepthTerm{0};
    }
    return (depth - Fraction::number(1)).sign() > 0 ? DepthTerm{1} : *this;
}

float DepthTerm::nearest_float() const
{
    if (const auto depth = certainly_rounded<ToNearest>(bounded())) {
        return *depth;
    }
    if (const auto depth = certainly_rounded<ToNearest>(sharp())) {
        return *depth;
    }
    const auto [depth, is_square] = exact();
    if (is_square) {
        return exactly_rounded<ToNearest>(Root{depth});
    }
    return depth.denominator.sign() == 0 ? std::numeric_limits<float>::quiet_NaN()
                                         : exactly_rounded<ToNearest>(depth);
}

DepthTerm TapDepths::term(const scene::ExactTap& tap, TapHit& hit) const
{
    if (tap.triangle == scene::no_triangle) {
        return DepthTerm{tap.depth};
    }
    SignCounts counts;
    const auto map = static_cast<std::size_t>(tap.texel.map);
    hit.ray = CameraRay{maps_.rays[map].ray(tap.texel)};
    hit.face = ExactTriangle{tap.triangle, corners_of(triangles_, tap.triangle)};
    hit.hit = Receiver{hit.face, hit.ray, counts};
    if (const LightDistance* distance = maps_.distance(map)) {
        return DepthTerm{*distance, hit.hit, distance->at(hit.hit)}
            .clamped(); // beyond far is nothing
    }
    return DepthTerm{maps_.depths[map], hit.hit, known(tap)};
}

float TapDepths::nearest_float(const scene::ExactTap& tap) const
{
    if (const auto depth = certainly_rounded<ToNearest>(known(tap))) {
        return *depth; // as a rule, without finding the hit again
    }
    TapHit hit;
    return term(tap, hit).nearest_float();
}

} // namespace gnomon::reference_rt
