#include "analysis/evaluate/likely_mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace gnomon::analysis {

namespace {

using Axis = scene::CaseSpace::Axis;

/// Lower is likelier: exporters turn y up into z up, or forget to mirror an axis.
int rank(const MixedAxes& axes)
{
    constexpr MixedAxes none{{{0, 1}, {1, 1}, {2, 1}}};
    constexpr MixedAxes z_up{{{0, 1}, {2, -1}, {1, 1}}};
    constexpr MixedAxes from_z_up{{{0, 1}, {2, 1}, {1, -1}}};
    constexpr MixedAxes swapped{{{0, 1}, {2, 1}, {1, 1}}};
    if (axes == none) {
        return 0;
    }
    if (axes == z_up || axes == from_z_up) {
        return 1;
    }
    const bool keeps_places = axes[0].of_mesh == 0 && axes[1].of_mesh == 1 && axes[2].of_mesh == 2;
    const auto negatives = std::ranges::count(axes, -1.0, &Axis::sign);
    if (keeps_places && negatives == 1) {
        return 2;
    }
    if (axes == swapped) {
        return 3;
    }
    return keeps_places ? 4 : 5 + static_cast<int>(negatives);
}

std::vector<MixedAxes> ranked_axes()
{
    std::vector<MixedAxes> all;
    std::array<int, 3> places{0, 1, 2};
    do {
        for (unsigned signs = 0; signs < 8; ++signs) {
            MixedAxes axes;
            for (unsigned i = 0; i < 3; ++i) {
                axes[i] = {places[i], (signs >> i & 1U) != 0 ? -1.0 : 1.0};
            }
            all.push_back(axes);
        }
    } while (std::ranges::next_permutation(places).found);
    std::ranges::stable_sort(all, {}, rank);
    return all;
}

} // namespace

scene::Vec3d mixed(const MixedAxes& axes, const scene::Vec3d& v)
{
    scene::CaseSpace space;
    space.axes = axes;
    return space.from_mesh(v);
}

bool mirrors(const MixedAxes& axes)
{
    scene::CaseSpace space;
    space.axes = axes;
    return space.is_mirrored();
}

MixedAxes mixed_twice(const MixedAxes& first, const MixedAxes& second)
{
    MixedAxes result;
    for (std::size_t i = 0; i < result.size(); ++i) {
        const Axis& inner = first[static_cast<std::size_t>(second[i].of_mesh)];
        result[i] = {inner.of_mesh, second[i].sign * inner.sign};
    }
    return result;
}

std::string axes_text(const MixedAxes& axes)
{
    const auto word = [](const Axis& axis) {
        return fmt::format(
            "\"{}{}\"", axis.sign < 0 ? "-" : "",
            std::string_view{"xyz"}.substr(static_cast<std::size_t>(axis.of_mesh), 1));
    };
    return fmt::format("[{}, {}, {}]", word(axes[0]), word(axes[1]), word(axes[2]));
}

const std::vector<MixedAxes>& all_axes()
{
    static const std::vector<MixedAxes> all = ranked_axes();
    return all;
}

const std::vector<UnitMistake>& unit_mistakes()
{
    static const std::vector<UnitMistake> all{
        {1, ""},
        {0.001, "P is in metres where the mesh is in millimetres, or in kilometres where it is in "
                "metres"},
        {0.01, "P is in metres where the mesh is in centimetres"},
        {0.0254, "P is in metres where the mesh is in inches"},
        {0.3048, "P is in metres where the mesh is in feet"},
        {1 / 0.3048, "P is in feet where the mesh is in metres"},
        {1 / 0.0254, "P is in inches where the mesh is in metres"},
        {100, "P is in centimetres where the mesh is in metres"},
        {1000, "P is in millimetres where the mesh is in metres, or in metres where it is in "
               "kilometres"},
    };
    return all;
}

std::vector<ViewSpace> view_spaces(const scene::Camera& camera)
{
    std::vector<ViewSpace> spaces;
    for (const double z : {-1.0, 1.0}) {
        for (const double y : {1.0, -1.0}) {
            spaces.push_back({camera.right, y * camera.up, z * camera.forward});
        }
    }
    return spaces;
}

} // namespace gnomon::analysis
