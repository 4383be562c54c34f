#pragma once

#include <string_view>

namespace gnomon::cli {

/// The program's first argument when it is to guard another program, in place of a command.
inline constexpr std::string_view guard_word = "--guard-process";

/// In the guard: the socket that its owner holds the other end of.
inline constexpr int guard_socket = 3;

/// Runs the arguments after `guard_word`, FOLDER COMMAND..., as the guard of that command. It is
/// started in FOLDER, which is its TMPDIR too, in a process group of its own, with the guard's
/// standard streams. When it ends, or nobody holds the other end of `guard_socket` any more, all
/// that it started ends with it, whatever group or session that is in by now, and its exit status
/// is written to the socket as an `int`. When the other end is closed, the folder that FOLDER is in
/// is removed.
///
/// The guard is a process of its own, so that nothing is left behind however its owner ends.
/// @return  the command's exit status, 128 + the signal that ended it, or 127 if it cannot be run.
int guard_process(int argc, char** argv);

} // namespace gnomon::cli
