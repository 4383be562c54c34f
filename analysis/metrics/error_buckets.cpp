#include "analysis/metrics/error_buckets.hpp"

#include "analysis/limits/error_segments.hpp"
#include "analysis/pixels/checks.hpp"
#include "analysis/pixels/pixel_runs.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <utility>

namespace gnomon::analysis {

using scene::PixelClass;

namespace {

constexpr std::size_t label_count = label_names.size();
constexpr std::size_t kind_count = 2 * cause_names.size() * label_count;

std::size_t kind_index(bool is_false_lit, Cause cause, Label label)
{
    const std::size_t side = is_false_lit ? 1 : 0;
    return (side * cause_names.size() + static_cast<std::size_t>(cause)) * label_count +
           static_cast<std::size_t>(label);
}

KindOfError kind_at(std::size_t index)
{
    return {index >= kind_count / 2, static_cast<Cause>(index / label_count % cause_names.size()),
            static_cast<Label>(index % label_count)};
}

/// The object of each triangle, as an index into the sorted names.
class NamedObjects {
public:
    explicit NamedObjects(const scene::TriangleScene& scene) : scene_{scene}
    {
        for (const scene::Object& object : scene.objects) {
            names_.push_back(object.name);
        }
        std::sort(names_.begin(), names_.end());
        names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
        for (const scene::Object& object : scene.objects) {
            indices_.push_back(static_cast<std::size_t>(
                std::lower_bound(names_.begin(), names_.end(), object.name) - names_.begin()));
        }
    }

    [[nodiscard]] std::size_t index_of(std::uint32_t triangle) const
    {
        return indices_[scene_.object_of(triangle)];
    }
    [[nodiscard]] const std::string& name(std::size_t index) const { return names_[index]; }

private:
    const scene::TriangleScene& scene_;
    std::vector<std::string> names_;
    std::vector<std::size_t> indices_; ///< index of each object's name
};

constexpr std::uint64_t band_count = LightDistanceBand::highest - LightDistanceBand::lowest + 1;
constexpr std::uint64_t no_key = std::numeric_limits<std::uint64_t>::max();

/// Each scored pixel's object and band as one number, in the order of the cells; else `no_key`.
scene::Image<std::uint64_t> cell_keys(const scene::Image<PixelClass>& classes,
                                      const scene::Image<std::uint32_t>& triangles,
                                      const scene::Image<float>& light_distance_m,
                                      const NamedObjects& objects)
{
    scene::Image<std::uint64_t> keys{classes.size(), no_key};
    for_each_run(classes.pixel_count(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i != end; ++i) {
            if (scene::is_scored(classes[i])) {
                const int band =
                    light_distance_band_of(light_distance_m[i]).index - LightDistanceBand::lowest;
                keys[i] =
                    objects.index_of(triangles[i]) * band_count + static_cast<std::uint64_t>(band);
            }
        }
    });
    return keys;
}

/// Lower border of the band with this index [m].
double border_m(int index)
{
    if (index < 0) {
        return -border_m(-index);
    }
    if (index > LightDistanceBand::highest) {
        return std::numeric_limits<double>::infinity();
    }
    return index == 0 ? 0 : std::ldexp(1.0, index - 1 + LightDistanceBand::first_octave);
}

/// @param distance_m  At least 0.
int index_of_distance(float distance_m)
{
    constexpr int below = LightDistanceBand::first_octave - 1;
    return std::clamp(std::ilogb(distance_m), below, LightDistanceBand::last_octave) - below;
}

/// Difference of a cell's errors of one kind between neighbouring biases.
struct ErrorChange {
    std::int64_t pixels = 0;
    std::int64_t units = 0; ///< as in `ErrorSegments`

    friend ErrorChange operator+(ErrorChange a, ErrorChange b)
    {
        return {a.pixels + b.pixels, a.units + b.units};
    }
    friend ErrorChange operator-(ErrorChange a) { return {-a.pixels, -a.units}; }
};

/// Differences of each cell's errors, by kind, between neighbouring biases. Sums of integers, so
/// their order does not matter.
class CellChanges {
public:
    CellChanges(std::size_t cells, std::size_t biases)
        : stride_{biases + 1},
          kinds_(cells * kind_count)
    {
    }

    /// Adds a pixel's segment to a cell.
    void add(std::size_t cell, bool is_false_lit, const ErrorSegment& segment)
    {
        const auto index_of = [&](Label label) {
            return cell * kind_count + kind_index(is_false_lit, segment.cause, label);
        };
        add(index_of(segment.label), segment, {segment.is_wrong ? 1 : 0, 0});
        add(index_of(segment.rest_label), segment, {0, segment.rest});
        add(index_of(Label::acne), segment, {0, segment.acne});
    }

    void add(const CellChanges& other)
    {
        for (std::size_t i = 0; i < kinds_.size(); ++i) {
            if (!other.kinds_[i].empty()) {
                kinds_[i].resize(stride_);
                std::transform(kinds_[i].begin(), kinds_[i].end(), other.kinds_[i].begin(),
                               kinds_[i].begin(), std::plus<>{});
            }
        }
    }

