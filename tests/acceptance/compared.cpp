#include "compared.hpp"

namespace gnomon::tests {

Compared::Compared(const scene::Job& job)
    : file_{scene::load_scene(job.scene)},
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
