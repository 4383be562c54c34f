#include "cli/session/scene_session.hpp"

#include "cli/system/stopwatch.hpp"

namespace gnomon::cli {

SceneSession::SceneSession(const raster_gl::Context& context, const scene::TriangleScene& triangles,
                           const SessionOptions& options)
    : gl_{context, triangles}
{
    const bool is_exact = options.method == reference_rt::TruthMethod::exact;
    reference_ = timed(bvh_s_, [&] {
        return std::make_unique<reference_rt::ReferenceScene>(
            triangles,
            reference_rt::ReferenceOptions{options.threads, is_exact, !is_exact || options.audits});
    });
    renderers_ =
        make_renderers(gl_, context.facts(), *reference_, {options.method, options.threads});
}

} // namespace gnomon::cli
