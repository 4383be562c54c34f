#pragma once

#include "methods/method.hpp"

#include <span>
#include <string_view>

namespace gnomon::methods {

/// All methods, in the order in which `gnomon methods` prints them. The list stands in a file of
/// its own, so that a program can be linked with another.
[[nodiscard]] std::span<const Method> methods();

/// The method of that name, or nullptr.
[[nodiscard]] const Method* find_method(std::string_view name);

/// The job's method.
/// @throws std::invalid_argument  if there is none of its name.
[[nodiscard]] const Method& method_of(const scene::Job& job);

/// What the job's method promises of its lookups.
[[nodiscard]] Promises promises(const scene::Job& job);

/// @throws scene::InputError  if the settings of the job's method do not go together.
void check(const scene::Job& job);

/// What GL is to do for the job.
[[nodiscard]] Passes passes(const scene::Job& job);

/// Hands names and keys of all methods to the table of keys (`scene::hand_over_methods`): once,
/// before it is read.
void hand_keys_to_scene();

} // namespace gnomon::methods
