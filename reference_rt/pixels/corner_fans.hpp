#pragma once

#include "scene/geometry/triangles.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::reference_rt {

/// The triangles around each position: vertices count as one where their coordinates are bit-equal.
class CornerFans {
public:
    /// @param scene  must outlive the fans.
    explicit CornerFans(const scene::TriangleScene& scene);

    /// The triangles with a corner where the triangle's corner `corner` (0…2) is; it is one of
    /// them.
    [[nodiscard]] std::span<const std::uint32_t> around(std::uint32_t triangle,
                                                        std::size_t corner) const
    {
        const std::uint32_t position = position_of_[scene_.triangles[triangle][corner]];
        return std::span{members_}.subspan(first_[position],
                                           first_[position + 1] - first_[position]);
    }

    /// The numbers of the corners' positions.
    [[nodiscard]] std::array<std::uint32_t, 3> positions_of(std::uint32_t triangle) const
    {
        const auto& [a, b, c] = scene_.triangles[triangle];
        return {position_of_[a], position_of_[b], position_of_[c]};
    }

private:
    const scene::TriangleScene& scene_;
    std::vector<std::uint32_t> position_of_; ///< [vertex]
    std::vector<std::size_t> first_;         ///< [position], into `members_`, and the end
    std::vector<std::uint32_t> members_;
};

} // namespace gnomon::reference_rt
