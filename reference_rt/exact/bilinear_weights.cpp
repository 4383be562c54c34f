#include "reference_rt/exact/bilinear_weights.hpp"

#include "reference_rt/exact/terms.hpp"

#include <limits>

namespace gnomon::reference_rt {

namespace {

/// Limits to [0, 1]: what is known of a number is known of the limited one too.
Interval limited(const Interval& x)
{
    return {x.value < 0 ? 0 : x.value > 1 ? 1 : x.value, x.error};
}
Wide limited(const Wide& x)
{
    const auto is_beyond_1 = x.high > 1 || (x.high == 1 && x.low > 0);
    return x.high < 0 ? Wide{0, 0, x.error} : is_beyond_1 ? Wide{1, 0, x.error} : x;
}
Fraction limited(const Fraction& x)
{
    return x.sign() < 0                           ? Fraction::number(0)
           : (x - Fraction::number(1)).sign() > 0 ? Fraction::number(1)
                                                  : x;
}

/// @param one  the number 1
template <typename Number>
std::array<Number, 4> products(const Number& one, const Number& x, const Number& y)
{
    const Number left = one - x;
    const Number below = one - y;
    return {left * below, x * below, left * y, x * y};
}

} // namespace

std::array<Interval, 4> BilinearWeights::bounded() const
{
    const scene::Ray& ray = hit_.ray();
    const auto row = [&](const scene::Vec4d& of) {
        return plain_row_at(of, ray.origin, 1) + plain_row_at(of, offset_, 0) +
               parameter_of(hit_) * plain_row_at(of, ray.direction, 0);
    };
    const Interval w = row(rows_.w);
    const auto along = [&](const scene::Vec4d& axis, int texel) {
        const Interval n{static_cast<double>(resolution_), 0};
        return limited((n * row(axis) + Interval{base(texel), 0} * w) / (Interval{2, 0} * w));
    };
    return products({1, 0}, along(rows_.x, first_.x), along(rows_.y, first_.y));
}

std::array<Wide, 4> BilinearWeights::sharp() const
{
    if (!hit_.is_well_scaled()) {
        std::array<Wide, 4> unknown;
        unknown.fill({0, 0, std::numeric_limits<double>::infinity()});
        return unknown;
    }
    const auto plane = plane_hit(WideField{}, hit_);
    const Wide w = scaled_row(WideField{}, rows_.w, hit_.ray(), plane, offset_);
    const auto along = [&](const scene::Vec4d& axis, int texel) {
        const Wide x = scaled_row(WideField{}, axis, hit_.ray(), plane, offset_);
        return limited((WideField::number(resolution_) * x + WideField::number(base(texel)) * w) /
                       (w + w));
    };
    return products(WideField::number(1), along(rows_.x, first_.x), along(rows_.y, first_.y));
}

std::array<Fraction, 4> BilinearWeights::exact() const
{
    const auto plane = plane_hit(ExactField{}, hit_);
    const Dyadic w = scaled_row(ExactField{}, rows_.w, hit_.ray(), plane, offset_);
    const auto along = [&](const scene::Vec4d& axis, int texel) {
        const Dyadic x = scaled_row(ExactField{}, axis, hit_.ray(), plane, offset_);
        const Dyadic n{static_cast<double>(resolution_)};
        return limited(Fraction{n * x + Dyadic{base(texel)} * w, w + w});
    };
    return products(Fraction::number(1), along(rows_.x, first_.x), along(rows_.y, first_.y));
}

} // namespace gnomon::reference_rt
