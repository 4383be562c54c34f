#include "analysis/metrics/map_rows.hpp"

#include "analysis/limits/error_segments.hpp"
#include "analysis/metrics/error_buckets.hpp"

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace gnomon::analysis {

namespace {

/// A cell for each map, with its pixels and without errors.
CellMap cells_by_map(const scene::Image<scene::PixelClass>& classes, const scene::MapIndices& maps,
                     std::size_t map_count)
{
    if (maps.size() != classes.size()) {
        throw std::invalid_argument("count_map_errors: the images differ in size");
    }
    CellMap map{scene::Image<std::uint16_t>{classes.size(), CellMap::none},
                std::vector<ErrorBucket>(map_count)};
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        if (scene::is_scored(classes[i])) {
            map.cell[i] = maps[i];
            ErrorBucket& cell = map.cells.at(maps[i]);
            ++(scene::is_lit(classes[i]) ? cell.lit : cell.blocked);
        }
    }
    return map;
}

/// @param units  of a whole pixel: amounts are added up as integers, as in `errors_by_map`.
MapErrors errors_of(const ErrorBucket& cell, std::int64_t units)
{
    MapErrors errors{{cell.lit, cell.blocked}, {}};
    const auto whole = static_cast<double>(units);
    std::int64_t shadow = 0;
    std::int64_t light = 0;
    for (const KindOfError& kind : cell.errors) {
        (kind.is_false_lit ? errors.counts.false_lit : errors.counts.false_shadow) += kind.pixels;
        (kind.is_false_lit ? light : shadow) += std::llrint(kind.amount * whole);
        errors.causes.by_cause[static_cast<std::size_t>(kind.cause)] += kind.pixels;
        errors.causes.by_label[static_cast<std::size_t>(kind.label)] += kind.pixels;
    }
    errors.counts.shadow_amount = static_cast<double>(shadow) / whole;
    errors.counts.light_amount = static_cast<double>(light) / whole;
    return errors;
}

} // namespace

std::vector<std::vector<MapErrors>> count_map_errors(const scene::MapIndices& maps,
                                                     std::size_t map_count,
                                                     const BiasRowInputs& inputs,
                                                     std::span<const float> biases)
{
    std::vector<std::vector<MapErrors>> rows(biases.size());
    if (map_count < 2) {
        return rows;
    }
    const std::int64_t units = ErrorSegments::units_of(inputs.rule.traits);
    const auto cells =
        count_error_buckets(cells_by_map(inputs.classes, maps, map_count), inputs, biases);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (const ErrorBucket& cell : cells[i]) {
            rows[i].push_back(errors_of(cell, units));
        }
    }
    return rows;
}

} // namespace gnomon::analysis
