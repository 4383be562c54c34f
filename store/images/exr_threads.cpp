#include "store/images/exr_threads.hpp"

#include <OpenEXR/ImfThreading.h>

#include <exception>
#include <thread>

namespace gnomon::store {

int exr_threads(std::uint64_t bytes)
{
    constexpr std::uint64_t small_bytes = 1U << 20;
    if (bytes < small_bytes) {
        return 0;
    }
    static const int threads = [] {
        const int cores = static_cast<int>(std::thread::hardware_concurrency());
        try {
            Imf::setGlobalThreadCount(cores);
        } catch (const std::exception&) { // a limit on threads: it goes slower, but it goes
            return 0;
        }
        return cores;
    }();
    return threads;
}

} // namespace gnomon::store
