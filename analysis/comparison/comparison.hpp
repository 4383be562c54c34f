#pragma once

#include "analysis/bias/bias_verification.hpp"
#include "analysis/bias/drawn_offset.hpp"
#include "analysis/causes/precision_kinds.hpp"
#include "analysis/comparison/evaluation.hpp"
#include "analysis/comparison/remedy.hpp"
#include "analysis/diagnosis/diagnosis.hpp"
#include "analysis/metrics/metrics.hpp"
#include "analysis/renderers.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/load/scene_notes.hpp"
#include "scene/pixels/pixel_layers.hpp"
#include "scene/settings/job.hpp"
#include "scene/view/view.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// Wall time of each stage [s].
struct StageSeconds {
    double scene = 0; ///< reading or generating the scene, its hash, resolving the view
    double bvh = 0;   ///< building the ray-tracing hierarchy
    double receivers = 0;
    double shadow_map = 0;
    double lookup = 0;
    double truth = 0;
    double analysis = 0;
};

/// What a result says of its scene.
struct SceneSummary {
    std::string name; ///< `scene_name`
    std::uint64_t triangles = 0;
    std::uint64_t objects = 0;
    std::uint64_t dropped_triangles = 0;  ///< zero-area triangles that were removed
    std::uint64_t ignored_primitives = 0; ///< points and lines that the file held
    std::string hash;                     ///< `scene::content_hash`
    std::vector<scene::SceneNote> notes;  ///< on the scene as this job compares it
};

/// The built-in's name, or the file's name without its folder.
[[nodiscard]] std::string scene_name(const scene::SceneSettings& settings);

/// A scene's name, counts and hash; the notes are left empty.
[[nodiscard]] SceneSummary summarise_scene(const scene::SceneSettings& settings,
                                           const scene::TriangleScene& triangles);

/// The views that advice was made from.
struct AdviceViews {
    struct View {
        std::string name;
        scene::CameraSettings camera;
        scene::LightSettings light;
        ViewOutcome now; ///< with the job as it is
    };
    std::vector<View> views;     ///< the job's own first; empty: no advice was asked for
    std::size_t passed_over = 0; ///< generated ones that showed too little
};

/// One configuration's result: everything that reports show.
struct Comparison {
    std::string light; ///< name of the one of several that it is of; empty: the job has but one
    scene::Job job;
    scene::View view;             ///< the job made concrete: the exact inputs of both renderers
    double target_distance_m = 0; ///< from the camera's eye; 0: not known
    SceneSummary scene;
    const scene::TriangleScene* triangles = nullptr; ///< the scene compared; not owned, never null

    scene::ReceiverLayers receivers;
    scene::LookupLayers lookup;
    scene::Truth truth;
    Metrics metrics;
    std::optional<Diagnosis> diagnosis;   ///< empty: not asked for
    std::optional<Evaluation> evaluation; ///< empty: GL's own; else of another renderer's case
    /// GL's own lookup held to the bias curve; empty without one.
    std::optional<BiasVerification::Rerun> held;
    /// Empty: not asked for, or nothing knows every bias.
    std::optional<BiasVerification> verification;
    /// Of the wrong pixels of cause `precision`; empty: not asked for.
    std::optional<PrecisionKinds> precision_kinds;
    /// Of a job that draws its maps with one, what the polygon offset is at its pixels.
    std::optional<DrawnOffset> drawn_offset;
    std::vector<std::string> light_shells; ///< `objects_around_light`
    std::vector<Remedy> advice;            ///< reruns of GL; empty: not asked for
    AdviceViews advice_views;              ///< what it was made from
    std::vector<Cure> cures; ///< of the causes at hand, by reruns of GL; empty: not asked for
    /// Of the methods that advice was to try; empty: it was to try none.
    std::optional<std::vector<PassedOverMethod>> methods_passed_over;
    std::vector<scene::FloatMethodErrors> float_audit; ///< empty: not asked for

    std::string truth_method;
    int subpixel_bits = 8;
    Environment environment;
    StageSeconds seconds;
};

/// A comparison of which nothing is measured yet: the job made concrete, the scene with its notes,
/// and the renderers' environment.
/// @param file  must outlive it.
[[nodiscard]] Comparison begin_comparison(const scene::Job& job, const scene::SceneFile& file,
                                          SceneSummary summary, const Renderers& renderers);

/// Fills in metrics and, where the reference knows the light's rays, the diagnosis of a comparison
/// whose other members are known, and holds its verdicts to the bias curve.
/// @param drawn  what its lookups were asked of; kept as long as it is asked again.
/// @throws std::invalid_argument  if its layers are not of the image's size.
void measure_comparison(Comparison& comparison, renderers::Drawn drawn, const Renderers& renderers,
                        const DiagnosisRequest& request);

/// The same, and what only kept pixels show: the objects around the light, what the wrong pixels of
/// cause `precision` are made of, what the polygon offset comes to.
void measure_fully(Comparison& comparison, renderers::Drawn drawn, const Renderers& renderers,
                   const DiagnosisRequest& request);

/// Runs GL's lookup again with biases that put the comparison's critical biases to the test, its
/// own and the best one among them.
/// @param drawn  what its lookups are asked of.
/// @return  Empty if there are no critical biases: nothing knows every bias, or no diagnosis was
///          asked for.
[[nodiscard]] std::optional<BiasVerification> verify_comparison(const Comparison& comparison,
                                                                const renderers::Drawn& drawn,
                                                                const Renderers& renderers);
/// The same of what is drawn for it.
[[nodiscard]] std::optional<BiasVerification> verify_comparison(const Comparison& comparison,
                                                                const Renderers& renderers);

} // namespace gnomon::analysis
