#include "reference_rt/light/depth_term.hpp"

#include "reference_rt/light/float_rounding.hpp"

#include <limits>

namespace gnomon::reference_rt {

Wide DepthTerm::sharp() const
{
    if (hit_ != nullptr && !hit_->is_well_scaled()) {
        return Wide{0, 0, std::numeric_limits<double>::infinity()};
    }
    const Wide depth = hit_ == nullptr        ? WideField::number(constant_)
                       : distance_ != nullptr ? distance_->widely_at(*hit_, offset_)
                                              : depth_->widely_at(*hit_, offset_);
    return shift_ == 0 ? depth : depth + WideField::number(shift_);
}

ExactDepth DepthTerm::exact() const
{
    ExactDepth depth = hit_ == nullptr ? ExactDepth{Fraction::number(constant_), false}
                       : distance_ != nullptr
                           ? distance_->exactly_at(*hit_, offset_)
                           : ExactDepth{depth_->exactly_at(*hit_, offset_), false};
    if (depth.is_square) {
        depth.shift = shift_;
    } else if (shift_ != 0) {
        depth.number = depth.number - Fraction::number(-shift_);
    }
    return depth;
}

DepthTerm DepthTerm::shifted(double by) const
{
    if (by == 0) {
        return *this;
    }
    DepthTerm moved = *this;
    moved.shift_ += by;
    moved.interval_ = interval_ + Interval{by, 0};
    return moved;
}

Sign DepthTerm::sign_beyond(double number) const
{
    const ExactDepth depth = exact();
    return depth.is_square
               ? ShiftedRoots{{depth.number, Fraction::number(0)}, depth.shift}.sign_beyond(number)
               : depth.number.sign_beyond(number);
}

DepthTerm DepthTerm::clamped() const
{
    const Interval rest = Interval{1, 0} - interval_;
    if (interval_.is_certainly_positive() && rest.is_certainly_positive()) {
        return *this;
    }
    if (sign_beyond(0) < 0) {
        return DepthTerm{0};
    }
    return sign_beyond(1) > 0 ? DepthTerm{1} : *this;
}

float DepthTerm::nearest_float() const
{
    if (const auto depth = certainly_rounded<ToNearest>(bounded())) {
        return *depth;
    }
    if (const auto depth = certainly_rounded<ToNearest>(sharp())) {
        return *depth;
    }
    const auto [depth, is_square, shift] = exact();
    if (is_square) {
        return exactly_rounded<ToNearest>(ShiftedRoots{{depth, Fraction::number(0)}, shift});
    }
    return depth.denominator.sign() == 0 ? std::numeric_limits<float>::quiet_NaN()
                                         : exactly_rounded<ToNearest>(depth);
}

DepthTerm TapDepths::term(const renderers::ExactTap& tap, TapHit& hit) const
{
    if (tap.triangle == scene::no_triangle) {
        return DepthTerm{tap.depth}.shifted(tap.shift);
    }
    SignCounts counts;
    const auto map = static_cast<std::size_t>(tap.texel.map);
    hit.ray = CameraRay{maps_.rays[map].ray(tap.texel)};
    hit.face = {triangles_, tap.triangle};
    hit.hit = Receiver{hit.face, hit.ray, counts};
    if (const LightDistance* distance = maps_.distance(map)) {
        return DepthTerm{*distance, hit.hit, distance->at(hit.hit)}
            .clamped() // beyond far is nothing
            .shifted(tap.shift);
    }
    return DepthTerm{maps_.depths[map], hit.hit, known_hit(tap)}.shifted(tap.shift);
}

float TapDepths::nearest_float(const renderers::ExactTap& tap) const
{
    if (const auto depth = certainly_rounded<ToNearest>(known(tap))) {
        return *depth; // as a rule, without finding the hit again
    }
    TapHit hit;
    return term(tap, hit).nearest_float();
}

} // namespace gnomon::reference_rt
