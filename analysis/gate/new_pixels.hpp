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

/// Which pixels are wrong: 1, else 0.
using PixelMask = scene::Image<std::uint8_t>;

/// The wrong pixels of one configuration, and what is known of them. Images are of one size, or
/// empty where that is not known.
struct WrongPixels {
    PixelMask mask;
    PixelMask is_false_lit; ///< of the wrong ones: 1, else 0
    scene::Image<Cause> cause;
    scene::Image<Label> label;
    scene::Image<std::uint32_t> object; ///< index into `objects`, or beyond for none
    std::vector<std::string> objects;
    scene::Image<float> light_distance_m; ///< light distance [m]; NaN where nothing is scored

    /// Whether it is known of each pixel if the filter takes it.
    [[nodiscard]] bool knows(const PixelFilter& filter) const;
    /// @param pixel  Wrong.
    [[nodiscard]] bool is_taken(std::size_t pixel, const PixelFilter& filter) const;
};

struct PixelPlace {
    int x = 0;
    int y = 0;

    friend bool operator==(const PixelPlace&, const PixelPlace&) = default;
};

/// Pixels that are wrong now and were right.
struct NewPixels {
    std::uint64_t count = 0;
    std::vector<PixelPlace> first;      ///< at most 10, row by row from the top
    PixelPlace lower;                   ///< the top left of what they span
    PixelPlace upper;                   ///< the bottom right, included
    std::optional<DominantCause> cause; ///< the most frequent of them; empty: not known

    static constexpr std::size_t most_named = 10;
};

/// The pixels that the filter takes, that are wrong now and were not before.
/// @param before  Which pixels were wrong.
/// @param now     `knows(filter)`.
/// @throws std::invalid_argument  if the images differ in size.
[[nodiscard]] NewPixels find_new_pixels(const PixelMask& before, const WrongPixels& now,
                                        const PixelFilter& filter);

/// New wrong pixels, or why they are not known.
struct NewPixelAnswer {
    std::optional<NewPixels> found;
    std::string obstacle; ///< "the run kept no pixels"
};

/// Finds the new wrong pixels of a configuration that both have.
using AskNewPixels = std::function<NewPixelAnswer(const GateEntry& before, const GateEntry& now,
                                                  const PixelFilter& filter)>;

} // namespace gnomon::analysis
