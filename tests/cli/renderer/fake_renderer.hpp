#pragma once

#include "child_process.hpp"

#include <string>
#include <vector>

namespace gnomon::testing {

/// A command line for the fake renderer, which misbehaves in a way of its own, and a folder for
/// temporary files that must be empty after it.
class FakeRenderer {
public:
    explicit FakeRenderer(const std::string& way);

    [[nodiscard]] const std::string& command() const { return command_; }
    /// How gnomon is started with it.
    [[nodiscard]] Start start() const;
    /// How often the renderer was started.
    [[nodiscard]] int starts() const;
    /// Fails if a process of it runs, or a file of it is left.
    void expect_nothing_left() const;

private:
    std::string mark_;
    std::string command_;
    TemporaryFolder temporary_;
    TemporaryFolder own_; ///< its log
};

} // namespace gnomon::testing
