#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/diagnosis/lookup_answers.hpp"
#include "analysis/rays/light_query_cache.hpp"
#include "analysis/rays/scored_receivers.hpp"
#include "analysis/sweep/stage_keys.hpp"
#include "analysis/sweep/sweep_task.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// A scene that both renderers have loaded, and what results say of it.
struct ReadScene {
    OpenScene open;
    SceneSummary summary;
};

/// A camera's receivers before a light, what is true of them, and what follows from both.
struct SweepSubject {
    scene::ReceiverLayers receivers;
    scene::Truth truth;
    ScoredReceivers judged;

    SweepSubject(scene::ReceiverLayers seen, scene::Truth found, const ReceiverUse& use)
        : receivers{std::move(seen)},
          truth{std::move(found)},
          judged{receivers, truth, use}
    {
    }
};

/// What exact rays say of the cameras that are kept side by side, the last cache of each: maps that
/// differ in depth format only come one after the other. Several threads may find caches, each of
/// other slots.
class LightQueryCaches {
public:
    explicit LightQueryCaches(std::size_t slots) : caches_(slots) {}

    template <typename Make>
    std::shared_ptr<LightQueryCache> find(std::size_t slot, const std::string& key,
                                          const Make& make)
    {
        auto& [known, cache] = caches_[slot];
        if (cache == nullptr || known != key) {
            cache.reset(); // before the next one takes memory
            cache = make();
            known = key;
        }
        return cache;
    }

private:
    std::vector<std::pair<std::string, std::shared_ptr<LightQueryCache>>> caches_;
};

/// The answers of one lookup, made by the background when they are first needed.
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
