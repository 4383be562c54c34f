#include "reference_rt/own_sheet.hpp"

#include "reference_rt/terms.hpp"

#include <array>
#include <span>
#include <unordered_set>
#include <vector>

namespace gnomon::reference_rt {

using scene::Vec3d;

namespace {

class Walk {
public:
    struct Setting {
        const scene::TriangleScene& triangles;
        const CornerFans& fans;
        const scene::Light& light; ///< of the texel rays
    };

    Walk(const Setting& setting, const Receiver& receiver, const CameraRay& texel_ray)
        : setting_{setting},
          receiver_{receiver},
          texel_ray_{texel_ray}
    {
    }

    [[nodiscard]] bool enters(std::uint32_t goal)
    {
        visit(receiver_.triangle());
        while (!open_.empty() && !visited_.contains(goal)) {
            const std::uint32_t triangle = open_.back();
            open_.pop_back();
            const Corners corners = corners_of(setting_.triangles, triangle);
            const std::array<Sign, 3> sides{line_side(corners[0]), line_side(corners[1]),
                                            line_side(corners[2])};
            for (std::size_t i = 0; i < 3; ++i) {
                const EdgeOf edge = edge_of(corners, static_cast<int>(i));
                if (crosses(edge, sides[i] * sides[(i + 1) % 3])) {
                    visit_beyond(edge, setting_.fans.around(triangle, i));
                }
            }
        }
        return visited_.contains(goal);
    }

private:
    void visit(std::uint32_t triangle)
    {
        if (visited_.insert(triangle).second) {
            open_.push_back(triangle);
        }
    }

    /// Visits the triangles on the other side of an edge, out of those around one of its ends.
    void visit_beyond(const EdgeOf& edge, std::span<const std::uint32_t> fan)
    {
        for (const std::uint32_t other : fan) {
            const Corners corners = corners_of(setting_.triangles, other);
            for (int i = 0; i < 3; ++i) {
                if (forms_seam(edge, edge_of(corners, i), setting_.light, counts_)) {
                    visit(other);
                }
            }
        }
    }

    /// True when the segment pc leaves the triangle by this edge, or meets the edge along the line
    /// or in an end. Precondition: the triangle meets the segment.
    /// @param ends  product of the sides of its ends from the line pc.
    [[nodiscard]] bool crosses(const EdgeOf& edge, Sign ends)
    {
        if (ends > 0) {
            return false;
        }
        const Sign p = point_side(receiver_, edge.u, edge.v, setting_.light, counts_);
        const Sign c = passing_side(texel_ray_, edge.u, edge.v, counts_);
        if (ends == 0) {
            return p * c <= 0; // an end on the line lies between p and c, or all is one point
        }
        const Sign inside = apex_side(setting_.light, edge.u, edge.v, edge.apex, counts_);
        return p * inside >= 0 && c * inside <= 0;
    }

    /// Side of a corner from the line pc: from the plane of the texel's ray and P.
    [[nodiscard]] Sign line_side(const Vec3d& corner)
    {
        const scene::Ray& texel = texel_ray_.ray;
        const bool is_tame = receiver_.is_tame() && texel_ray_.is_tame;
        return receiver_.delta_sign * sign_of(counts_, is_tame, [&]<typename Field>(Field field) {
                   const scene::Ray& camera = receiver_.ray();
                   const auto [delta, nu] = plane_hit(field, receiver_);
                   const auto offset = delta * difference<Field>(camera.origin, texel.origin) +
                                       nu * vector<Field>(camera.direction);
                   return dot(cross(vector<Field>(texel.direction), offset),
                              difference<Field>(corner, texel.origin));
               });
    }

    Setting setting_;
    const Receiver& receiver_;
    const CameraRay& texel_ray_;
    SignCounts counts_;
    std::unordered_set<std::uint32_t> visited_;
    std::vector<std::uint32_t> open_;
};

} // namespace

bool OwnSheet::leads(const Receiver& receiver, scene::Texel texel, std::uint32_t triangle) const
{
    if (receiver.triangle() == triangle) {
        return true;
    }
    const CameraRay ray{rays_.ray(texel)};
    return Walk{{triangles_, fans_, rays_.light()}, receiver, ray}.enters(triangle);
}

} // namespace gnomon::reference_rt
