#pragma once

#include <sys/types.h>

#include <functional>

namespace gnomon::store {

/// A process that runs a function, and is killed when this goes out of scope.
class Child {
public:
    using Ready = std::function<void()>;

    /// Returns once the function called its argument, or ended.
    explicit Child(const std::function<void(Ready)>& work);
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child();

    [[nodiscard]] pid_t pid() const { return pid_; }
    /// SIGKILL.
    void kill();
    /// Waits for its end; 0 if it ended without an exception.
    int exit_code();

private:
    pid_t pid_ = -1;
};

} // namespace gnomon::store
