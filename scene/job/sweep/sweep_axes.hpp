#pragma once

#include "scene/job/keys/key_table.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/job/toml.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// Reads `[sweep]`: its axes, expanded and each value checked against its key, and how to combine
/// them.
/// @throws InputError  "file:line: [sweep] key = value: …".
[[nodiscard]] Sweep read_sweep(const KeyTable& keys, const TomlMember& member,
                               const std::string& file);

/// Reads "KEY=VALUES" of `--axis`: a TOML list or range, or values between commas, where a bare
/// word is a string.
/// @throws InputError  "--axis KEY=VALUES: …".
[[nodiscard]] SweepAxis read_axis_argument(const KeyTable& keys, const std::string& argument);

/// Axes of `mode = "zip"` must be equally long, and no sweep holds too many values.
/// @throws InputError  naming the axis.
void check_axis_lengths(const Sweep& sweep, const std::string& file);

/// "bias.slope=0,1" of "lights.sun.bias.slope=0,1": an argument of `--axis` as one of a job with
/// that light alone. Others are as they are.
[[nodiscard]] std::string axis_argument_of_light(const KeyTable& keys, const std::string& argument,
                                                 std::string_view light);

/// The axes of a sweep that one of several lights is told of, as one of a job with that light
/// alone: those of all lights, but those that the light has for itself.
[[nodiscard]] std::vector<SweepAxis>
axes_of_light(const KeyTable& keys, const std::vector<SweepAxis>& axes, std::string_view light);

} // namespace gnomon::scene
