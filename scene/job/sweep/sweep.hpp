#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// A key with a value in TOML syntax; a bare word is a string.
struct Override {
    std::string key;
    std::string value;
    std::string_view said_by = "--set "; ///< start of messages; empty if no option gave it
};

/// One axis of `[sweep]`, expanded to values in TOML syntax.
struct SweepAxis {
    std::string key;
    std::vector<std::string> values;
};

struct Sweep {
    std::vector<SweepAxis> axes;
    std::string mode = "product"; ///< product | zip
    std::int64_t sample = 0;      ///< 0: all
    std::int64_t seed = 0;
};

struct Case {
    std::string name;
    std::vector<Override> overrides;
};

} // namespace gnomon::scene
