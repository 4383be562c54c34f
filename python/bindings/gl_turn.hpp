#pragma once

#include "api/comparison_session.hpp"
#include "python/bindings/jobs.hpp"
#include "raster_gl/context.hpp"

#include <memory>
#include <mutex>
#include <optional>

namespace gnomon::python {

/// A thread's turn to draw. The context that the thread had, of another library, is its again
/// afterwards.
class GlTurn {
public:
    /// @throws scene::EnvironmentError  as `raster_gl::Context` does, and in a process that was
    ///                                  forked from one that had drawn.
    explicit GlTurn(std::optional<int> device);
    GlTurn(const GlTurn&) = delete;
    GlTurn& operator=(const GlTurn&) = delete;

    /// What a session is opened with on this turn.
    [[nodiscard]] api::SessionOptions options(int threads) const;
    /// A session with the scene that the job's lights share. Ctrl-C ends its work.
    [[nodiscard]] std::unique_ptr<const api::ComparisonSession>
    open(const JobPlace& place, const ReadJob& job, int threads) const;

private:
    std::lock_guard<std::mutex> alone_;
    raster_gl::PreviousContext previous_;
};

} // namespace gnomon::python
