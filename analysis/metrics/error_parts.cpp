#include "analysis/metrics/error_parts.hpp"

#include "analysis/causes/error_segments.hpp"
#include "analysis/pixel_runs.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace gnomon::analysis {

using scene::PixelClass;

namespace {

constexpr std::size_t label_count = label_names.size();
constexpr std::size_t kind_count = 2 * cause_names.size() * label_count;

std::size_t kind_place(bool is_false_lit, Cause cause, Label label)
{
    const std::size_t side = is_false_lit ? 1 : 0;
    return (side * cause_names.size() + static_cast<std::size_t>(cause)) * label_count +
           static_cast<std::size_t>(label);
}

KindOfError kind_at(std::size_t place)
{
    return {place >= kind_count / 2, static_cast<Cause>(place / label_count % cause_names.size()),
            static_cast<Label>(place % label_count)};
}

void require_equal_sizes(std::string_view function, scene::ImageSize a, scene::ImageSize b)
{
    if (a != b) {
        throw std::invalid_argument(fmt::format("{}: the images differ in size", function));
    }
}

/// The objects that receive each triangle, by their name's place in the sorted names.
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
            places_.push_back(static_cast<std::size_t>(
                std::lower_bound(names_.begin(), names_.end(), object.name) - names_.begin()));
        }
    }

    [[nodiscard]] std::size_t place_of(std::uint32_t triangle) const
    {
        return places_[scene_.object_of(triangle)];
    }
    [[nodiscard]] const std::string& name(std::size_t place) const { return names_[place]; }

private:
    const scene::TriangleScene& scene_;
    std::vector<std::string> names_;
    std::vector<std::size_t> places_; ///< of each object's name
};

constexpr std::uint64_t band_count = ZetaBand::highest - ZetaBand::lowest + 1;
constexpr std::uint64_t no_key = std::numeric_limits<std::uint64_t>::max();

/// Each scored pixel's object and band as one number, in the order of the parts; else `no_key`.
scene::Image<std::uint64_t> part_keys(const scene::Image<PixelClass>& classes,
                                      const scene::Image<std::uint32_t>& triangles,
                                      const scene::Image<float>& light_distance_m,
                                      const NamedObjects& objects)
{
    scene::Image<std::uint64_t> keys{classes.size(), no_key};
    for_each_run(classes.pixel_count(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i != end; ++i) {
            if (scene::is_scored(classes[i])) {
                const int band =
                    light_distance_band_of(light_distance_m[i]).place - ZetaBand::lowest;
                keys[i] =
                    objects.place_of(triangles[i]) * band_count + static_cast<std::uint64_t>(band);
            }
        }
    });
    return keys;
}

/// Where the band of that place begins [m].
double border_m(int place)
{
    if (place < 0) {
        return -border_m(-place);
    }
    if (place > ZetaBand::highest) {
        return std::numeric_limits<double>::infinity();
    }
    return place == 0 ? 0 : std::ldexp(1.0, place - 1 + ZetaBand::first_octave);
}

/// @param distance_m  At least 0.
int place_of_distance(float distance_m)
{
    constexpr int below = ZetaBand::first_octave - 1;
    return std::clamp(std::ilogb(distance_m), below, ZetaBand::last_octave) - below;
}

/// By how much the errors of a part and kind differ from one bias to the next.
struct ErrorChange {
    std::int64_t pixels = 0;
    std::int64_t units = 0; ///< of `ErrorSegments`

    friend ErrorChange operator+(ErrorChange a, ErrorChange b)
    {
        return {a.pixels + b.pixels, a.units + b.units};
    }
    friend ErrorChange operator-(ErrorChange a) { return {-a.pixels, -a.units}; }
};

/// How the errors of each part and kind change from one bias to the next. Sums of integers: the
/// same in whatever order.
class PartChanges {
public:
    PartChanges(std::size_t parts, std::size_t biases)
        : stride_{biases + 1},
          kinds_(parts * kind_count)
    {
    }

    /// Adds a pixel's segment to a part.
    void add(std::size_t part, bool is_false_lit, const ErrorSegment& segment)
    {
        const auto place = [&](Label label) {
            return part * kind_count + kind_place(is_false_lit, segment.cause, label);
        };
        add(place(segment.label), segment, {segment.is_wrong ? 1 : 0, 0});
        add(place(segment.rest_label), segment, {0, segment.rest});
        add(place(Label::acne), segment, {0, segment.acne});
    }

