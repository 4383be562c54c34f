#include "analysis/sweep/sweep_task.hpp"

#include "scene/error.hpp"

#include <algorithm>
#include <cstddef>

namespace gnomon::analysis {

float own_constant_bias(const scene::Job& job, const scene::LightFrustum& frustum)
{
    try {
        return scene::resolve_bias(job.bias, frustum).constant;
    } catch (const scene::InputError&) {
        return 0;
    }
}

CurveQuestion question_of(SweepTask& task, const scene::LightFrustum& frustum,
                          std::vector<RefusedRow>& refused)
{
    const float slope = scene::resolve_bias({.slope = task.job.bias.slope}, frustum).slope;
    CurveQuestion question{task.id, slope, own_constant_bias(task.job, frustum), {}};
    std::erase_if(task.rows, [&](const SweepTask::Row& row) {
        try {
            question.rows.push_back({row.ordinal, scene::resolve_bias(row.bias, frustum).constant});
            return false;
        } catch (const scene::InputError& error) {
            refused.push_back({row.ordinal, error.what()});
            return true;
        }
    });
    return question;
}

std::vector<float> wanted_biases(const CurveQuestion& question, const CurveResult& curve)
{
    constexpr std::size_t most_rows = 8;
    std::vector<float> wanted{question.job_bias};
    if (curve.best) {
        wanted.push_back(curve.best->recommended());
    }
    const std::size_t count = question.rows.size();
    const std::size_t rows = std::min(count, most_rows);
    for (std::size_t i = 0; i < rows; ++i) {
        wanted.push_back(question.rows[rows == 1 ? 0 : i * (count - 1) / (rows - 1)].bias);
    }
    return wanted;
}

std::vector<std::uint64_t> ordinals_of(const SweepTask& task)
{
    std::vector<std::uint64_t> ordinals;
    for (const SweepTask::Row& row : task.rows) {
        ordinals.push_back(row.ordinal);
    }
    return ordinals;
}

} // namespace gnomon::analysis
