#pragma once

#include "analysis/bias/bias_curve.hpp"
#include "analysis/bias/bias_verification.hpp"
#include "analysis/causes/cause.hpp"
#include "analysis/limits/bias_limits.hpp"
#include "analysis/metrics/breakdown.hpp"
#include "analysis/metrics/error_buckets.hpp"
#include "analysis/metrics/map_facts.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/metrics/peter_panning_gaps.hpp"
#include "analysis/metrics/softening.hpp"
#include "analysis/recommendation/recommendation.hpp"
#include "scene/job/keys/key_table.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// Counts up when results of the same job change their meaning: part of every id.
inline constexpr int result_schema = 2;

/// A configuration of a sweep: one row of its results, known before anything is computed.
struct Configuration {
    std::uint64_t ordinal = 0; ///< its place in the sweep, from 0: the order of the rows
    /// Hash of scene content, of the camera and light that are taken from the scene's file, of
    /// parameters, schema and program version, as 16 hexadecimal digits: the same wherever and
    /// whenever it is computed.
    std::string id;
    /// Like `id`, of everything but the constant bias: the name of its bias curve.
    std::string curve;
    std::string case_name;   ///< of the job file's [[case]]; empty without cases
    std::string scene_hash;  ///< `scene::content_hash`; empty where the scene could not be read
    std::uint32_t shard = 1; ///< which part of a divided sweep computes it, from 1
    /// The constant bias that the job has but for the sweep's axes, as text: which errors by
    /// distance are asked of its curve. Empty without a curve.
    std::string job_bias;
    /// The job with every key written out, as `scene::resolved_keys` gives it.
    std::vector<std::pair<std::string, std::string>> parameters;
    /// With several lights its own as `light`, and the values of the axes that are of one light
    /// alone, "lights.sun.bias.slope", whichever it is; of another renderer its own keys,
    /// "engine.radius". As TOML.
    std::vector<std::pair<std::string, std::string>> light_values = {};
};

/// What was measured of one configuration.
struct ConfigurationResult {
    Metrics metrics;
    std::optional<CauseCounts> causes; ///< empty: not asked for (float truth)
    CauseAmounts amounts;              ///< of the same
    Gaps peter_panning;
    /// By object and light distance, sorted so; empty: not known, or too many.
    std::vector<ErrorBucket> cells = {};
    std::vector<MapResult> by_map = {}; ///< empty: the light has but one map, or causes are unknown
};

/// Whether a configuration that failed may pass when it is tried again, everything else as it was.
enum class Retry : std::uint8_t {
    may_help,
    is_useless, ///< its keys do not go together, or mean nothing in its scene
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

/// What the configurations that differ in nothing but the constant bias have in common.
struct CurveResult {
    std::string id;               ///< `Configuration::curve`
    std::optional<double> near_m; ///< of the map, as fitted; empty: another renderer's, not known
    std::optional<double> far_m;
    std::optional<std::uint64_t> map_bytes;
    /// Empty where nothing knows every bias.
    std::optional<BestBiases> best;
    std::optional<BiasBounds> bounds;
    std::optional<PeterPanningLimit> peter_panning; ///< empty where nothing knows every bias
    std::optional<Recommendation> recommended;      ///< empty too if no scored pixel is lit
    /// What is softened with a constant bias of 0: the most that is left out of an error. Empty
    /// where verdicts are no fractions.
    std::optional<Softening> softening_at_zero;
    std::vector<CurveSample> points;  ///< at its `sample_biases`, or where amounts are sampled
    bool amounts_are_sampled = false; ///< known at the points alone, each from a lookup of its own
    std::vector<DistanceProfile> by_distance;
    std::optional<BiasVerification> verification; ///< empty: not asked for, or without a curve
};

/// A finished curve, with those of its configurations that the sweep asks for.
struct FinishedCurve {
    struct Row {
        std::uint64_t ordinal = 0;
        ConfigurationResult result;
    };
    CurveResult curve;
    std::vector<Row> rows;
};

} // namespace gnomon::analysis
