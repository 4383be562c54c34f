#pragma once

#include "scene/job/job.hpp"
#include "scene/job/job_key.hpp"
#include "scene/job/value.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::scene {

/// Most texels or pixels along a side.
inline constexpr std::int64_t largest_side = 16384;
/// Opening angles; a float32 projection cannot hold those nearer to 0 or 180 degrees.
inline constexpr RealDomain opening_angle_deg{.lower = 0.001, .upper = 179.999};

/// A row of the one table of keys: what a key accepts, what it changes, and where it lives in a
/// job.
struct KeySpec {
    JobKey key;
    Domain domain;
    std::function<void(Job&, const JobValue&)> set;
    /// Empty where the job leaves the key out (a camera that the scene decides, …).
    std::function<std::optional<JobValue>(const Job&)> get;
    std::function<bool(std::string_view method)> is_of; ///< whether jobs of that method have it
    std::string example; ///< a value to show for a key without a default
};

/// The last part of a dotted key.
[[nodiscard]] std::string_view key_leaf(std::string_view name);

/// A built-in's parameters, as they stand among the keys: "scene.wall." for "wall".
[[nodiscard]] std::string parameter_prefix(std::string_view builtin);

/// The scene's own rows of `[scene]`, `[camera]`, `[image]` and `[light]`; a built-in's parameters
/// follow the other keys of `[scene]`.
[[nodiscard]] std::vector<KeySpec> look_key_specs();

/// The scene's own rows of `[shadow_map]`, `[lookup]` and `[bias]`.
[[nodiscard]] std::vector<KeySpec> map_key_specs();

/// Those of them that are for `layout = "cascades"`.
[[nodiscard]] std::vector<KeySpec> cascade_key_specs();

[[nodiscard]] constexpr Stages operator|(Stage a, Stage b)
{
    return static_cast<Stages>(static_cast<Stages>(a) | static_cast<Stages>(b));
}
[[nodiscard]] constexpr Stages operator|(Stages a, Stage b)
{
    return static_cast<Stages>(a | static_cast<Stages>(b));
}
[[nodiscard]] constexpr Stages only(Stage stage)
{
    return static_cast<Stages>(stage);
}

/// A key whose range text is still to be filled in from its domain.
/// @param description  With `{unit}` where its unit shall stand.
[[nodiscard]] JobKey make_key(std::string name, std::string description, std::string default_text,
                              Stages stages, std::string unit = {});

/// A value that a job has; made in place, so that no temporary variant needs moving.
template <typename Value>
[[nodiscard]] std::optional<JobValue> held(Value value)
{
    return std::optional<JobValue>{std::in_place, std::move(value)};
}

/// A row whose value a job always holds as a `Value`.
/// @param access  Returns the job's member by reference, for a const job and for one that is not.
template <typename Value, typename Access>
[[nodiscard]] KeySpec member_key(JobKey key, Domain domain, Access access)
{
    KeySpec spec{std::move(key), std::move(domain), {}, {}, {}, {}};
    spec.set = [access](Job& job, const JobValue& value) {
        auto& member = access(job);
        using Member = std::remove_reference_t<decltype(member)>;
        member = static_cast<Member>(std::get<Value>(value));
    };
    spec.get = [access](const Job& job) -> std::optional<JobValue> {
        return held(static_cast<Value>(access(job)));
    };
    return spec;
}

/// A row for one of a few words that stand for an enumeration's values, which count from 0.
/// @param access  Returns by reference what the word is written to.
/// @param read    Returns the value that the job has.
template <typename Enum, typename Access, typename Read>
[[nodiscard]] KeySpec word_key(JobKey key, int word_count, std::string_view (*name)(Enum),
                               Access access, Read read)
{
    WordDomain domain;
    for (int i = 0; i < word_count; ++i) {
        domain.words.emplace_back(name(static_cast<Enum>(i)));
    }
    KeySpec spec{std::move(key), std::move(domain), {}, {}, {}, {}};
    spec.set = [access, name](Job& job, const JobValue& value) {
        Enum candidate{};
        while (name(candidate) != std::get<std::string>(value)) {
            candidate = static_cast<Enum>(static_cast<int>(candidate) + 1);
        }
        access(job) = candidate;
    };
    spec.get = [read, name](const Job& job) -> std::optional<JobValue> {
        return held(std::string{name(read(job))});
    };
    return spec;
}

/// The same, of a member that every job holds.
/// @param access  Returns it by reference, for a const job and for one that is not.
template <typename Enum, typename Access>
[[nodiscard]] KeySpec word_key(JobKey key, int word_count, std::string_view (*name)(Enum),
                               Access access)
{
    return word_key(std::move(key), word_count, name, access, access);
}

} // namespace gnomon::scene
