#include "cli/renderer/tune/tune_renderer.hpp"

#include "cli/renderer/driven_job.hpp"
#include "cli/renderer/tune/engine_search.hpp"
#include "cli/system/standard_output.hpp"
#include "scene/error.hpp"
#include "scene/job/handed_key.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

/// What a setting of the engine gives.
struct EngineOutcome {
    EngineValues values;
    double shadow_amount = 0; ///< [px]
    double light_amount = 0;  ///< [px]
    std::uint64_t false_shadow = 0;
    std::uint64_t false_lit = 0;
    std::string refusal = {}; ///< why it was not drawn; empty: it was

    [[nodiscard]] double amount() const { return shadow_amount + light_amount; }
    friend bool operator==(const EngineOutcome&, const EngineOutcome&) = default;
};

std::string engine_toml(const EngineValues& values, std::string_view separator)
{
    std::string text;
    for (const auto& [name, value] : values) {
        text +=
            fmt::format("{}{} = {}", text.empty() ? "" : separator, name, scene::to_toml(value));
    }
    return text;
}

std::string outcome_words(const EngineOutcome& outcome)
{
    return outcome.refusal.empty()
               ? fmt::format("{:.1f} px of shadow on lit ground, {:.1f} px of light in shadow; "
                             "{} false shadow, {} false lit",
                             outcome.shadow_amount, outcome.light_amount, outcome.false_shadow,
                             outcome.false_lit)
               : outcome.refusal;
}

/// One renderer's tries at one job.
class EngineTuning {
public:
    EngineTuning(const RendererTuneOptions& options, RendererSession& session, scene::Job job,
                 std::vector<std::string> given)
        : options_{options},
          session_{session},
          job_{std::move(job)},
          given_{std::move(given)}
    {
    }

    /// The keys that the job leaves open.
    [[nodiscard]] std::vector<EngineKey> open_keys() const
    {
        std::vector<EngineKey> keys;
        for (const EngineKey& key : session_.hello().keys) {
            if (std::ranges::find(given_, "engine." + key.name) == given_.end()) {
                keys.push_back(key);
            }
        }
        return keys;
    }

    [[nodiscard]] const std::vector<EngineOutcome>& tried() const { return tried_; }
    [[nodiscard]] EngineValues own_values() const { return engine_values(job_); }

    /// @throws RendererFailure, RendererRefusal  as `RendererSession::compare`.
    EngineOutcome draw(const EngineValues& values)
    {
        scene::Job job = job_;
        for (const auto& [name, value] : values) {
            job.method.values["engine." + name] = value;
        }
        const analysis::Metrics metrics = session_.compare(job, given_).metrics;
        return {values, metrics.amounts.shadow, metrics.amounts.light, metrics.false_shadow,
                metrics.false_lit};
    }

    std::optional<double> measure(const EngineValues& values)
    {
        EngineOutcome outcome{values};
        try {
            outcome = draw(values);
        } catch (const RendererFailure& error) {
            if (tried_.empty() || session_.failed_to_start()) {
                throw;
            }
            outcome.refusal = error.what();
        } catch (const RendererRefusal& error) {
            if (tried_.empty()) {
                throw;
            }
            outcome.refusal = error.what();
        }
        tried_.push_back(outcome);
        tell(outcome);
        return outcome.refusal.empty() ? std::optional{outcome.amount()} : std::nullopt;
    }

private:
    void tell(const EngineOutcome& outcome)
    {
        const bool is_better = outcome.refusal.empty() && (!least_ || outcome.amount() < *least_);
        if (is_better) {
            least_ = outcome.amount();
        }
        if (!options_.is_quiet && (options_.is_verbose || is_better)) {
            fmt::print(stderr, "gnomon tune: {}: {}\n", engine_toml(outcome.values, ", "),
                       outcome_words(outcome));
        }
    }

