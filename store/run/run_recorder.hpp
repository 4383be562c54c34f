#pragma once

#include "analysis/results/results.hpp"
#include "store/sqlite.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace gnomon::store {

/// Writes results into a run's database; keeps its prepared statements.
class RunRecorder {
public:
    explicit RunRecorder(const sqlite::Database& database);

    /// Implements `RunStore::record`.
    /// @param environment  number of the environment of the results.
    void record(const analysis::FinishedCurve& curve, std::int64_t environment);

    /// Implements `RunStore::record_failure`.
    void record_failure(std::span<const std::uint64_t> ordinals, const std::string& message,
                        analysis::Retry retry);

private:
    void write_curve(const analysis::FinishedCurve& curve, std::int64_t number,
                     std::int64_t environment);
    void write_points(const analysis::CurveResult& curve, std::int64_t number);
    void write_bins(const analysis::FinishedCurve& curve, std::int64_t number,
                    std::int64_t environment);
    [[nodiscard]] std::string job_bias_of(const analysis::FinishedCurve::Row& row);
    void write_verification(const analysis::CurveResult& curve, std::int64_t number,
                            std::int64_t environment);
    void write_row(const analysis::FinishedCurve::Row& row, std::int64_t curve,
                   std::int64_t environment);
    void write_maps(const analysis::FinishedCurve::Row& row);
    [[nodiscard]] std::int64_t configuration_of(std::uint64_t ordinal, std::string_view function);

    const sqlite::Database* database_;
    sqlite::Statement find_curve_;
    sqlite::Statement update_curve_;
    sqlite::Statement delete_points_;
    sqlite::Statement insert_point_;
    sqlite::Statement find_job_bias_;
    sqlite::Statement delete_bins_;
    sqlite::Statement insert_bin_;
    sqlite::Statement delete_verification_;
    sqlite::Statement insert_verification_;
    sqlite::Statement update_configuration_;
    sqlite::Statement delete_maps_;
    sqlite::Statement insert_map_;
    sqlite::Statement find_configuration_;
    sqlite::Statement fail_configuration_;
};

} // namespace gnomon::store
