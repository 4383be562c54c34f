#include "store/run/run_recorder.hpp"

#include "scene/pixels/pixel_class.hpp"
#include "scene/text.hpp"
#include "store/run/run_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <string_view>
#include <vector>

namespace gnomon::store {

namespace {

using analysis::CurveResult;
using analysis::DistanceProfile;
using analysis::FinishedCurve;
using scene::PixelClass;
using sqlite::Database;
using sqlite::sql_name;
using sqlite::Statement;
using sqlite::Transaction;
using sqlite::Value;

template <typename Columns>
std::string assignments(const Columns& columns)
{
    std::string text;
    for (const auto& column : columns) {
        text += fmt::format(", {} = ?", sql_name(column.name));
    }
    return text;
}

std::string curve_update()
{
    return fmt::format("UPDATE curves SET environment = ?, lit = ?, blocked = ?{}{}"
                       " WHERE number = ?",
                       assignments(map_columns()), assignments(bias_curve_columns()));
}

std::string configuration_update()
{
    return fmt::format("UPDATE configurations SET status = 'done', message = NULL, may_pass = NULL,"
                       " environment = ?{}{} WHERE curve = ?"
                       " AND number = (SELECT configuration FROM plan WHERE ordinal = ?)",
                       assignments(result_columns()), assignments(error_bucket_columns()));
}

/// Inserts a row.
/// @param own  number of values in front of the columns.
template <typename Columns>
std::string insertion(std::string_view table, std::size_t own, const Columns& columns)
{
    std::vector<std::string_view> values(own + columns.size(), "?");
    return fmt::format("INSERT INTO {} VALUES ({})", table, fmt::join(values, ", "));
}

/// Binds a source's columns from parameter `first` on; returns the next free parameter.
template <typename Source>
int bind_columns(Statement& statement, int first, const std::vector<RunColumn<Source>>& columns,
                 const Source& source)
{
    for (const RunColumn<Source>& column : columns) {
        statement.bind(first++, column.value(source));
    }
    return first;
}

std::string_view name_of(DistanceProfile::At at)
{
    return at == DistanceProfile::At::job_bias ? "job_bias" : "best_bias";
}

[[noreturn]] void refuse_ordinal(std::string_view function, std::uint64_t ordinal)
{
    throw std::invalid_argument(
        fmt::format("{}: ordinal {} is not planned, or of another curve", function, ordinal));
}

} // namespace

RunRecorder::RunRecorder(const Database& database)
    : database_{&database},
      find_curve_{database, "SELECT number FROM curves WHERE id = ?"},
      update_curve_{database, curve_update()},
      delete_points_{database, "DELETE FROM curve_points WHERE curve = ?"},
      insert_point_{database, insertion("curve_points", 2, point_columns())},
      find_job_bias_{database, "SELECT job_bias FROM plan WHERE ordinal = ?"},
      delete_bins_{database, "DELETE FROM curve_bins WHERE curve = ?1 AND (job_bias IN ('', ?2) OR"
                             " (SELECT environment FROM curves WHERE number = ?1) <> ?3)"},
      insert_bin_{database, insertion("curve_bins", 5, bin_columns())},
      delete_verification_{database, "DELETE FROM verifications WHERE curve = ?1 AND"
                                     " (SELECT environment FROM curves WHERE number = ?1) <> ?2"},
      insert_verification_{database, "INSERT OR REPLACE INTO verifications VALUES (?, ?, ?, ?)"},
      update_configuration_{database, configuration_update()},
      delete_maps_{database, "DELETE FROM map_errors WHERE configuration = ?"},
      insert_map_{database, insertion("map_errors", 2, map_error_columns())},
      find_configuration_{database, "SELECT configuration FROM plan WHERE ordinal = ?"},
      fail_configuration_{database, "UPDATE configurations SET status = 'failed', message = ?,"
                                    " may_pass = ? WHERE number = ? AND status <> 'done'"}
{
}

void RunRecorder::record(const FinishedCurve& curve, std::int64_t environment)
{
    const auto number = find_curve_.bind(1, std::string_view{curve.curve.id}).first();
    if (!number || curve.rows.empty()) {
        throw std::invalid_argument(fmt::format(
            "RunStore::record: curve {} is not planned, or without rows", curve.curve.id));
    }
    Transaction transaction{*database_};
    write_bins(curve, *number, environment);
    write_verification(curve.curve, *number, environment);
    write_curve(curve, *number, environment);
    write_points(curve.curve, *number);
    for (const FinishedCurve::Row& row : curve.rows) {
        write_row(row, *number, environment);
    }
    transaction.commit();
}

void RunRecorder::write_curve(const FinishedCurve& curve, std::int64_t number,
                              std::int64_t environment)
{
    // Configurations of a curve differ only in the bias, so they share the truth.
    const analysis::ClassCounts& pixels = curve.rows.front().result.metrics.pixels;
    update_curve_.bind(1, environment)
        .bind(2, static_cast<std::int64_t>(pixels.of(PixelClass::lit)))
        .bind(3, static_cast<std::int64_t>(pixels.of(PixelClass::blocked)));
    const int next = bind_columns(update_curve_, 4, map_columns(), curve.curve);
    const int last = bind_columns(update_curve_, next, bias_curve_columns(), curve.curve);
    update_curve_.bind(last, number).run();
}

void RunRecorder::write_points(const CurveResult& curve, std::int64_t number)
{
    delete_points_.bind(1, number).run();
    std::int64_t point = 0;
    for (const analysis::CurveSample& at : curve.points) {
        insert_point_.bind(1, number).bind(2, point++);
        bind_columns(insert_point_, 3, point_columns(), at);
        insert_point_.run();
    }
}

/// Bins at the biases of other jobs stay if they come from this environment. Call it before the
/// curve is written, which sets the environment.
void RunRecorder::write_bins(const FinishedCurve& curve, std::int64_t number,
                             std::int64_t environment)
{
    const std::string job_bias = job_bias_of(curve.rows.front());
    delete_bins_.bind(1, number).bind(2, std::string_view{job_bias}).bind(3, environment).run();
    for (const DistanceProfile& profile : curve.curve.by_distance) {
        const bool is_jobs = profile.at == DistanceProfile::At::job_bias;
        insert_bin_.bind(1, number)
            .bind(2, is_jobs ? std::string_view{job_bias} : std::string_view{})
            .bind(3, name_of(profile.at))
            .bind(5, double{profile.bias});
        std::int64_t bin_number = 0;
        for (const analysis::ErrorBin& bin : profile.bins) {
            insert_bin_.bind(4, bin_number++);
            bind_columns(insert_bin_, 6, bin_columns(), bin);
            insert_bin_.run();
        }
    }
}

std::string RunRecorder::job_bias_of(const FinishedCurve::Row& row)
{
    if (!find_job_bias_.bind(1, static_cast<std::int64_t>(row.ordinal)).step()) {
        refuse_ordinal("RunStore::record", row.ordinal);
    }
    std::string job_bias = find_job_bias_.text(0);
    find_job_bias_.reset();
    return job_bias;
}

/// Call it before the curve is written: a verification from another environment is void.
void RunRecorder::write_verification(const CurveResult& curve, std::int64_t number,
                                     std::int64_t environment)
{
    delete_verification_.bind(1, number).bind(2, environment).run();
    if (curve.verification) {
        insert_verification_.bind(1, number)
            .bind(2, static_cast<std::int64_t>(curve.verification->reruns.size()))
            .bind(3, static_cast<std::int64_t>(curve.verification->verdicts()))
            .bind(4, static_cast<std::int64_t>(curve.verification->differences()))
            .run();
    }
}

void RunRecorder::write_row(const FinishedCurve::Row& row, std::int64_t curve,
                            std::int64_t environment)
{
    update_configuration_.bind(1, environment);
    const int parts = bind_columns(update_configuration_, 2, result_columns(), row.result);
    const int next = bind_columns(update_configuration_, parts, error_bucket_columns(), row.result);
    update_configuration_.bind(next, curve)
        .bind(next + 1, static_cast<std::int64_t>(row.ordinal))
        .run();
    if (database_->changes() != 1) {
        refuse_ordinal("RunStore::record", row.ordinal);
    }
    write_maps(row);
}

void RunRecorder::write_maps(const FinishedCurve::Row& row)
{
    if (row.result.by_map.empty()) {
        return;
    }
    const std::int64_t configuration = configuration_of(row.ordinal, "RunStore::record");
    delete_maps_.bind(1, configuration).run();
    std::int64_t index = 0;
    for (const analysis::MapResult& map : row.result.by_map) {
        insert_map_.bind(1, configuration).bind(2, index++);
        bind_columns(insert_map_, 3, map_error_columns(), map);
        insert_map_.run();
    }
}

std::int64_t RunRecorder::configuration_of(std::uint64_t ordinal, std::string_view function)
{
    const auto number = find_configuration_.bind(1, static_cast<std::int64_t>(ordinal)).first();
    if (!number) {
        refuse_ordinal(function, ordinal);
    }
    return *number;
}

void RunRecorder::record_failure(std::span<const std::uint64_t> ordinals,
                                 const std::string& message, analysis::Retry retry)
{
    const std::string line = scene::one_line(message);
    Transaction transaction{*database_};
    for (const std::uint64_t ordinal : ordinals) {
        fail_configuration_.bind(1, std::string_view{line})
            .bind(2, std::int64_t{retry == analysis::Retry::may_help ? 1 : 0})
            .bind(3, configuration_of(ordinal, "RunStore::record_failure"))
            .run();
    }
    transaction.commit();
}

} // namespace gnomon::store
