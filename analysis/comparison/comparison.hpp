#pragma once

#include "analysis/bias/bias_verification.hpp"
#include "analysis/bias/drawn_offset.hpp"
#include "analysis/causes/precision_kinds.hpp"
#include "analysis/comparison/evaluation.hpp"
#include "analysis/comparison/remedy.hpp"
#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/renderers.hpp"
#include "analysis/results/results.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/load/scene_notes.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// Wall time of each stage [s].
struct StageSeconds {
    double scene = 0; ///< reading or generating the scene, hashing it, resolving the view
    double bvh = 0;   ///< building the ray-tracing hierarchy
    double receivers = 0;
    double shadow_map = 0;
    double lookup = 0;
    double truth = 0;
    double analysis = 0;
};

/// The scene as results describe it.
struct SceneSummary {
    std::string name; ///< `scene_name`
    std::uint64_t triangles = 0;
    std::uint64_t objects = 0;
    std::uint64_t dropped_triangles = 0;  ///< zero-area triangles that were removed
    std::uint64_t ignored_primitives = 0; ///< points and lines that the file held
    std::string hash;                     ///< `scene::content_hash`
    std::vector<scene::SceneNote> notes;  ///< about the scene as this job compares it
};

/// The built-in's name, or the file's name without its folder.
[[nodiscard]] std::string scene_name(const scene::SceneSettings& settings);

/// A scene's name, counts and hash; the notes are left empty.
[[nodiscard]] SceneSummary summarise_scene(const scene::SceneSettings& settings,
                                           const scene::TriangleScene& triangles);

/// The views from which advice was derived.
struct AdviceViews {
    struct View {
        std::string name;
        scene::CameraSettings camera;
        scene::LightSettings light;
        ViewOutcome now; ///< with the job unchanged
    };
    std::vector<View> views;     ///< the job's own first; empty without advice
    std::size_t passed_over = 0; ///< number of generated views that showed too little
};

/// The complete result of one configuration.
struct Comparison {
    std::string light; ///< name of the light, if there are several
    scene::Job job;
    scene::View view;             ///< the exact inputs of both renderers
    double target_distance_m = 0; ///< from the camera's eye; 0 if unknown
    SceneSummary scene;
    const scene::TriangleScene* triangles = nullptr; ///< the compared scene; not owned, never null

    scene::ReceiverLayers receivers;
    scene::LookupLayers lookup;
    scene::Truth truth;
    Metrics metrics;
    std::optional<Diagnosis> diagnosis;   ///< empty unless requested
    std::optional<Evaluation> evaluation; ///< set for another renderer's case; empty for GL's own
    /// GL's own lookup, compared with the bias curve; empty without a curve.
    std::optional<BiasVerification::Rerun> held;
    /// Empty unless requested, or if biases cannot be evaluated.
    std::optional<BiasVerification> verification;
    /// For the wrong pixels of cause `precision`; empty unless requested.
    std::optional<PrecisionKinds> precision_kinds;
    /// The effect of the polygon offset at the pixels, if the job's maps have one.
    std::optional<DrawnOffset> drawn_offset;
    std::vector<std::string> light_shells; ///< `objects_around_light`
    std::vector<Remedy> advice;            ///< from reruns of GL; empty unless requested
    AdviceViews advice_views;              ///< the views used for `advice`
    std::vector<Cure> cures; ///< for the causes present, from reruns of GL; empty unless requested
    /// Methods that advice did not try, with reasons; empty unless it was to try methods.
    std::optional<std::vector<PassedOverMethod>> methods_passed_over;
    std::vector<scene::FloatMethodErrors> float_audit; ///< empty unless requested

    std::string truth_method;
    int subpixel_bits = 8;
    Environment environment;
    StageSeconds seconds;
};

/// Starts a comparison without measuring: resolves the job, and adds the scene, its notes and the
/// renderers' environment.
/// @param file  Must outlive the result.
[[nodiscard]] Comparison begin_comparison(const scene::Job& job, const scene::SceneFile& file,
                                          SceneSummary summary, const Renderers& renderers);

/// Fills in the metrics and compares the verdicts with the bias curve. Adds the diagnosis if the
/// reference can trace the light's rays.
/// @param drawn  Map and receivers of its lookups; kept only while needed.
/// @throws std::invalid_argument  if the layers do not have the image's size.
void measure_comparison(Comparison& comparison, renderers::Drawn drawn, const Renderers& renderers,
                        const DiagnosisRequest& request);

/// Measures the comparison, and adds what only kept pixels show: the objects around the light, the
/// origin of `precision` errors, and the effect of the polygon offset.
void measure_fully(Comparison& comparison, renderers::Drawn drawn, const Renderers& renderers,
                   const DiagnosisRequest& request);

/// Repeats GL's lookup at biases that test the comparison's critical biases, including its own and
/// the best one.
/// @param drawn  Map and receivers for the lookups.
/// @return  Empty without critical biases: biases cannot be evaluated, or no diagnosis was
///          requested.
[[nodiscard]] std::optional<BiasVerification> verify_comparison(const Comparison& comparison,
                                                                const renderers::Drawn& drawn,
                                                                const Renderers& renderers);
/// Verifies the comparison after drawing its map and receivers.
[[nodiscard]] std::optional<BiasVerification> verify_comparison(const Comparison& comparison,
                                                                const Renderers& renderers);

/// The measured result of a comparison.
[[nodiscard]] ConfigurationResult result_of(const Comparison& comparison);
[[nodiscard]] std::vector<ConfigurationResult> results_of(std::span<const Comparison> comparisons);

/// A configuration's row and curve from its own comparison. The curve comes from the diagnosis; it
/// is empty if another renderer's comparison has none.
/// @throws std::invalid_argument  if a comparison of GL's own has no diagnosis.
[[nodiscard]] FinishedCurve finish_compared(const Comparison& comparison, std::string curve,
                                            std::uint64_t ordinal);

} // namespace gnomon::analysis
