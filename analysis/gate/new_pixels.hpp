#pragma once

#include "analysis/causes/cause.hpp"
#include "analysis/gate/gate_entries.hpp"
#include "analysis/gate/gate_filter.hpp"
#include "scene/image.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// 1 for each wrong pixel, else 0.
using PixelMask = scene::Image<std::uint8_t>;

/// The wrong pixels of one configuration, and their properties. All images have one size, or are
/// empty if unknown.
struct WrongPixels {
    PixelMask mask;
    PixelMask is_false_lit; ///< 1 for false lit, 0 for false shadow
    scene::Image<Cause> cause;
    scene::Image<Label> label;
    scene::Image<std::uint32_t> object; ///< index into `objects`; out of range for none
    std::vector<std::string> objects;
    scene::Image<float> light_distance_m; ///< [m]; NaN for pixels that are not scored

    /// Whether every property that the filter asks about is known.
    [[nodiscard]] bool knows(const PixelFilter& filter) const;
    /// @param pixel  A wrong pixel.
    [[nodiscard]] bool is_taken(std::size_t pixel, const PixelFilter& filter) const;
};

struct PixelPlace {
    int x = 0;
    int y = 0;

    friend bool operator==(const PixelPlace&, const PixelPlace&) = default;
};

/// Pixels that became wrong.
struct NewPixels {
    std::uint64_t count = 0;
    std::vector<PixelPlace> first;      ///< at most 10, row by row from the top
    PixelPlace lower;                   ///< top left of their bounding box
    PixelPlace upper;                   ///< bottom right of it, included
    std::optional<DominantCause> cause; ///< the most frequent; empty: unknown

    static constexpr std::size_t most_named = 10;
};

/// The pixels that the filter takes and that became wrong.
/// @param before  The pixels that were wrong.
/// @param now     With `knows(filter)`.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] NewPixels find_new_pixels(const PixelMask& before, const WrongPixels& now,
                                        const PixelFilter& filter);

/// New wrong pixels, or why they are unknown.
struct NewPixelAnswer {
    std::optional<NewPixels> found;
    std::string obstacle; ///< "the run did not keep its pixels"
};

/// Finds the new wrong pixels of a configuration of both runs.
using AskNewPixels = std::function<NewPixelAnswer(const GateEntry& before, const GateEntry& now,
                                                  const PixelFilter& filter)>;

} // namespace gnomon::analysis
