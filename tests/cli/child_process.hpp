#pragma once

#include "scene_file_fixture.hpp"

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::testing {

using scene::test::TemporaryFolder;

/// How to start the program, besides its arguments.
struct Start {
    std::vector<std::string> environment;     ///< "NAME=value", added to the test's own
    std::string stdout_path;                  ///< empty: captured
    bool closes_stdout = false;               ///< as `>&-` does
    bool breaks_stdout = false;               ///< a pipe without a reader
    std::uint64_t address_space_bytes = 0;    ///< as `ulimit -v` does; 0: no limit
    std::uint64_t file_bytes = 0;             ///< as `ulimit -f` does; 0: no limit
    double longest_s = 240;                   ///< then it is killed, with its children
    unsigned user_id = 0;                     ///< if the test is root; 0: as the test
    std::function<void(pid_t)> while_running; ///< called after the start
};

/// How a process ended.
struct Ending {
    std::string command;
    int exit_code = -1;                  ///< -1 if a signal ended it
    int signal = 0;                      ///< that signal; SIGKILL if it took too long
    std::string out;                     ///< what it wrote to stdout, if captured
    std::string err;                     ///< what it wrote to stderr
    double time_s = 0;                   ///< by the clock
    std::uint64_t peak_memory_bytes = 0; ///< resident; the largest of it and its children
};

/// Runs any program, found in PATH, to its end.
[[nodiscard]] Ending run(const std::vector<std::string>& command, const Start& start = {});

/// Runs gnomon with these arguments.
[[nodiscard]] Ending gnomon(std::vector<std::string> arguments, const Start& start = {});

/// Arguments that make a comparison small: 160×90 pixels.
[[nodiscard]] std::vector<std::string> small(std::vector<std::string> arguments);

/// Expects this exit code, nothing on stdout, and on stderr one line "gnomon: …" with the text,
/// besides the names of output files.
void expect_refused(const Ending& ending, int exit_code, const std::string& text);

/// Expects exit code 0, and nothing on stderr but the names of output files.
void expect_done(const Ending& ending);

/// A file's bytes; empty if it cannot be read.
[[nodiscard]] std::string text_of(const std::filesystem::path& file);

/// Whether a shell or tool of this name is in PATH.
[[nodiscard]] bool is_installed(const std::string& name);

/// Models of the four formats in Debian's assimp-testmodels, sorted; empty without the package.
[[nodiscard]] std::vector<std::filesystem::path> test_models();

inline constexpr const char* test_models_folder = "/usr/share/assimp/models";

} // namespace gnomon::testing
