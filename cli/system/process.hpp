#pragma once

#include "scene/error.hpp"

#include <sys/types.h>

#include <filesystem>
#include <string_view>

namespace gnomon::cli {

/// Opens /dev/null for closed descriptors among 0 to 2: otherwise the first file opened would take
/// stdout's number and receive what is printed. Turns SIGPIPE and SIGXFSZ (ulimit -f) into errors
/// of the call that writes.
void keep_standard_streams();

/// On SIGINT, SIGTERM and SIGHUP, removes temporary files and exits with 128 + signal, 130 for
/// SIGINT. A signal that the caller ignores (nohup) stays ignored.
void clean_up_on_signals();

/// Sets the child that gets SIGTERM before a signal ends this process; 0 for none.
void end_with_this_process(pid_t child);

/// From now on the first SIGINT, SIGTERM or SIGHUP only makes `is_interrupted` true, so that work
/// can stop where it can resume. A second one ends the process at once.
void stop_on_signals();
[[nodiscard]] bool is_interrupted();

/// The reader of stdout is gone, as behind `| head`. The program ends without a message.
class BrokenPipe : public scene::EnvironmentError {
public:
    BrokenPipe() : EnvironmentError{"standard output: nobody reads it"} {}
};

/// Writes to stdout and flushes.
/// @throws BrokenPipe               if stdout is a pipe that nobody reads.
/// @throws scene::EnvironmentError  if the bytes cannot be written, e.g. on a full disk.
void print(std::string_view text);

/// A folder of program data: in the installation, relative to the program, else in the source tree.
[[nodiscard]] std::filesystem::path data_folder(const char* from_program, const char* in_source);

/// The parent of temporary folders: TMPDIR, or /tmp.
/// @throws scene::EnvironmentError  if TMPDIR is not a folder.
[[nodiscard]] std::filesystem::path temporary_folder();

/// Creates a folder `prefix`-XXXXXX with a random name.
/// @throws scene::EnvironmentError  if it cannot be created.
[[nodiscard]] std::filesystem::path make_temporary_folder(const std::filesystem::path& parent,
                                                          std::string_view prefix);

} // namespace gnomon::cli
