#pragma once

#include <cstdint>
#include <string>

namespace gnomon::scene {

/// A stage of the computation. A key names the stages whose result changes with it, so that a sweep
/// knows what it can keep.
enum class Stage : std::uint8_t {
    scene = 1 << 0,      ///< triangles
    truth = 1 << 1,      ///< classes
    receivers = 1 << 2,  ///< camera pass; with lookup.position = "vertex" light clip coordinates
    shadow_map = 1 << 3, ///< the map
    prefilter = 1 << 4,  ///< what a method makes of the map before it is looked up
    lookup = 1 << 5,     ///< r, d
    bias = 1 << 6,       ///< verdicts only: answered by the bias curve
};
using Stages = std::uint8_t;

/// One key of the job file.
struct JobKey {
    std::string name;         ///< "shadow_map.resolution"
    std::string description;  ///< one line, with unit
    std::string unit;         ///< "m", "depth units"; empty: none
    std::string default_text; ///< as written in TOML, e.g. "1024" or "\"d24\""
    std::string range_text;   ///< e.g. "an integer from 1 to 16384"
    Stages stages = 0;        ///< the first stages that must be redone when it changes
};

} // namespace gnomon::scene
