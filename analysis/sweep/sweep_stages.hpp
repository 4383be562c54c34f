#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/rays/light_query_cache.hpp"
#include "analysis/rays/scored_receivers.hpp"
#include "analysis/results/results.hpp"
#include "analysis/sweep/stage_keys.hpp"
#include "analysis/sweep/sweep_task.hpp"
#include "scene/error.hpp"

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// The result of a stage, or why it has none.
template <typename Value>
struct StageResult {
    std::shared_ptr<Value> value;
    std::string error; ///< empty: `value` is there
    Retry retry = Retry::may_help;
};

/// Work cannot be done because an earlier stage failed; carries that stage's message.
struct StageFailed : std::runtime_error {
    StageFailed(const std::string& message, Retry again) : std::runtime_error{message}, retry{again}
    {
    }
    Retry retry;
};

/// The stage's value, not null.
/// @throws StageFailed  if it has none.
template <typename Value>
std::shared_ptr<Value> require_result(const StageResult<Value>& result)
{
    if (!result.value) {
        throw StageFailed{result.error.empty() ? "an earlier stage did not run" : result.error,
                          result.retry};
    }
    return result.value;
}

/// Runs a stage; errors of its configurations become its result.
template <typename Value, typename Stage>
StageResult<Value> run_stage(const Stage& stage)
{
    try {
        return {stage(), {}, {}};
    } catch (const StageFailed& error) {
        return {nullptr, error.what(), error.retry};
    } catch (const scene::InputError& error) {
        return {nullptr, error.what(), Retry::is_useless};
    } catch (const scene::EnvironmentError& error) {
        return {nullptr, error.what(), Retry::may_help};
    }
}

/// A scene that both renderers have loaded, and its summary for results.
struct ReadScene {
    OpenScene open;
    SceneSummary summary;
};

/// A camera's receivers for a light, their truth, and data derived from both.
struct SweepSubject {
    scene::ReceiverLayers receivers;
    scene::Truth truth;
    ScoredReceivers scored;

    SweepSubject(scene::ReceiverLayers seen, scene::Truth found, const ReceiverUse& use)
        : receivers{std::move(seen)},
          truth{std::move(found)},
          scored{receivers, truth, use}
    {
    }
};

/// The exact rays' results for the cameras held at once, for each its last cache: maps that differ
/// only in depth format follow each other. Threads may find caches of different slots at the same
/// time.
class LightQueryCaches {
public:
    explicit LightQueryCaches(std::size_t slots) : caches_(slots) {}

    template <typename Make>
    std::shared_ptr<LightQueryCache> find(std::size_t slot, const std::string& key,
                                          const Make& make)
    {
        auto& [known, cache] = caches_[slot];
        if (cache == nullptr || known != key) {
            cache.reset(); // frees memory for the next one
            cache = make();
            known = key;
        }
        return cache;
    }

private:
    std::vector<std::pair<std::string, std::shared_ptr<LightQueryCache>>> caches_;
};

/// The answers of one lookup, made by a background thread on first use.
class LookupStage {
public:
    LookupStage(const ReadScene& scene, std::shared_ptr<ScoredReceivers> receivers,
                std::size_t slot, LightQueryCaches& caches, ObservedLookup lookup)
        : scene_{scene},
          receivers_{std::move(receivers)},
          slot_{slot},
          caches_{caches},
          lookup_{std::move(lookup)}
    {
    }

    [[nodiscard]] const scene::LightFrustum& frustum() const { return frustum_; }

    [[nodiscard]] FinishedCurve answer(const CurveQuestion& question)
    {
        return answers().answer(question);
    }
    [[nodiscard]] scene::Image<float> critical_biases(float slope)
    {
        return answers().causes().critical_biases(slope);
    }

private:
    LookupAnswers& answers()
    {
        if (!answers_) {
            auto exact = caches_.find(slot_, stage_keys(lookup_.job).exact, [&] {
                return std::make_shared<LightQueryCache>(scene_.open.file->scene, receivers_,
                                                         lookup_.job, lookup_.view,
                                                         scene_.open.renderers->reference);
            });
            answers_ = std::make_unique<LookupAnswers>(std::move(exact), std::move(lookup_));
        }
        return *answers_;
    }

    const ReadScene& scene_;
    std::shared_ptr<ScoredReceivers> receivers_;
    std::size_t slot_;
    LightQueryCaches& caches_;
    ObservedLookup lookup_;
    scene::LightFrustum frustum_ = lookup_.view.first_map();
    std::unique_ptr<LookupAnswers> answers_;
};

} // namespace gnomon::analysis
