#pragma once

#include "child_process.hpp"

#include <string>
#include <vector>

namespace gnomon::testing {

/// The fake renderer's command line, which chooses a way to misbehave, and a folder for temporary
/// files that must be empty afterwards.
class FakeRenderer {
public:
    explicit FakeRenderer(const std::string& way);

    [[nodiscard]] const std::string& command() const { return command_; }
    /// How to start gnomon with it.
    [[nodiscard]] Start start() const;
    /// How often the renderer was started.
    [[nodiscard]] int starts() const;
    /// Expects that none of its processes and files are left.
    void expect_nothing_left() const;

private:
    std::string mark_;
    std::string command_;
    TemporaryFolder temporary_;
    TemporaryFolder own_; ///< its log
};

} // namespace gnomon::testing
