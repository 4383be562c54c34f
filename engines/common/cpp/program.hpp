#pragma once

#include "cpp/serve.hpp"

#include <sys/types.h>

#include <functional>
#include <memory>
#include <string_view>

namespace engine {
/// An adapter's main(). Reads the options, creates the engine and answers requests.
/// --rasterizer=system draws with the system's GL; softpipe with Mesa's other rasterizer, to tell
/// errors of the engine from those of the driver. --mask=shader takes the mask from the engine's
/// shader; picture computes it from the engine's pictures.
/// @param name  starts messages on standard error.
/// @param make  creates the engine, after the rasterizer was chosen.
/// @return  The exit status: 0 after `close` or the end of input, else 1.
int run(std::string_view name, int argc, char** argv,
        const std::function<std::unique_ptr<Engine>(Mask)>& make);

/// An X server on a free display; sets DISPLAY. It ends with this object, and also if a signal ends
/// or kills the adapter. Create one at most.
class Xvfb {
public:
    /// @throws std::runtime_error  if the server does not start.
    Xvfb();
    Xvfb(const Xvfb&) = delete;
    Xvfb& operator=(const Xvfb&) = delete;
    ~Xvfb();

private:
    pid_t process_ = 0;
};

} // namespace engine
