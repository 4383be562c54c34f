#pragma once

#include "scene/job/toml.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gnomon::scene {

/// The largest coordinate and distance; `max_coordinate_m` when rounded to float32.
inline constexpr double farthest_m = 1e15;

struct FlagDomain {};

/// Whole numbers from `lower` to `upper`, both included.
struct IntegerDomain {
    std::int64_t lower = 0;
    std::int64_t upper = 0;
    std::int64_t step = 1;        ///< from one to the next: 1, or 2 for odd numbers
    bool is_power_of_two = false; ///< 1, 2, 4, … alone; with step 1 and a positive `lower`
};

/// Finite numbers from `lower` to `upper`, both included.
struct RealDomain {
    double lower = 0;
    double upper = 0;
    bool normal_float = false; ///< 0, or a normal number once rounded to float32
    bool or_auto = false;      ///< the word "auto" too
};

/// One of `words`.
struct WordDomain {
    std::vector<std::string> words;
    std::string listing = {}; ///< the words in messages; empty: all words
};

/// A text that is not empty.
struct TextDomain {};

struct TextListDomain {};

/// A time with a known sun (`has_sun`), as a text for `utc_time` or a TOML date-time.
struct TimeDomain {};

/// Three finite coordinates within ±1e15, or two, with z = 0.
struct VectorDomain {
    bool zero_allowed = true; ///< if false, at least one must not round to 0 in float32
    std::size_t size = 3;
};

/// What a key accepts.
using Domain = std::variant<FlagDomain, IntegerDomain, RealDomain, WordDomain, TextDomain,
                            TextListDomain, TimeDomain, VectorDomain>;

/// What the domain allows, in words: "an integer from 1 to 16384".
[[nodiscard]] std::string range_text(const Domain& domain);

/// The node's value, or empty if the domain does not allow it.
[[nodiscard]] std::optional<JobValue> read_value(const Domain& domain, const TomlNode& node);

/// Why the domain does not allow the node: "must be an integer from 1 to 16384". Names the nearest
/// word if words are expected.
[[nodiscard]] std::string refusal_text(const Domain& domain, const TomlNode& node);

/// The value as TOML; it reads back as the same value.
[[nodiscard]] std::string to_toml(const JobValue& value);

} // namespace gnomon::scene
