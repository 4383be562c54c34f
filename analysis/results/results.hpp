#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/bias/bias_verification.hpp"
#include "analysis/causes/cause.hpp"
#include "analysis/limits/bias_limits.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/metrics/error_buckets.hpp"
#include "analysis/metrics/map_results.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/metrics/peter_panning_gaps.hpp"
#include "analysis/metrics/softening.hpp"
#include "analysis/recommendation/recommendation.hpp"
#include "scene/job/keys/key_table.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// Increases when results of the same job change their meaning. Part of every id.
inline constexpr int result_schema = 2;

/// A configuration of a sweep: one row of its results, known before any work.
struct Configuration {
    std::uint64_t ordinal = 0; ///< its place in the sweep, from 0, and in the order of rows
    /// Hash of scene content, camera and light from the scene's file, parameters, schema and
    /// program version, as 16 hexadecimal digits. It does not depend on the machine or the time.
    std::string id;
    /// Like `id`, but without the constant bias: the name of its bias curve.
    std::string curve;
    std::string case_name;   ///< of the job file's [[case]]; empty without cases
    std::string scene_hash;  ///< `scene::content_hash`; empty if the scene could not be read
    std::uint32_t shard = 1; ///< the part of a divided sweep that computes it, from 1
    /// The constant bias of the job without the sweep's axes, as text, for errors by distance.
    /// Empty without a curve.
    std::string job_bias;
    /// The job with every key written out, as `scene::resolved_keys` gives it.
    std::vector<std::pair<std::string, std::string>> parameters;
    /// With several lights, its own as `light`, and the values of axes that belong to one light,
    /// "lights.sun.bias.slope", whichever it is; for another renderer its own keys,
    /// "engine.radius". As TOML.
    std::vector<std::pair<std::string, std::string>> light_values = {};
};

/// The measurements of one configuration.
struct ConfigurationResult {
    Metrics metrics;
    std::optional<CauseCounts> causes; ///< empty: not asked for (float truth)
    CauseAmounts amounts;              ///< as `causes`
    Gaps peter_panning;
    /// Sorted by object and light distance; empty: unknown, or too many.
    std::vector<ErrorBucket> cells = {};
    std::vector<MapResult> by_map = {}; ///< empty: the light has one map, or causes are unknown
};

/// Whether a failed configuration may pass on another try, all else unchanged.
enum class Retry : std::uint8_t {
    may_help,
    is_useless, ///< its keys contradict each other, or mean nothing in its scene
};

/// Errors by light distance with one constant bias.
struct DistanceProfile {
    enum class At : std::uint8_t { job_bias, best_bias };
    At at = At::job_bias;
    float bias = 0; ///< depth units
    std::vector<ErrorBin> bins;
};

/// A point of a bias curve: all scored pixels at one bias.
struct CurveSample {
    float bias = 0; ///< depth units
    SubsetCounts counts;

    friend bool operator==(const CurveSample&, const CurveSample&) = default;
};

/// What configurations share that differ only in the constant bias.
struct CurveResult {
    std::string id;               ///< `Configuration::curve`
    std::optional<double> near_m; ///< of the fitted map; empty if another renderer hides it
    std::optional<double> far_m;
    std::optional<std::uint64_t> map_bytes;
    /// Empty if the errors are not known for every bias.
    std::optional<BestBiases> best;
    std::optional<BiasBounds> bounds;
    std::optional<PeterPanningLimit> peter_panning; ///< empty as `bounds`
    std::optional<Recommendation> recommended;      ///< also empty if no scored pixel is lit
    /// The softening at a constant bias of 0: the largest amount left out of an error. Empty if
    /// verdicts are not fractions.
    std::optional<Softening> softening_at_zero;
    std::vector<CurveSample> points;  ///< at its `sample_biases`, or where amounts are sampled
    bool amounts_are_sampled = false; ///< known only at the points, each from its own lookup
    std::vector<DistanceProfile> by_distance;
    std::optional<BiasVerification> verification; ///< empty: not asked for, or without a curve
};

/// A finished curve, with the configurations on it that the sweep asks for.
struct FinishedCurve {
    struct Row {
        std::uint64_t ordinal = 0;
        ConfigurationResult result;
    };
    CurveResult curve;
    std::vector<Row> rows;
};

/// The sum of several lights' results: every pair of a pixel and a light counts. Rates follow from
/// the summed counts; causes are known if every light's are. Peter-panning lengths, being
/// quantiles, keep only their number; errors by part are left out.
[[nodiscard]] ConfigurationResult total_of(std::span<const ConfigurationResult> results);

} // namespace gnomon::analysis
