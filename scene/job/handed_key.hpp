#pragma once

#include "scene/job/job.hpp"
#include "scene/job/job_key.hpp"
#include "scene/job/value.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// What the numbers of `TriedValues` count.
enum class TriedUnit : std::uint8_t {
    of_key,          ///< what the key counts
    scene_diagonals, ///< of a key in metres: diagonals of the scene's bounding box
    texel_widths,    ///< of a key in metres: widths of a texel at the median receiver
};

/// Values that a search for settings tries, beside the key's default and the job's own.
struct TriedValues {
    std::vector<JobValue> values = {};
    TriedUnit unit = TriedUnit::of_key; ///< of values that are numbers
};

/// A key that a layer above hands to the table of keys: of a shadow method, "method.KEY", of one of
/// its bias terms, "bias.KEY", or of another renderer, "engine.KEY".
struct HandedKey {
    JobKey key; ///< from `make_key`, without its default and range, which follow from what is here
    Domain domain;
    JobValue default_value;
    TriedValues tried = {};                ///< empty: a search leaves the key as it is
    std::vector<std::string> methods = {}; ///< the names of those that have it

    /// "bias" of "bias.constant".
    [[nodiscard]] std::string_view table() const;
    /// Whether the method of that name has it.
    [[nodiscard]] bool is_of(std::string_view method) const;
    /// The row of the key table.
    [[nodiscard]] JobKey row() const;
    /// What the job has it at: its own value, or the default.
    [[nodiscard]] const JobValue& value_of(const Job& job) const;
};

/// A name that `method.name` takes.
struct HandedMethod {
    std::string name;
    bool has_filters = false; ///< else a job with this method has no lookup.filter
    std::vector<std::string> unread_tables = {}; ///< it has no key of these: "bias"
};

} // namespace gnomon::scene
