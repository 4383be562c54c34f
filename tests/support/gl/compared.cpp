#include "compared.hpp"

#include "analysis/sweep/compare.hpp"
#include "renderers/forwarding.hpp"

#include <utility>

namespace gnomon::tests {
namespace {

/// Hides the light queries, so that nothing is diagnosed.
class TruthAlone final : public renderers::ForwardingReference {
public:
    using ForwardingReference::ForwardingReference;
    [[nodiscard]] bool has_light_queries() const override { return false; }
};

} // namespace

Compared::Compared(scene::SceneFile file)
    : file_{std::move(file)},
      session_{
          std::make_unique<api::LoadedScene>(*shared_context(), file_.scene, api::SessionOptions{})}
{
}

analysis::Comparison Compared::operator()(const scene::Job& job) const
{
    return analysis::compare(job, file_, renderers());
}

analysis::Comparison Compared::without_diagnosis(const scene::Job& job) const
{
    const TruthAlone truth{renderers().reference};
    return analysis::compare(job, file_, {renderers().rasterizer, truth, renderers().environment});
}

renderers::Drawn Compared::drawn(const scene::Job& job, const scene::View& view) const
{
    renderers::Rasterizer& rasterizer = renderers().rasterizer;
    return {rasterizer.draw_receivers(view), renderers::draw_filtered_map(rasterizer, job, view)};
}

} // namespace gnomon::tests
