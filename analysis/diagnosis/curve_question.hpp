#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// What is asked of one bias curve.
struct CurveQuestion {
    struct Row {
        std::uint64_t ordinal = 0;
        float bias = 0;
    };
    std::string id;
    float slope = 0;    ///< depth units per unit of tan θ
    float job_bias = 0; ///< of the job without its axes: one of the error profiles
    std::vector<Row> rows;
};

} // namespace gnomon::analysis
