#include "api/loaded_scene.hpp"

#include "analysis/stopwatch.hpp"
#include "reference_rt/truth.hpp"

namespace gnomon::api {

namespace {

reference_rt::ReferenceOptions hierarchies_for(const SessionOptions& options)
{
    const bool is_exact = options.method == reference_rt::TruthMethod::exact;
    return {options.threads, is_exact, !is_exact || options.audits};
}

} // namespace

std::shared_ptr<const raster_gl::Context> opened(const SessionOptions& options)
{
    return options.context != nullptr ? options.context
                                      : std::make_shared<const raster_gl::Context>(options.device);
}

LoadedScene::LoadedScene(const raster_gl::Context& context, const scene::TriangleScene& triangles,
                         const SessionOptions& options)
    : gl_{context, triangles},
      rasterizer_{gl_, options.check_interruption},
      scene_{analysis::timed(
          bvh_s_,
          [&] {
              return reference_rt::ReferenceScene{triangles, hierarchies_for(options)};
          })},
      reference_{scene_, {options.method, options.threads}},
      renderers_{rasterizer_,
                 reference_,
                 {context.facts().renderer, context.facts().version, reference_rt::embree_version(),
                  GNOMON_VERSION}}
{
}

} // namespace gnomon::api