    /// Adds the errors to the cells at each bias.
    /// @param units  Of a whole pixel.
    void add_to(std::vector<std::vector<ErrorBucket>>& rows, std::int64_t units) const
    {
        for (std::size_t i = 0; i < kinds_.size(); ++i) {
            ErrorChange sum;
            for (std::size_t bias = 0; bias < rows.size() && !kinds_[i].empty(); ++bias) {
                sum = sum + kinds_[i][bias];
                if (sum.pixels > 0 || sum.units > 0) {
                    KindOfError kind = kind_at(i % kind_count);
                    kind.pixels = static_cast<std::uint64_t>(sum.pixels);
                    kind.amount = static_cast<double>(sum.units) / static_cast<double>(units);
                    rows[bias][i / kind_count].errors.push_back(kind);
                }
            }
        }
    }

private:
    void add(std::size_t kind, const ErrorSegment& segment, ErrorChange change)
    {
        if (change.pixels != 0 || change.units != 0) {
            auto& changes = kinds_[kind];
            changes.resize(stride_);
            changes[segment.first] = changes[segment.first] + change;
            changes[segment.last] = changes[segment.last] + -change;
        }
    }

    std::size_t stride_;
    std::vector<std::vector<ErrorChange>> kinds_; ///< by cell and kind; empty if there are none
};

} // namespace

double LightDistanceBand::lower_m() const
{
    return border_m(index);
}

double LightDistanceBand::upper_m() const
{
    return border_m(index + 1);
}

LightDistanceBand light_distance_band_of(float light_distance_m)
{
    if (light_distance_m >= 0) {
        return {index_of_distance(light_distance_m)};
    }
    // The bands below 0 mirror those above, except that they too include their lower end.
    return {-1 - index_of_distance(std::nextafter(-light_distance_m, 0.0F))};
}

CellMap find_error_buckets(const scene::Image<PixelClass>& classes,
                           const scene::Image<std::uint32_t>& triangles,
                           const scene::Image<float>& light_distance_m,
                           const scene::TriangleScene& scene)
{
    require_equal_sizes("find_error_buckets", classes.size(),
                        {triangles.size(), light_distance_m.size()});
    const NamedObjects objects{scene};
    const scene::Image<std::uint64_t> keys =
        cell_keys(classes, triangles, light_distance_m, objects);
    std::map<std::uint64_t, ErrorBucket> found;
    ErrorBucket* last = nullptr; // most neighbours share a cell
    std::uint64_t last_key = no_key;
    for (std::size_t i = 0; i < keys.pixel_count(); ++i) {
        if (keys[i] != no_key) {
            last = keys[i] == last_key ? last : &found[keys[i]];
            last_key = keys[i];
            ++(scene::is_lit(classes[i]) ? last->lit : last->blocked);
        }
    }
    CellMap map{scene::Image<std::uint16_t>{classes.size(), CellMap::none}, {}};
    if (found.size() > CellMap::most_cells) {
        return map;
    }
    std::vector<std::uint64_t> order;
    for (auto& [key, cell] : found) {
        cell.object = objects.name(key / band_count);
        cell.band = {static_cast<int>(key % band_count) + LightDistanceBand::lowest};
        order.push_back(key);
        map.cells.push_back(std::move(cell));
    }
    for_each_run(keys.pixel_count(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i != end; ++i) {
            if (keys[i] != no_key) {
                map.cell[i] = static_cast<std::uint16_t>(
                    std::lower_bound(order.begin(), order.end(), keys[i]) - order.begin());
            }
        }
    });
    return map;
}

std::vector<std::vector<ErrorBucket>>
count_error_buckets(const CellMap& map, const BiasRowInputs& inputs, std::span<const float> biases)
{
    // Bounds the memory, since every thread has counters for all.
    constexpr std::size_t biases_per_pass = 1024;
    require_equal_sizes("count_error_buckets", map.cell.size(), {inputs.classes.size()});
    std::vector<std::vector<ErrorBucket>> rows;
    for (std::size_t begin = 0; begin < biases.size() && !map.cells.empty();
         begin += biases_per_pass) {
        const auto some = biases.subspan(begin, std::min(biases_per_pass, biases.size() - begin));
        const ErrorSegments segments{inputs, some};
        const CellChanges none{map.cells.size(), some.size()};
        tbb::enumerable_thread_specific<CellChanges> sums{none};
        const auto has_cell = [&](std::size_t pixel) { return map.cell[pixel] != CellMap::none; };
        for_each_run(map.cell.pixel_count(), [&](std::size_t first, std::size_t last) {
            CellChanges& sum = sums.local();
            segments.visit(
                first, last, has_cell, [&](std::size_t pixel, const ErrorSegment& segment) {
                    sum.add(map.cell[pixel], scene::is_blocked(inputs.classes[pixel]), segment);
                });
        });
        CellChanges total = none;
        for (const CellChanges& sum : sums) {
            total.add(sum);
        }
        std::vector<std::vector<ErrorBucket>> counted(some.size(), map.cells);
        total.add_to(counted, segments.units());
        rows.insert(rows.end(), counted.begin(), counted.end());
    }
    rows.resize(biases.size());
    return rows;
}

} // namespace gnomon::analysis
