#pragma once

#include <sys/types.h>

namespace gnomon::cli {

/// Makes file descriptors 0 to 2 exist, and a broken pipe or a file that may not grow (ulimit -f)
/// an error of the call that writes. Otherwise, with stdout closed, the first file opened would
/// take its number and receive what is printed.
void keep_standard_streams();

/// Ends the process on SIGINT, SIGTERM and SIGHUP with exit status 128 + signal, 130 for SIGINT,
/// and no temporary file left; a signal that the caller ignores (nohup) stays ignored.
void clean_up_on_signals();

/// A child that a signal, when it ends this process, ends first (SIGTERM); 0: none any more.
void end_with_this_process(pid_t child);

/// From now on the first SIGINT, SIGTERM or SIGHUP only makes `is_interrupted` true, for work that
/// can stop at a good place; a second one ends the process at once.
void stop_on_signals();
[[nodiscard]] bool is_interrupted();

} // namespace gnomon::cli
