#pragma once

#include "exact_oracle.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

/// Self-shadowing surfaces by plane geometry in rationals: every triangle is projected along the
/// texel rays, the segment from P to the texel's centre clipped against all of them, and what it
/// passes connected.
namespace gnomon::reference_rt::test {

struct RationalPoint2 {
    Rational x, y;

    friend bool operator==(const RationalPoint2&, const RationalPoint2&) = default;
};
inline RationalPoint2 between(const RationalPoint2& a, const RationalPoint2& b, const Rational& t)
{
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}
/// Twice the signed area of a triangle.
inline Rational area_of(const RationalPoint2& a, const RationalPoint2& b, const RationalPoint2& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The projection along a ray's direction, or from its origin.
class LightView {
public:
    LightView(const scene::Ray& ray, bool has_positional)
        : origin_{ray.origin},
          forward_{ray.direction},
          right_{cross(forward_, RationalVec{Rational{1}, Rational{2}, Rational{5}})},
          up_{cross(right_, forward_)},
          has_positional_{has_positional}
    {
    }
    [[nodiscard]] RationalPoint2 project(const RationalVec& point) const
    {
        const RationalVec offset = point - origin_;
        const Rational divisor = has_positional_ ? dot(forward_, offset) : Rational{1};
        return {dot(right_, offset) / divisor, dot(up_, offset) / divisor};
    }
    [[nodiscard]] bool is_in_front(const RationalVec& point) const
    {
        return !has_positional_ || dot(forward_, point - origin_) > 0;
    }

private:
    RationalVec origin_, forward_, right_, up_;
    bool has_positional_;
};

/// The part [first, last] of the segment p→c within a closed triangle.
struct Part {
    Rational first = 0;
    Rational last = 1;
};
inline std::optional<Part> clip(const RationalPoint2& p, const RationalPoint2& c,
                                const std::array<RationalPoint2, 3>& corners)
{
    const Rational area = area_of(corners[0], corners[1], corners[2]);
    if (area == 0) {
        return std::nullopt;
    }
    Part part;
    for (std::size_t i = 0; i < 3; ++i) {
        const Rational at_p = area * area_of(corners[i], corners[(i + 1) % 3], p);
        const Rational at_c = area * area_of(corners[i], corners[(i + 1) % 3], c);
        if (at_p < 0 && at_c < 0) {
            return std::nullopt;
        }
        if (at_p < 0) {
            part.first = std::max(part.first, Rational{at_p / (at_p - at_c)});
        } else if (at_c < 0) {
            part.last = std::min(part.last, Rational{at_p / (at_p - at_c)});
        }
    }
    return part.first <= part.last ? std::optional{part} : std::nullopt;
}

class SheetOracle {
public:
    SheetOracle(const scene::TriangleScene& scene, const LightView& view, const RationalVec& point,
                const RationalPoint2& centre)
        : scene_{scene},
          p_{view.project(point)},
          c_{centre}
    {
        for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
            std::array<RationalPoint2, 3> corners;
            for (std::size_t i = 0; i < 3; ++i) {
                corners[i] = view.project(RationalVec{scene::Vec3d{scene.corners(t)[i]}});
            }
            corners_.push_back(corners);
            parts_.push_back(clip(p_, c_, corners));
        }
    }

    [[nodiscard]] bool leads(std::uint32_t from, std::uint32_t to) const
    {
        std::vector<std::uint32_t> reached{from};
        for (std::size_t i = 0; i < reached.size(); ++i) {
            for (std::uint32_t next = 0; next < corners_.size(); ++next) {
                if (std::ranges::find(reached, next) == reached.end() && joins(reached[i], next)) {
                    reached.push_back(next);
                }
            }
        }
        return std::ranges::find(reached, to) != reached.end();
    }

private:
    /// True when the segment goes on from a to b over an edge that they share.
    [[nodiscard]] bool joins(std::uint32_t a, std::uint32_t b) const
    {
        if (!parts_[a] || !parts_[b]) {
            return false;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (joins_over(a, i, b, k)) {
                    return true;
                }
            }
        }
        return false;
    }

    [[nodiscard]] bool joins_over(std::uint32_t a, std::size_t i, std::uint32_t b,
                                  std::size_t k) const
    {
        const auto ends_a = scene_.corners(a);
        const auto ends_b = scene_.corners(b);
        const auto& u = ends_a[i];
        const auto& v = ends_a[(i + 1) % 3];
        const bool is_shared = (u == ends_b[k] && v == ends_b[(k + 1) % 3]) ||
                               (v == ends_b[k] && u == ends_b[(k + 1) % 3]);
        const RationalPoint2& from = corners_[a][i];
        const RationalPoint2& to = corners_[a][(i + 1) % 3];
        if (!is_shared || area_of(from, to, corners_[a][(i + 2) % 3]) *
                                  area_of(from, to, corners_[b][(k + 2) % 3]) >=
                              0) {
            return false;
        }
        // Through an end of the edge, or along it, any way counts; else it must be the way on.
        for (const RationalPoint2& end : {from, to}) {
            if (is_on_segment(end)) {
                return true;
            }
        }
        const RationalPoint2 out = between(p_, c_, parts_[a]->last);
        return area_of(from, to, out) == 0 && parts_[a]->last == parts_[b]->first &&
               (parts_[a]->last < parts_[b]->last || parts_[a]->last == 1 || parts_[a]->last == 0);
    }

    [[nodiscard]] bool is_on_segment(const RationalPoint2& x) const
    {
        const Rational along = (x.x - p_.x) * (c_.x - p_.x) + (x.y - p_.y) * (c_.y - p_.y);
        const Rational length2 = (c_.x - p_.x) * (c_.x - p_.x) + (c_.y - p_.y) * (c_.y - p_.y);
        return area_of(p_, c_, x) == 0 && along >= 0 && along <= length2;
    }

    const scene::TriangleScene& scene_;
    RationalPoint2 p_, c_;
    std::vector<std::array<RationalPoint2, 3>> corners_;
    std::vector<std::optional<Part>> parts_;
};

} // namespace gnomon::reference_rt::test
