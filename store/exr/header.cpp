#include "store/exr/header.hpp"

#include "store/exr/exact_inputs.hpp"
#include "store/job_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gnomon::store {

std::vector<ExrAttribute> exr_header(const analysis::Comparison& comparison)
{
    const analysis::Environment& environment = comparison.environment;
    std::vector<ExrAttribute> result{
        {"gnomon:job", job_json(comparison)},
        {"gnomon:scene", comparison.scene.name},
        {"gnomon:scene_hash", comparison.scene.hash},
        {"gnomon:truth_method", comparison.truth_method},
        {"gnomon:gl_renderer", environment.gl_renderer},
        {"gnomon:gl_version", environment.gl_version},
        {"gnomon:embree", environment.embree},
        {"gnomon:version", environment.gnomon},
    };
    for (const ExactInput& input : exact_inputs(comparison)) {
        result.push_back({"gnomon:" + input.name, fmt::format("{}", fmt::join(input.values, " "))});
    }
    return result;
}

} // namespace gnomon::store
