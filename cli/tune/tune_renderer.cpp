#include "cli/tune/tune_renderer.hpp"

#include "cli/exit_codes.hpp"
#include "cli/renderer/driven_job.hpp"
#include "cli/system/standard_output.hpp"
#include "cli/tune/documented_values.hpp"
#include "cli/tune/engine_search.hpp"
#include "reports/text/text.hpp"
#include "scene/error.hpp"
#include "scene/view/view.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::cli {
namespace {

/// How far the scored, lit and blocked pixels of a setting may be from the job's own frame.
constexpr double same_view = 0.01;

/// What a setting of the engine gives.
struct EngineOutcome {
    EngineValues values;
    double shadow_amount = 0; ///< [px]
    double light_amount = 0;  ///< [px]
    std::uint64_t false_shadow = 0;
    std::uint64_t false_lit = 0;
    std::uint64_t lit = 0;     ///< scored
    std::uint64_t blocked = 0; ///< the same
    std::size_t frame = 0;     ///< of all verdicts and classes
    std::string refusal = {};  ///< why it does not count; empty: it does

    /// The mean of the two amounts, each as a share of its own pixels, as far as there are any:
    /// what is shadow in a frame counts for half, however little it is.
    [[nodiscard]] double error() const
    {
        const double sides = (lit > 0 ? 1.0 : 0.0) + (blocked > 0 ? 1.0 : 0.0);
        const double shadow = lit > 0 ? shadow_amount / static_cast<double>(lit) : 0;
        const double light = blocked > 0 ? light_amount / static_cast<double>(blocked) : 0;
        return sides == 0 ? 0 : (shadow + light) / sides;
    }
    friend bool operator==(const EngineOutcome&, const EngineOutcome&) = default;
};

/// Whether two frames show as much: else fewer pixels are wrong where fewer are seen.
bool shows_the_same(const EngineOutcome& a, const EngineOutcome& b)
{
    const auto is_near = [](std::uint64_t one, std::uint64_t other) {
        const auto [low, high] = std::minmax(one, other);
        return static_cast<double>(high - low) <= same_view * static_cast<double>(one);
    };
    return is_near(a.lit, b.lit) && is_near(a.blocked, b.blocked) &&
           is_near(a.lit + a.blocked, b.lit + b.blocked);
}

/// A number that tells apart frames whose verdicts or classes differ anywhere (FNV-1a).
std::size_t frame_of(const analysis::Comparison& comparison)
{
    std::uint64_t hash = 14695981039346656037U;
    const auto add = [&](std::uint32_t bits) { hash = (hash ^ bits) * 1099511628211U; };
    for (const scene::LookupSample& sample : comparison.lookup.samples) {
        add(std::bit_cast<std::uint32_t>(sample.verdict));
    }
    for (const scene::PixelClass pixel_class : comparison.truth.pixel_class) {
        add(static_cast<std::uint32_t>(pixel_class));
    }
    return hash;
}

std::string engine_toml(const EngineValues& values, std::string_view separator)
{
    std::string text;
    for (const auto& [name, value] : values) {
        text +=
            fmt::format("{}{} = {}", text.empty() ? "" : separator, name, scene::to_toml(value));
    }
    return text;
}

std::string outcome_text(const EngineOutcome& outcome)
{
    return outcome.refusal.empty()
               ? fmt::format("{:.1f} px of shadow on lit ground, {:.1f} px of light in shadow, in "
                             "the mean {} of each; {} false shadow, {} false lit",
                             outcome.shadow_amount, outcome.light_amount,
                             reports::percent(outcome.error()), outcome.false_shadow,
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
    /// The settings that the search starts from: the job's own, and what the engine's defaults and
    /// its documentation make of the open keys.
    /// @param documented  values of the engine's keys.
    [[nodiscard]] std::vector<EngineValues> known_values(const EngineValues& documented) const
    {
        const EngineValues own = engine_values(job_);
        EngineValues defaults = own;
        EngineValues advised = own;
        for (const EngineKey& key : open_keys()) {
            defaults[key.name] = key.default_value;
            if (const auto found = documented.find(key.name); found != documented.end()) {
                advised[key.name] = found->second;
            }
        }
        return {own, std::move(defaults), std::move(advised)};
    }
    [[nodiscard]] const scene::Job& job() const { return job_; }

    /// @throws RendererFailure, RendererRefusal  as `RendererSession::compare`.
    EngineOutcome draw(const EngineValues& values)
    {
        scene::Job job = job_;
        for (const auto& [name, value] : values) {
            job.method.values["engine." + name] = value;
        }
        const analysis::Comparison comparison = session_.compare(job, given_);
        const analysis::Metrics& metrics = comparison.metrics;
        return {values,
                metrics.amounts.shadow,
                metrics.amounts.light,
                metrics.false_shadow,
                metrics.false_lit,
                metrics.pixels.of(scene::PixelClass::lit),
                metrics.pixels.of(scene::PixelClass::blocked),
                frame_of(comparison)};
    }

    EngineMeasure measure(const EngineValues& values)
    {
        EngineOutcome outcome{values};
        bool changes_view = false;
        try {
            outcome = draw(values);
            changes_view = !tried_.empty() && !shows_the_same(tried_.front(), outcome);
            if (changes_view) {
                outcome.refusal = fmt::format(
                    "it changes what is seen: {} lit and {} blocked pixels, in place of {} and {}",
                    outcome.lit, outcome.blocked, tried_.front().lit, tried_.front().blocked);
            }
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
        return {outcome.refusal.empty() ? std::optional{outcome.error()} : std::nullopt,
                outcome.frame, changes_view};
    }

    /// What was measured with these values; nullptr: nothing.
    [[nodiscard]] const EngineOutcome* find(const EngineValues& values) const
    {
        const auto found = std::ranges::find(tried_, values, &EngineOutcome::values);
        return found == tried_.end() ? nullptr : &*found;
    }

private:
    void tell(const EngineOutcome& outcome)
    {
        const bool is_better = outcome.refusal.empty() && (!least_ || outcome.error() < *least_);
        if (is_better) {
            least_ = outcome.error();
        }
        if (!options_.is_quiet && (options_.is_verbose || is_better)) {
            fmt::print(stderr, "gnomon tune: {}: {}\n", engine_toml(outcome.values, ", "),
                       outcome_text(outcome));
        }
    }

    const RendererTuneOptions& options_;
    RendererSession& session_;
    scene::Job job_;
    std::vector<std::string> given_;
    std::vector<EngineOutcome> tried_;
    std::optional<double> least_; ///< error so far
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
    json["mean_amount_rate"] = outcome.error();
    return json;
}

/// What was found, beside what the job had.
struct TunedEngine {
    std::string renderer;
    EngineOutcome own;                       ///< the job's own settings
    std::optional<EngineOutcome> documented; ///< empty: nothing, or the budget is too small
    EngineOutcome found;                     ///< drawn once more
    bool is_exhausted = false;
    std::vector<DroppedKey> dropped;
};

std::string_view why_dropped(const DroppedKey& key)
{
    return key.changes_view ? "changes what is seen" : "its ends change no pixel";
}

std::string tuned_json(const TunedEngine& tuned, const std::vector<EngineOutcome>& tried)
{
    AnswerJson json{{"schema", 1},
                    {"renderer", tuned.renderer},
                    {"own", outcome_json(tuned.own)},
                    {"documented", nullptr},
                    {"recommended", outcome_json(tuned.found)},
                    {"toml", fmt::format("[engine]\n{}\n", engine_toml(tuned.found.values, "\n"))},
                    {"budget_exhausted", tuned.is_exhausted},
                    {"not_searched", AnswerJson::object()},
                    {"tried", AnswerJson::array()}};
    if (tuned.documented) {
        json["documented"] = outcome_json(*tuned.documented);
    }
    for (const DroppedKey& key : tuned.dropped) {
        json["not_searched"][key.name] = why_dropped(key);
    }
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
    std::string text = fmt::format("{}: {} settings drawn{}\n  as it was:  {}\n", tuned.renderer,
                                   settings, tuned.is_exhausted ? ", all that --budget allows" : "",
                                   outcome_text(tuned.own));
    if (tuned.documented) {
        text += fmt::format("  documented: {}\n", outcome_text(*tuned.documented));
    }
    text += fmt::format("  best:       {}\n", outcome_text(tuned.found));
    for (const DroppedKey& key : tuned.dropped) {
        text += fmt::format("  not searched: {}: {}\n", key.name, why_dropped(key));
    }
    return text + "\n" + toml;
}

/// Draws what was found once more.
/// @throws scene::EnvironmentError  if it is not what it was.
EngineOutcome drawn_again(EngineTuning& tuning, const EngineOutcome& found,
                          const std::string& renderer)
{
    EngineOutcome again = tuning.draw(found.values);
    if (!(again == found)) {
        throw scene::EnvironmentError(fmt::format(
            "renderer {}: drawn once more, the best setting gives {}; it gave {}: equal requests "
            "must give equal frames",
            renderer, outcome_text(again), outcome_text(found)));
    }
    return again;
}

/// Without a lit pixel no acne shows, and what casts no shadow at all looks best.
void require_lit(const EngineOutcome& own)
{
    if (own.lit == 0) {
        print("Nothing is recommended: no scored pixel of this view is lit, so acne cannot show "
              "and any bias looks right. Aim the camera at lit surfaces.\n");
        throw CLI::RuntimeError{exit_codes::negative};
    }
}

} // namespace

void tune_renderer(const RendererTuneOptions& options, RendererCommand command)
{
    const std::filesystem::path description = command.description;
    RendererSession session{
        renderer_settings(std::move(command), options.renderer, options.threads)};
    const scene::JobSource source = read_driven_job(session, options.job);
    const scene::SweepSpace space = space_of_one(source, options.job.case_name);
    EngineTuning tuning{options, session, space.job(space.at(0)),
                        key_names(space.given_keys(space.at(0)))};
    const std::vector<EngineKey> keys = tuning.open_keys();
    const std::string& name = session.hello().name;
    if (keys.empty()) {
        throw scene::InputError(fmt::format(
            "renderer {}: nothing to search: it has no key that the job does not set itself",
            name));
    }
    const scene::LightType light =
        scene::resolve_light(tuning.job(), session.load(tuning.job()).defaults).type;
    const EngineValues documented = documented_values(description, light, session.hello().keys);
    const std::vector<EngineValues> known = tuning.known_values(documented);
    const EngineSearchResult result =
        search_engine(keys, known, options.budget, [&](const EngineValues& values) {
            const EngineMeasure measure = tuning.measure(values);
            require_lit(tuning.tried().front());
            return measure;
        });
    const std::vector<EngineOutcome>& tried = tuning.tried();
    const EngineOutcome* const advised =
        known.back() == known.front() ? nullptr : tuning.find(known.back());
    const TunedEngine tuned{session.hello().title(),
                            tried.front(),
                            advised == nullptr ? std::nullopt : std::optional{*advised},
                            drawn_again(tuning, *tuning.find(result.best), name),
                            result.is_exhausted,
                            result.dropped};
    session.close();
    print(options.json ? tuned_json(tuned, tried)
                       : tuned_text(tuned, tried.size(), options.is_quiet));
}

} // namespace gnomon::cli
