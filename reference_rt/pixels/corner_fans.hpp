#pragma once

#include "scene/geometry/triangles.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::reference_rt {

/// The triangles around each vertex position. Vertices with bit-equal coordinates share a position.
class CornerFans {
public:
    /// @param scene  must outlive this object.
    explicit CornerFans(const scene::TriangleScene& scene);

    /// The triangles around corner `corner` (0…2) of a triangle, including itself.
    [[nodiscard]] std::span<const std::uint32_t> around(std::uint32_t triangle,
                                                        std::size_t corner) const
    {
        const std::uint32_t position = position_of_[scene_.triangles[triangle][corner]];
        return std::span{members_}.subspan(first_[position],
                                           first_[position + 1] - first_[position]);
    }

    /// The position numbers of a triangle's corners.
    [[nodiscard]] std::array<std::uint32_t, 3> positions_of(std::uint32_t triangle) const
    {
        const auto& [a, b, c] = scene_.triangles[triangle];
        return {position_of_[a], position_of_[b], position_of_[c]};
    }

private:
    const scene::TriangleScene& scene_;
    std::vector<std::uint32_t> position_of_; ///< [vertex]
    std::vector<std::size_t> first_; ///< [position]: start in `members_`; last entry is the end
    std::vector<std::uint32_t> members_;
};

} // namespace gnomon::reference_rt
