#pragma once

#include "analysis/comparison.hpp"
#include "analysis/sweep/exact_side.hpp"
#include "analysis/sweep/lookup_answers.hpp"
#include "analysis/sweep/runner.hpp"
#include "analysis/sweep/stage_keys.hpp"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::analysis {

/// A scene in both renderers' hands, and what results say of it.
struct ReadScene {
    OpenScene open;
    SceneSummary summary;
};

/// The exact sides of the cameras that are kept side by side, the last of each: maps that differ in
/// depth format only come one after the other. Several threads may find sides, each of other slots.
class ExactSides {
public:
    explicit ExactSides(std::size_t slots) : sides_(slots) {}

    template <typename Make>
    std::shared_ptr<ExactSide> find(std::size_t slot, const std::string& key, const Make& make)
    {
        auto& [known, side] = sides_[slot];
        if (side == nullptr || known != key) {
            side.reset(); // before the next one takes memory
            side = make();
            known = key;
        }
        return side;
    }

private:
    std::vector<std::pair<std::string, std::shared_ptr<ExactSide>>> sides_;
};

/// The answers of one lookup, made by the background when they are first needed.
class LookupWork {
public:
    LookupWork(const ReadScene& scene, std::shared_ptr<SweepSubject> subject, std::size_t slot,
               ExactSides& sides, SweepLookup lookup)
        : scene_{scene},
          subject_{std::move(subject)},
          slot_{slot},
          sides_{sides},
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
        return answers().critical_biases(slope);
    }

private:
    LookupAnswers& answers()
    {
        if (!answers_) {
            auto side = sides_.find(slot_, stage_keys(lookup_.job).exact, [&] {
                return std::make_shared<ExactSide>(scene_.open.file->scene, subject_, lookup_.job,
                                                   lookup_.view, *scene_.open.renderers);
            });
            answers_ = std::make_unique<LookupAnswers>(std::move(side), std::move(lookup_));
        }
        return *answers_;
    }

    const ReadScene& scene_;
    std::shared_ptr<SweepSubject> subject_;
    std::size_t slot_;
    ExactSides& sides_;
    SweepLookup lookup_;
    scene::LightFrustum frustum_ = lookup_.view.frustum;
    std::unique_ptr<LookupAnswers> answers_;
};

} // namespace gnomon::analysis
