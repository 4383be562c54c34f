#include "analysis/bias/bias_reruns.hpp"

#include "analysis/metrics/metrics.hpp"
#include "methods/depth/filters.hpp"

#include <cmath>

namespace gnomon::analysis {

std::vector<float> rerun_list()
{
    std::vector<float> biases{0.0F};
    for (int i = 0; i <= 24; ++i) {
        biases.push_back(static_cast<float>(1e-6 * std::pow(10.0, i / 4.0)));
    }
    return biases;
}

std::vector<BiasRerun> rerun_biases(const scene::Job& job, const scene::View& view,
                                    const scene::TruthLayers& truth, const Renderers& renderers)
{
    scene::View biased = view;
    std::vector<BiasRerun> reruns;
    for (const float bias : rerun_list()) {
        biased.bias.constant = bias;
        const Metrics metrics = measure(truth, renderers.look_up(job, biased),
                                        methods::filter_promises(job.lookup.filter).equal_taps());
        reruns.push_back({bias,
                          {metrics.false_shadow, metrics.false_lit},
                          metrics.false_shadow_rate,
                          metrics.false_lit_rate,
                          metrics.error_rate,
                          metrics.amounts});
    }
    return reruns;
}

} // namespace gnomon::analysis
