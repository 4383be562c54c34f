#include "cli/tune/tune_renderer.hpp"

#include "cli/exit_codes.hpp"
#include "cli/renderer/driven_renderer.hpp"
#include "cli/system/process.hpp"
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

/// The largest relative change of the scored, lit and blocked pixels against the job's own frame.
constexpr double same_view = 0.01;

/// The errors with one setting of the engine.
struct EngineOutcome {
    EngineValues values;
    double shadow_amount = 0; ///< [px]
    double light_amount = 0;  ///< [px]
    std::uint64_t false_shadow = 0;
    std::uint64_t false_lit = 0;
    std::uint64_t lit = 0;     ///< scored
    std::uint64_t blocked = 0; ///< scored
    std::size_t frame = 0;     ///< a hash of all verdicts and classes
    std::string refusal = {};  ///< why it does not count; empty if it counts

    /// The mean of the two amounts as shares of the lit and of the blocked pixels, if there are
    /// any: a small shadow counts as much as the large lit part.
    [[nodiscard]] double error() const
    {
        const double sides = (lit > 0 ? 1.0 : 0.0) + (blocked > 0 ? 1.0 : 0.0);
        const double shadow = lit > 0 ? shadow_amount / static_cast<double>(lit) : 0;
        const double light = blocked > 0 ? light_amount / static_cast<double>(blocked) : 0;
        return sides == 0 ? 0 : (shadow + light) / sides;
    }
    friend bool operator==(const EngineOutcome&, const EngineOutcome&) = default;
};

/// Whether two frames show about as many pixels: an error among fewer pixels is no improvement.
bool shows_the_same(const EngineOutcome& a, const EngineOutcome& b)
{
    const auto is_near = [](std::uint64_t one, std::uint64_t other) {
        const auto [low, high] = std::minmax(one, other);
        return static_cast<double>(high - low) <= same_view * static_cast<double>(one);
    };
    return is_near(a.lit, b.lit) && is_near(a.blocked, b.blocked) &&
           is_near(a.lit + a.blocked, b.lit + b.blocked);
}

/// A hash of all verdicts and classes (FNV-1a).
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

/// Draws one job with many settings of the engine, and keeps the outcomes.
class EngineTuning {
public:
    EngineTuning(const RendererTuneOptions& options, DrivenRenderer& renderer, scene::Job job,
                 std::vector<std::string> given)
        : options_{options},
          renderer_{renderer},
          job_{std::move(job)},
          given_{std::move(given)}
    {
    }

    /// The keys that the job does not set.
    [[nodiscard]] std::vector<EngineKey> open_keys() const
    {
        std::vector<EngineKey> keys;
        for (const EngineKey& key : renderer_.hello().keys) {
            if (std::ranges::find(given_, "engine." + key.name) == given_.end()) {
                keys.push_back(key);
            }
        }
        return keys;
    }

    [[nodiscard]] const std::vector<EngineOutcome>& tried() const { return tried_; }
    /// The settings to start from: the job's own, then with the engine's defaults and with its
    /// documentation's values for the open keys.
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

    /// @throws RendererFailure, RendererRefusal  as `DrivenRenderer::compare`.
    EngineOutcome draw(const EngineValues& values)
    {
        scene::Job job = job_;
        for (const auto& [name, value] : values) {
            job.method.values["engine." + name] = value;
        }
        const analysis::Comparison comparison = renderer_.compare(job, given_);
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
                    "it changes what is seen: {} lit and {} blocked pixels instead of {} and {}",
                    outcome.lit, outcome.blocked, tried_.front().lit, tried_.front().blocked);
            }
        } catch (const RendererFailure& error) {
            if (tried_.empty() || renderer_.failed_to_start()) {
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
        report(outcome);
        return {outcome.refusal.empty() ? std::optional{outcome.error()} : std::nullopt,
                outcome.frame, changes_view};
    }

    /// The outcome with these values; nullptr if they were not drawn.
    [[nodiscard]] const EngineOutcome* find(const EngineValues& values) const
    {
        const auto found = std::ranges::find(tried_, values, &EngineOutcome::values);
        return found == tried_.end() ? nullptr : &*found;
    }

private:
    void report(const EngineOutcome& outcome)
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
    DrivenRenderer& renderer_;
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

/// The best setting, and those to compare it with.
struct TunedEngine {
    std::string renderer;
    EngineOutcome own;                       ///< the job's own settings
    std::optional<EngineOutcome> documented; ///< empty if there is none, or the budget ended
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

/// Draws the best setting once more.
/// @throws scene::EnvironmentError  if the frame differs.
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

/// Without lit pixels no acne can show, so a setting without shadows would look best.
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
    DrivenRenderer renderer{
        renderer_settings(std::move(command), options.renderer, options.threads)};
    const scene::JobSource source = read_driven_job(renderer, options.job);
    const scene::SweepSpace space = space_of_one(source, options.job.case_name);
    EngineTuning tuning{options, renderer, space.job(space.at(0)),
                        key_names(space.given_keys(space.at(0)))};
    const std::vector<EngineKey> keys = tuning.open_keys();
    const std::string& name = renderer.hello().name;
    if (keys.empty()) {
        throw scene::InputError(
            fmt::format("renderer {}: nothing to search: the job sets all of its keys", name));
    }
    const scene::LightType light =
        scene::resolve_light(tuning.job(), renderer.load(tuning.job()).defaults).type;
    const EngineValues documented = documented_values(description, light, renderer.hello().keys);
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
    const TunedEngine tuned{renderer.hello().title(),
                            tried.front(),
                            advised == nullptr ? std::nullopt : std::optional{*advised},
                            drawn_again(tuning, *tuning.find(result.best), name),
                            result.is_exhausted,
                            result.dropped};
    renderer.close();
    print(options.json ? tuned_json(tuned, tried)
                       : tuned_text(tuned, tried.size(), options.is_quiet));
}

} // namespace gnomon::cli