    void add(const PartChanges& other)
    {
        for (std::size_t i = 0; i < kinds_.size(); ++i) {
            if (!other.kinds_[i].empty()) {
                kinds_[i].resize(stride_);
                std::transform(kinds_[i].begin(), kinds_[i].end(), other.kinds_[i].begin(),
                               kinds_[i].begin(), std::plus<>{});
            }
        }
    }

    /// Adds to each bias's parts what is wrong of them.
    /// @param units  Of a whole pixel.
    void add_to(std::vector<std::vector<ErrorPart>>& rows, std::int64_t units) const
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
    std::vector<std::vector<ErrorChange>> kinds_; ///< by part and kind; empty: there are none
};

} // namespace

double ZetaBand::lower_m() const
{
    return border_m(place);
}

double ZetaBand::upper_m() const
{
    return border_m(place + 1);
}

ZetaBand light_distance_band_of(float light_distance_m)
{
    if (light_distance_m >= 0) {
        return {place_of_distance(light_distance_m)};
    }
    // The bands below 0 mirror those above, but hold their lower end as those do.
    return {-1 - place_of_distance(std::nextafter(-light_distance_m, 0.0F))};
}

PartMap find_parts(const scene::Image<PixelClass>& classes,
                   const scene::Image<std::uint32_t>& triangles,
                   const scene::Image<float>& light_distance_m, const scene::TriangleScene& scene)
{
    require_equal_sizes("find_parts", triangles.size(), classes.size());
    require_equal_sizes("find_parts", light_distance_m.size(), classes.size());
    const NamedObjects objects{scene};
    const scene::Image<std::uint64_t> keys =
        part_keys(classes, triangles, light_distance_m, objects);
    std::map<std::uint64_t, ErrorPart> found;
    ErrorPart* last = nullptr; // neighbours are mostly of one part
    std::uint64_t last_key = no_key;
    for (std::size_t i = 0; i < keys.pixel_count(); ++i) {
        if (keys[i] != no_key) {
            last = keys[i] == last_key ? last : &found[keys[i]];
            last_key = keys[i];
            ++(classes[i] == PixelClass::lit ? last->lit : last->blocked);
        }
    }
    PartMap map{scene::Image<std::uint16_t>{classes.size(), PartMap::none}, {}};
    if (found.size() > PartMap::most_parts) {
        return map;
    }
    std::vector<std::uint64_t> order;
    for (auto& [key, part] : found) {
        part.object = objects.name(key / band_count);
        part.band = {static_cast<int>(key % band_count) + ZetaBand::lowest};
        order.push_back(key);
        map.parts.push_back(std::move(part));
    }
    for_each_run(keys.pixel_count(), [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i != end; ++i) {
            if (keys[i] != no_key) {
                map.part[i] = static_cast<std::uint16_t>(
                    std::lower_bound(order.begin(), order.end(), keys[i]) - order.begin());
            }
        }
    });
    return map;
}

std::vector<std::vector<ErrorPart>> count_parts(const PartMap& map, const BiasRowInputs& inputs,
                                                std::span<const float> biases)
{
    constexpr std::size_t biases_per_pass = 1024; // every thread counts for all: bounds the memory
    require_equal_sizes("count_parts", inputs.classes.size(), map.part.size());
    std::vector<std::vector<ErrorPart>> rows;
    for (std::size_t begin = 0; begin < biases.size() && !map.parts.empty();
         begin += biases_per_pass) {
        const auto some = biases.subspan(begin, std::min(biases_per_pass, biases.size() - begin));
        const ErrorSegments segments{inputs, some};
        const PartChanges none{map.parts.size(), some.size()};
        tbb::enumerable_thread_specific<PartChanges> sums{none};
        const auto has_part = [&](std::size_t pixel) { return map.part[pixel] != PartMap::none; };
        for_each_run(map.part.pixel_count(), [&](std::size_t first, std::size_t last) {
            PartChanges& sum = sums.local();
            segments.visit(
                first, last, has_part, [&](std::size_t pixel, const ErrorSegment& segment) {
                    sum.add(map.part[pixel], inputs.classes[pixel] == PixelClass::blocked, segment);
                });
        });
        PartChanges total = none;
        for (const PartChanges& sum : sums) {
            total.add(sum);
        }
        std::vector<std::vector<ErrorPart>> counted(some.size(), map.parts);
        total.add_to(counted, segments.units());
        rows.insert(rows.end(), counted.begin(), counted.end());
    }
    rows.resize(biases.size());
    return rows;
}

} // namespace gnomon::analysis