    const RendererTuneOptions& options_;
    RendererSession& session_;
    scene::Job job_;
    std::vector<std::string> given_;
    std::vector<EngineOutcome> tried_;
    std::optional<double> least_; ///< amount so far
};

AnswerJson outcome_json(const EngineOutcome& outcome)
{
    AnswerJson json{{"engine", AnswerJson::object()}};
    for (const auto& [name, value] : outcome.values) {
        json["engine"][name] = to_json(value);
    }
    if (!outcome.refusal.empty()) {
        json["message"] = outcome.refusal;
        return json;
    }
    json["shadow_amount"] = outcome.shadow_amount;
    json["light_amount"] = outcome.light_amount;
    json["false_shadow"] = outcome.false_shadow;
    json["false_lit"] = outcome.false_lit;
    return json;
}

/// What was found, beside what the job had.
struct TunedEngine {
    std::string renderer;
    EngineOutcome own;   ///< the job's own settings
    EngineOutcome found; ///< drawn once more
    bool is_exhausted = false;
};

std::string tuned_json(const TunedEngine& tuned, const std::vector<EngineOutcome>& tried)
{
    AnswerJson json{{"schema", 1},
                    {"renderer", tuned.renderer},
                    {"own", outcome_json(tuned.own)},
                    {"recommended", outcome_json(tuned.found)},
                    {"toml", fmt::format("[engine]\n{}\n", engine_toml(tuned.found.values, "\n"))},
                    {"budget_exhausted", tuned.is_exhausted},
                    {"tried", AnswerJson::array()}};
    for (const EngineOutcome& outcome : tried) {
        json["tried"].push_back(outcome_json(outcome));
    }
    return json.dump(2, ' ', false, AnswerJson::error_handler_t::replace) + "\n";
}

std::string tuned_text(const TunedEngine& tuned, std::size_t settings, bool is_quiet)
{
    std::string toml = fmt::format("[engine]\n{}\n", engine_toml(tuned.found.values, "\n"));
    if (is_quiet) {
        return toml;
    }
    return fmt::format("{}: {} settings drawn{}\n  as it was: {}\n  best:      {}\n\n{}",
                       tuned.renderer, settings,
                       tuned.is_exhausted ? ", all that --budget allows" : "",
                       outcome_words(tuned.own), outcome_words(tuned.found), toml);
}

} // namespace

void tune_renderer(const RendererTuneOptions& options, RendererCommand command)
{
    RendererSession session{
        renderer_settings(std::move(command), options.renderer, options.threads)};
    const scene::JobSource source = read_driven_job(session, options.job);
    const scene::SweepSpace space = space_of_one(source, options.job.case_name);
    EngineTuning tuning{options, session, space.job(space.at(0)),
                        key_names(space.given_keys(space.at(0)))};
    const std::vector<EngineKey> keys = tuning.open_keys();
    if (keys.empty()) {
        throw scene::InputError(fmt::format(
            "renderer {}: nothing to search: it has no key that the job does not set itself",
            session.hello().name));
    }
    const EngineSearchResult result =
        search_engine(keys, tuning.own_values(), options.budget,
                      [&](const EngineValues& values) { return tuning.measure(values); });
    const std::vector<EngineOutcome>& tried = tuning.tried();
    const auto found = std::ranges::find(tried, result.best, &EngineOutcome::values);
    const TunedEngine tuned{session.hello().title(), tried.front(), tuning.draw(result.best),
                            result.is_exhausted};
    if (!(tuned.found == *found)) {
        throw scene::EnvironmentError(fmt::format(
            "renderer {}: drawn once more, the best setting gives {}; it gave {}: equal requests "
            "must give equal frames",
            session.hello().name, outcome_words(tuned.found), outcome_words(*found)));
    }
    session.close();
    print(options.json ? tuned_json(tuned, tried)
                       : tuned_text(tuned, tried.size(), options.is_quiet));
}

} // namespace gnomon::cli
