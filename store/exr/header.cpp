#include "store/exr/header.hpp"

#include "store/exr/exact_inputs.hpp"
#include "store/job_json.hpp"
#include "store/json_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gnomon::store {

namespace {

void add_job(std::vector<ExrAttribute>& header, std::string_view prefix,
             const analysis::Comparison& comparison)
{
    header.push_back({fmt::format("{}job", prefix), job_json(comparison)});
}

void add_common(std::vector<ExrAttribute>& header, const analysis::Comparison& comparison)
{
    const analysis::Environment& environment = comparison.environment;
    header.push_back({"gnomon:scene", comparison.scene.name});
    header.push_back({"gnomon:scene_hash", comparison.scene.hash});
    header.push_back({"gnomon:truth_method", comparison.truth_method});
    header.push_back({"gnomon:gl_renderer", environment.gl_renderer});
    header.push_back({"gnomon:gl_version", environment.gl_version});
    header.push_back({"gnomon:embree", environment.embree});
    header.push_back({"gnomon:version", environment.gnomon});
}

void add_exact_inputs(std::vector<ExrAttribute>& header, std::string_view prefix,
                      const analysis::Comparison& comparison)
{
    for (const ExactInput& input : exact_inputs(comparison)) {
        header.push_back({fmt::format("{}{}", prefix, input.name),
                          fmt::format("{}", fmt::join(input.values, " "))});
    }
}

} // namespace

std::vector<ExrAttribute> exr_header(const analysis::Comparison& comparison)
{
    constexpr std::string_view prefix = "gnomon:";
    std::vector<ExrAttribute> header;
    add_job(header, prefix, comparison);
    add_common(header, comparison);
    add_exact_inputs(header, prefix, comparison);
    return header;
}

std::vector<ExrAttribute> exr_header(std::span<const analysis::Comparison> lights)
{
    std::vector<ExrAttribute> header;
    add_common(header, lights.front());
    for (const analysis::Comparison& comparison : lights) {
        const std::string prefix = fmt::format("gnomon:{}.", comparison.light);
        add_job(header, prefix, comparison);
        add_exact_inputs(header, prefix, comparison);
    }
    return header;
}

} // namespace gnomon::store
