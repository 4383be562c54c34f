#include "reference_rt/pixels/classify.hpp"
#include "reference_rt/pixels/tiles.hpp"
#include "reference_rt/truth.hpp"

#include <tbb/combinable.h>

#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace gnomon::reference_rt {

using scene::FloatMethodErrors;
using scene::Image;
using scene::PixelClass;

namespace {

constexpr std::array<std::pair<PlainOffset, std::string_view>, 4> methods{
    {{PlainOffset::none, "no_offset"},
     {PlainOffset::ray_start, "ray_start_1e-4"},
     {PlainOffset::own_triangle, "id_exclusion"},
     {PlainOffset::integer, "integer_offset"}}};

using Wrong = std::array<FloatMethodErrors, methods.size()>;

/// The scored and the blocked pixels of a tile.
struct Scored {
    PacketMask lanes;
    PacketMask blocked;
};

Scored scored_of(const Tile& tile, const scene::Truth& truth)
{
    Scored scored;
    for (std::size_t i = 0; i < packet_size; ++i) {
        if ((tile.seen >> i & 1U) == 0) {
            continue;
        }
        const PixelClass pixel_class = truth.pixel_class(tile.x(i), tile.y(i));
        if (scene::is_scored(pixel_class)) {
            scored.lanes.add(i);
        }
        if (scene::is_blocked(pixel_class)) {
            scored.blocked.add(i);
        }
    }
    return scored;
}

void count_wrong(const Scored& scored, const PacketMask& found, FloatMethodErrors& errors)
{
    for (std::size_t i = 0; i < packet_size; ++i) {
        if (scored.lanes[i]) {
            errors.false_blocked += found[i] && !scored.blocked[i] ? 1U : 0U;
            errors.false_lit += !found[i] && scored.blocked[i] ? 1U : 0U;
        }
    }
}

} // namespace

std::vector<FloatMethodErrors> audit_float_methods(const ReferenceScene& reference,
                                                   const scene::View& view,
                                                   const Image<std::uint32_t>& receivers,
                                                   const scene::Truth& truth, int threads)
{
    const auto& implementation = reference.implementation();
    if (!implementation.native || receivers.size() != view.image ||
        truth.pixel_class.size() != view.image) {
        throw std::invalid_argument{"audit_float_methods: the reference must serve plain rays, and "
                                    "receivers and truth be of the image's size"};
    }
    tbb::combinable<Wrong> wrong;
    const TileSource source{implementation.triangles, view, receivers};
    tbb::combinable<Tile> tiles;
    for_each_tile(view.image, threads, [&](int column, int row) {
        SignCounts ignored; // float methods prove no signs
        Tile& tile = tiles.local();
        source.fill(tile, column, row, ignored);
        const Scored scored = scored_of(tile, truth);
        if (!scored.lanes.any()) {
            return;
        }
        for (std::size_t m = 0; m < methods.size(); ++m) {
            count_wrong(scored,
                        trace_plain(implementation, view.light, methods[m].first, scored.lanes,
                                    tile.receivers()),
                        wrong.local()[m]);
        }
    });
    implementation.errors.check("audit_float_methods");
    std::vector<FloatMethodErrors> total;
    for (const auto& [offset, name] : methods) {
        total.push_back({std::string{name}, 0, 0});
    }
    wrong.combine_each([&](const Wrong& part) {
        for (std::size_t m = 0; m < methods.size(); ++m) {
            total[m].false_blocked += part[m].false_blocked;
            total[m].false_lit += part[m].false_lit;
        }
    });
    return total;
}

} // namespace gnomon::reference_rt
