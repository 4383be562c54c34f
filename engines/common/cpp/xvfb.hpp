#pragma once

#include <sys/types.h>

namespace engine {

/// An X server of its own on a free display, which DISPLAY names from then on. It ends with this
/// object, at signals that end the adapter, and when the adapter is killed.
class Xvfb {
public:
    /// @throws std::runtime_error  if it does not start.
    Xvfb();
    Xvfb(const Xvfb&) = delete;
    Xvfb& operator=(const Xvfb&) = delete;
    ~Xvfb();

private:
    pid_t process_ = 0;
};

} // namespace engine
