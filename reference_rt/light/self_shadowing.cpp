#include "reference_rt/light/self_shadowing.hpp"

#include "reference_rt/exact/terms.hpp"

#include <boost/container/small_vector.hpp>

#include <array>
#include <type_traits>
#include <utility>

namespace gnomon::reference_rt {

using scene::Vec3d;

namespace {

/// A set of triangles; small sets need no allocation.
class TriangleSet {
public:
    TriangleSet() : slots_(first_slots, scene::no_triangle) {}

    [[nodiscard]] bool contains(std::uint32_t triangle) const
    {
        return slots_[slot_of(triangle)] == triangle;
    }
    /// Returns whether the triangle is new.
    bool insert(std::uint32_t triangle)
    {
        std::uint32_t& slot = slots_[slot_of(triangle)];
        if (slot == triangle) {
            return false;
        }
        slot = triangle;
        if (2 * ++count_ > slots_.size()) {
            grow();
        }
        return true;
    }

private:
    static constexpr std::size_t first_slots = 32; ///< must be a power of two
    using Slots = boost::container::small_vector<std::uint32_t, first_slots>;

    /// The slot of the triangle, or where to insert it.
    [[nodiscard]] std::size_t slot_of(std::uint32_t triangle) const
    {
        std::size_t slot = std::size_t{triangle} * 0x9E3779B97F4A7C15U >> 32U;
        for (slot %= slots_.size(); slots_[slot] != scene::no_triangle && slots_[slot] != triangle;
             slot = (slot + 1) % slots_.size()) {
        }
        return slot;
    }
    void grow()
    {
        const Slots old = std::exchange(slots_, Slots(2 * slots_.size(), scene::no_triangle));
        for (const std::uint32_t triangle : old) {
            if (triangle != scene::no_triangle) {
                slots_[slot_of(triangle)] = triangle;
            }
        }
    }

    Slots slots_;
    std::size_t count_ = 0;
};

/// δ times the normal of the plane through a texel's ray and P.
template <typename Field>
auto line_normal(const Receiver& receiver, const scene::Ray& texel)
{
    const scene::Ray& camera = receiver.ray();
    const auto [delta, nu] = plane_hit(Field{}, receiver);
    const auto offset = delta * difference<Field>(camera.origin, texel.origin) +
                        nu * vector<Field>(camera.direction);
    return cross(vector<Field>(texel.direction), offset);
}

class Walk {
public:
    struct Setting {
        const scene::TriangleScene& triangles;
        const CornerFans& fans;
        const scene::Light& light; ///< the light of the texel rays
    };

    Walk(const Setting& setting, const Receiver& receiver, const CameraRay& texel_ray)
        : setting_{setting},
          receiver_{receiver},
          texel_ray_{texel_ray},
          line_normal_{line_normal<FilterField>(receiver, texel_ray.ray)}
    {
    }

    [[nodiscard]] bool enters(std::uint32_t goal)
    {
        if (begins_with(goal)) {
            return true;
        }
        visit(receiver_.triangle());
        while (!open_.empty() && !visited_.contains(goal)) {
            const std::uint32_t triangle = open_.back();
            open_.pop_back();
            const Corners corners = corners_of(setting_.triangles, triangle);
            const std::array<Sign, 3> sides{line_side(corners[0]), line_side(corners[1]),
                                            line_side(corners[2])};
            for (std::size_t i = 0; i < 3; ++i) {
                if (crosses(edge_of(corners, static_cast<int>(i)), sides[i] * sides[(i + 1) % 3])) {
                    visit_beyond(triangle, i, corners);
                }
            }
        }
        return visited_.contains(goal);
    }

private:
    /// Whether the walk's first step enters the triangle: a common and cheap case.
    [[nodiscard]] bool begins_with(std::uint32_t goal)
    {
        const Corners& corners = receiver_.corners();
        const auto positions = setting_.fans.positions_of(receiver_.triangle());
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t next = (i + 1) % 3;
            if (has_corner(goal, positions[i]) && has_corner(goal, positions[next])) {
                const EdgeOf edge = edge_of(corners, static_cast<int>(i));
                if (is_beyond(edge, goal) &&
                    crosses(edge, line_side(corners[i]) * line_side(corners[next]))) {
                    return true;
                }
            }
        }
        return false;
    }

