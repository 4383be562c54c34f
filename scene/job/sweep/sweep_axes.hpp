#pragma once

#include "scene/job/keys/key_table.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/job/toml.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// Reads `[sweep]`: its expanded axes, with each value checked against its key, and its mode.
/// @throws InputError  "file:line: [sweep] key = value: …".
[[nodiscard]] Sweep read_sweep(const KeyTable& keys, const TomlMember& member,
                               const std::string& file);

/// Reads "KEY=VALUES" of `--axis`: a TOML list or range, or comma-separated values, where a bare
/// word is a string.
/// @throws InputError  "--axis KEY=VALUES: …".
[[nodiscard]] SweepAxis read_axis_argument(const KeyTable& keys, const std::string& argument);

/// Refuses axes of different lengths with `mode = "zip"`, and too many values.
/// @throws InputError  naming the axis.
void check_axis_lengths(const Sweep& sweep, const std::string& file);

/// Converts an argument of `--axis` to that of a job with only this light:
/// "lights.sun.bias.slope=0,1" becomes "bias.slope=0,1". Leaves others unchanged.
[[nodiscard]] std::string axis_argument_of_light(const KeyTable& keys, const std::string& argument,
                                                 std::string_view light);

/// The axes that apply to one of several lights, for a job with only that light: its own axes, and
/// the axes for all lights that it does not replace.
[[nodiscard]] std::vector<SweepAxis>
axes_of_light(const KeyTable& keys, const std::vector<SweepAxis>& axes, std::string_view light);

} // namespace gnomon::scene
