#pragma once

#include <array>
#include <string_view>

namespace gnomon::cli {

/// A pipe whose ends no child inherits by itself.
class Pipe {
public:
    /// @throws scene::EnvironmentError  if the system gives none.
    Pipe();
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe();

    [[nodiscard]] int reader() const { return ends_[0]; }
    [[nodiscard]] int writer() const { return ends_[1]; }
    void close_reader() { close_end(ends_[0]); }
    void close_writer() { close_end(ends_[1]); }

private:
    static void close_end(int& end);

    std::array<int, 2> ends_{-1, -1};
};

/// @param code  what a call of the system returned, 0 or an error's number.
/// @throws scene::EnvironmentError  naming the call, if it failed.
void require_call(int code, std::string_view call);

} // namespace gnomon::cli