    void visit(std::uint32_t triangle)
    {
        if (visited_.insert(triangle)) {
            open_.push_back(triangle);
        }
    }

    /// Visits the triangles on the other side of an edge.
    void visit_beyond(std::uint32_t triangle, std::size_t edge, const Corners& corners)
    {
        const CornerFans& fans = setting_.fans;
        const std::uint32_t far_end = fans.positions_of(triangle)[(edge + 1) % 3];
        for (const std::uint32_t other : fans.around(triangle, edge)) {
            if (other != triangle && has_corner(other, far_end) &&
                is_beyond(edge_of(corners, static_cast<int>(edge)), other)) {
                visit(other);
            }
        }
    }

    [[nodiscard]] bool has_corner(std::uint32_t triangle, std::uint32_t position) const
    {
        const auto [a, b, c] = setting_.fans.positions_of(triangle);
        return a == position || b == position || c == position;
    }

    /// Whether the triangle shares the edge from its other side.
    [[nodiscard]] bool is_beyond(const EdgeOf& edge, std::uint32_t triangle)
    {
        const Corners corners = corners_of(setting_.triangles, triangle);
        for (int i = 0; i < 3; ++i) {
            if (forms_seam(edge, edge_of(corners, i), setting_.light, counts_)) {
                return true;
            }
        }
        return false;
    }

    /// Whether the segment pc leaves the triangle through this edge, runs along it or meets an end.
    /// Precondition: the triangle meets the segment.
    /// @param ends  product of the sides of its ends of the line pc.
    [[nodiscard]] bool crosses(const EdgeOf& edge, Sign ends)
    {
        if (ends > 0) {
            return false;
        }
        const Sign p = point_side(receiver_, edge.u, edge.v, setting_.light, counts_);
        const Sign c = passing_side(texel_ray_, edge.u, edge.v, counts_);
        if (ends == 0) {
            return p * c <= 0; // an end on the line lies between p and c, or all coincide
        }
        const Sign inside = apex_side(setting_.light, edge.u, edge.v, edge.apex, counts_);
        return p * inside >= 0 && c * inside <= 0;
    }

    /// The side of a corner of the line pc, that is of the plane through the texel's ray and P.
    [[nodiscard]] Sign line_side(const Vec3d& corner)
    {
        const scene::Ray& texel = texel_ray_.ray;
        const bool is_well_scaled = receiver_.is_well_scaled() && texel_ray_.is_well_scaled;
        return receiver_.delta_sign * sign_of(counts_, is_well_scaled, [&]<typename Field>(Field) {
                   const auto offset = difference<Field>(corner, texel.origin);
                   if constexpr (std::is_same_v<Field, FilterField>) {
                       return dot(line_normal_, offset);
                   } else {
                       return dot(line_normal<Field>(receiver_, texel), offset);
                   }
               });
    }

    Setting setting_;
    const Receiver& receiver_;
    const CameraRay& texel_ray_;
    decltype(line_normal<FilterField>({}, {})) line_normal_;
    SignCounts counts_;
    TriangleSet visited_;
    boost::container::small_vector<std::uint32_t, 32> open_;
};

} // namespace

bool SelfShadowingSurface::leads(const Receiver& receiver, scene::Texel texel,
                                 std::uint32_t triangle) const
{
    if (receiver.triangle() == triangle) {
        return true;
    }
    const CameraRay ray{rays_.ray(texel)};
    return Walk{{triangles_, fans_, rays_.light()}, receiver, ray}.enters(triangle);
}

} // namespace gnomon::reference_rt
