#include "compared.hpp"

#include <utility>

namespace gnomon::tests {

Compared::Compared(scene::SceneFile file)
    : file_{std::move(file)},
      gl_{std::make_unique<cli::GlRenderer>(*shared_context(), file_.scene)},
      reference_{file_.scene}
{
}

analysis::Comparison Compared::operator()(const scene::Job& job) const
{
    return analysis::compare(job, file_, renderers());
}

analysis::Comparison Compared::without_diagnosis(const scene::Job& job) const
{
    analysis::Renderers plain = renderers();
    plain.make_exact_light = nullptr;
    return analysis::compare(job, file_, plain);
}

analysis::Renderers Compared::renderers() const
{
    return cli::make_renderers(*gl_, shared_context()->facts(), reference_, {});
}

} // namespace gnomon::tests
