#pragma once

#include <sys/types.h>

#include <functional>

namespace gnomon::store {

/// A child process that runs a function. The destructor kills it.
class Child {
public:
    using Ready = std::function<void()>;

    /// Returns when the function calls its argument, or ends.
    explicit Child(const std::function<void(Ready)>& work);
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child();

    [[nodiscard]] pid_t pid() const { return pid_; }
    /// Sends SIGKILL and waits.
    void kill();
    /// Waits for its end. Returns 0 if the function threw no exception.
    int exit_code();

private:
    pid_t pid_ = -1;
};

} // namespace gnomon::store
