#include "python/bindings/gl_turn.hpp"

#include "python/bindings/bindings.hpp"
#include "scene/error.hpp"

#include <unistd.h>

namespace gnomon::python {
namespace {

/// The process's GL context, which is current on one thread at a time. EGL ends all contexts of a
/// display together, and each one that is made leaves some memory behind: one is kept.
struct SharedContext {
    std::mutex turn;
    std::optional<int> device;
    pid_t process = 0; ///< that made the context
    std::shared_ptr<const raster_gl::Context> context;
};

/// Never destroyed: the driver ends before static objects do.
SharedContext& shared()
{
    static auto* const kept = new SharedContext;
    return *kept;
}

} // namespace

GlTurn::GlTurn(std::optional<int> device) : alone_{shared().turn}
{
    SharedContext& kept = shared();
    if (kept.context != nullptr && kept.process != getpid()) {
        throw scene::EnvironmentError("this process was forked from one that had drawn, and "
                                      "drivers do not work in both: start it anew (\"spawn\")");
    }
    if (kept.context != nullptr && kept.device == device) {
        kept.context->make_current();
    } else {
        kept.context.reset();
        kept.context = std::make_shared<const raster_gl::Context>(device);
        kept.device = device;
        kept.process = getpid();
    }
}

api::SessionOptions GlTurn::options(int threads) const
{
    return {.device = shared().device, .threads = threads, .context = shared().context};
}

std::unique_ptr<const api::ComparisonSession> GlTurn::open(const JobPlace& place,
                                                           const ReadJob& job, int threads) const
{
    api::SessionOptions own = options(threads);
    own.check_interruption = check_signals;
    return place.scene != nullptr ? std::make_unique<const api::ComparisonSession>(
                                        place.scene->file(), job.lights, own)
                                  : std::make_unique<const api::ComparisonSession>(job.lights, own);
}

} // namespace gnomon::python
