#pragma once

#include "scene/job/keys/key.hpp"
#include "scene/job/value.hpp"
#include "scene/settings/job.hpp"

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
/// Opening angles; a float32 projection cannot represent angles closer to 0 or 180 degrees.
inline constexpr RealDomain opening_angle_deg{.lower = 0.001, .upper = 179.999};

/// The prefix of a built-in's parameters: "scene.wall." for "wall".
[[nodiscard]] std::string parameter_prefix(std::string_view builtin);

/// The keys of `[scene]`, `[camera]`, `[image]` and `[light]`; built-in parameters follow the other
/// keys of `[scene]`.
[[nodiscard]] std::vector<Key> look_keys();

/// The keys of `[shadow_map]`, `[lookup]` and `[bias]`.
[[nodiscard]] std::vector<Key> map_keys();

/// The keys of `[shadow_map]` for `layout = "cascades"`.
[[nodiscard]] std::vector<Key> cascade_keys();
/// Whether a key applies to `layout = "cascades"` alone.
[[nodiscard]] bool is_cascade_key(std::string_view name);

/// Limits a key to some types of light.
[[nodiscard]] Key of_lights(Key key, std::vector<LightType> lights);

/// Completes a key with its domain and its place in a job.
[[nodiscard]] Key job_key(Key key, Domain domain, std::function<void(Job&, const JobValue&)> set,
                          std::function<std::optional<JobValue>(const Job&)> get,
                          std::string example = {});

/// Wraps a value, made in place so that no temporary variant is moved.
template <typename Value>
[[nodiscard]] std::optional<JobValue> held(Value value)
{
    return std::optional<JobValue>{std::in_place, std::move(value)};
}

/// A key that every job stores as a `Value`.
/// @param access  Returns the job's member by reference, for const and mutable jobs.
template <typename Value, typename Access>
[[nodiscard]] Key member_key(Key key, Domain domain, Access access)
{
    key.domain = std::move(domain);
    key.set = [access](Job& job, const JobValue& value) {
        auto& member = access(job);
        using Member = std::remove_reference_t<decltype(member)>;
        member = static_cast<Member>(std::get<Value>(value));
    };
    key.get = [access](const Job& job) -> std::optional<JobValue> {
        return held(static_cast<Value>(access(job)));
    };
    return key;
}

/// A key for a number, or "auto" if the program decides.
/// @param access  Returns the job's `std::optional<double>` by reference.
template <typename Access>
[[nodiscard]] Key number_or_auto_key(Key key, RealDomain domain, Access access)
{
    return job_key(
        std::move(key), domain,
        [access](Job& job, const JobValue& value) {
            const double* number = std::get_if<double>(&value);
            access(job) = number != nullptr ? std::optional<double>{*number} : std::nullopt;
        },
        [access](const Job& job) -> std::optional<JobValue> {
            const auto& number = access(job);
            return number ? held(*number) : held(std::string{"auto"});
        });
}

/// A key for words that name the values of an enumeration, counted from 0.
/// @param access  Returns the destination by reference.
/// @param read    Returns the job's value.
template <typename Enum, typename Access, typename Read>
[[nodiscard]] Key word_key(Key key, int word_count, std::string_view (*name)(Enum), Access access,
                           Read read)
{
    WordDomain domain;
    for (int i = 0; i < word_count; ++i) {
        domain.words.emplace_back(name(static_cast<Enum>(i)));
    }
    key.domain = std::move(domain);
    key.set = [access, name](Job& job, const JobValue& value) {
        Enum candidate{};
        while (name(candidate) != std::get<std::string>(value)) {
            candidate = static_cast<Enum>(static_cast<int>(candidate) + 1);
        }
        access(job) = candidate;
    };
    key.get = [read, name](const Job& job) -> std::optional<JobValue> {
        return held(std::string{name(read(job))});
    };
    return key;
}

/// As above, for a member that every job stores.
/// @param access  Returns it by reference, for const and mutable jobs.
template <typename Enum, typename Access>
[[nodiscard]] Key word_key(Key key, int word_count, std::string_view (*name)(Enum), Access access)
{
    return word_key(std::move(key), word_count, name, access, access);
}

} // namespace gnomon::scene
