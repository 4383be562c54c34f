#include "reports/page/run_overview.hpp"

#include "analysis/causes/cause.hpp"
#include "reports/text/text.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "store/json_values.hpp"
#include "store/run/run_record.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace gnomon::reports {

namespace {

std::string rates_text(const store::ResultRow& row)
{
    return fmt::format("{} of the scored pixels wrong: {} false shadow, {} false lit",
                       percent(row.number("error_rate")), grouped(row.count("false_shadow")),
                       grouped(row.count("false_lit")));
}

std::string completeness(const store::RunReader& run)
{
    const store::PlanOutcome& outcome = run.outcome();
    const store::Shard shard = run.description().shard;
    const std::uint64_t all = outcome.done + outcome.failed + outcome.planned;
    std::string text =
        shard.count == 1
            ? std::string{}
            : fmt::format(
                  "This is part {} of {} of a sweep of {}; `gnomon merge` joins the parts. ",
                  shard.index, shard.count, counted(run.description().size, "configuration"));
    text += fmt::format("{} of {} measured", grouped(outcome.done), counted(all, "configuration"));
    if (outcome.failed > 0) {
        text += fmt::format(", {} failed", grouped(outcome.failed));
    }
    if (outcome.planned > 0) {
        text += fmt::format(", {} not computed yet", grouped(outcome.planned));
    }
    text += ".";
    if (const std::string schema = store::schema_text(run.schema()); !schema.empty()) {
        text += fmt::format(" T{}.", schema.substr(1)); // starts a sentence
    }
    return text;
}

void add_extremes(std::vector<std::string>& sentences, const std::vector<OverviewRow>& rows)
{
    const OverviewRow& best = rows.front();
    const OverviewRow& worst = rows.back();
    if (rows.size() == 1) {
        sentences.push_back(fmt::format("The one that was measured has {}, with {}.",
                                        rates_text(best.result), best.settings));
        return;
    }
    sentences.push_back(
        fmt::format("The best has {}, with {}.", rates_text(best.result), best.settings));
    sentences.push_back(
        fmt::format("The worst has {}, with {}.", rates_text(worst.result), worst.settings));
}

/// Adds "Light sun: the best has …" for one light or case.
/// @param subject    "Light sun".
/// @param condition  "AND …", which selects its rows.
void add_extremes_of(std::vector<std::string>& sentences, const store::RunReader& run,
                     const std::string& subject, const std::string& condition)
{
    const std::vector<OverviewRow> ends = best_and_worst(run, condition);
    if (ends.empty()) {
        sentences.push_back(fmt::format("{}: nothing was measured.", subject));
        return;
    }
    const OverviewRow& best = ends.front();
    const OverviewRow& worst = ends.back();
    if (ends.size() == 1) {
        sentences.push_back(fmt::format("{} has {}.", subject, rates_text(best.result)));
        return;
    }
    sentences.push_back(fmt::format("{}: the best has {}, with {}; the worst has {}, with {}.",
                                    subject, rates_text(best.result), best.settings,
                                    rates_text(worst.result), worst.settings));
}

/// Adds the extremes of each light or case, or those of all rows.
void add_all_extremes(std::vector<std::string>& sentences, const store::RunReader& run,
                      const std::vector<OverviewRow>& rows, const std::vector<std::string>& cases)
{
    const auto& lights = run.description().lights;
    const auto add_light = [&](const std::string& light, const std::string& name,
                               const std::string& condition) {
        add_extremes_of(sentences, run, fmt::format("Light {}{}", light, name),
                        of_light(light) + " " + condition);
    };
    if (cases.size() < 2) {
        for (const std::string& light : lights) {
            add_light(light, "", "");
        }
        if (lights.empty()) {
            add_extremes(sentences, rows);
        }
        return;
    }
    for (std::size_t i = 0; i < std::min(cases.size(), most_rows_shown); ++i) {
        for (const std::string& light : lights) {
            add_light(light, " of case " + cases[i], of_case(cases[i]));
        }
        if (lights.empty()) {
            add_extremes_of(sentences, run, "Case " + cases[i], of_case(cases[i]));
        }
    }
    if (cases.size() > most_rows_shown) {
        sentences.push_back(fmt::format("So far {}; the table of all configurations has {} more.",
                                        counted(most_rows_shown, "case"),
                                        grouped(cases.size() - most_rows_shown)));
    }
}

/// Adds how many bias curves have no constant bias that serves.
void add_curve_verdict(std::vector<std::string>& sentences, const store::RunReader& run)
{
    const auto curves = [&](std::string_view condition) {
        return static_cast<std::uint64_t>(run.database().integer(
            fmt::format("SELECT count(DISTINCT curve) FROM results WHERE status = 'done' AND"
                        " \"bias_curve.no_constant_bias_serves\" {}",
                        condition)));
    };
    const std::uint64_t all = curves("IS NOT NULL");
    const std::uint64_t unserved = curves("= 'true'");
    if (all > 0) {
        sentences.push_back(
            unserved == 0
                ? fmt::format("In each of {} some constant bias keeps both acne and false light "
                              "below 0.1 % of the scored pixels.",
                              counted(all, "bias curve"))
                : fmt::format("In {} of {} no constant bias keeps both acne and false light below "
                              "0.1 % of the scored pixels.",
                              grouped(unserved), counted(all, "bias curve")));
    }
}

/// @param whose  The beginning of the first sentence: "The best: ".
void add_findings(std::vector<std::string>& sentences, const store::Json& detail,
                  const std::string& whose)
{
    const store::Json* const findings =
        detail.is_object() && detail.contains("findings") ? &detail["findings"] : nullptr;
    if (findings == nullptr || !findings->is_array()) {
        return;
    }
    bool is_first = true;
    for (const store::Json& finding : *findings) {
        if (finding.is_string()) {
            const auto& words = finding.get_ref<const std::string&>();
            sentences.push_back(is_first ? whose + words : words);
            is_first = false;
        }
    }
}

/// The beginning of the sentences about the headline configuration.
std::string headline_text(const RunOverview& overview)
{
    const store::ResultRow& headline = overview.headline->result;
    const std::string light = headline.text(scene::light_distinction);
    if (overview.is_of_lights) {
        return fmt::format("Light {}: ", light);
    }
    const std::string of_case =
        overview.has_cases ? fmt::format(" of case {}", headline.text("case")) : std::string{};
    return light.empty() ? fmt::format("The best{}: ", of_case)
                         : fmt::format("The best{}, of light {}: ", of_case, light);
}

/// The scene's name if all configurations share it; for another renderer's case, the case's name.
std::string common_scene(const store::RunReader& run)
{
    // A case's mesh has no useful name.
    if (run.description().command.starts_with("gnomon evaluate ")) {
        store::sqlite::Statement find{run.database(),
                                      "SELECT DISTINCT \"case\" FROM results LIMIT 2"};
        std::string name = find.step() ? find.text(0) : std::string{};
        return find.step() ? std::string{} : name;
    }
    store::sqlite::Statement find{
        run.database(), "SELECT DISTINCT \"scene.builtin\", \"scene.file\" FROM results LIMIT 2"};
    if (!find.step()) {
        return {};
    }
    const std::string builtin = find.text(0);
    const std::string file = std::filesystem::path{find.text(1)}.filename().string();
    return find.step() ? std::string{} : builtin + file; // a job has one of them
}

/// The unit of the run's lengths, as `length_unit` returns it.
std::string_view unit_of(const store::RunReader& run)
{
    if (run.description().command.starts_with("gnomon evaluate ")) {
        return "m"; // a case gives its unit
    }
    store::sqlite::Statement find{
        run.database(), "SELECT 1 FROM results WHERE coalesce(\"scene.file\", '') = '' OR "
                        "\"scene.unit_m\" IS NOT NULL LIMIT 1"};
    return find.step() ? "m" : "units";
}

std::vector<KindColumns> named_columns(std::string_view kind, const auto& names)
{
    std::vector<KindColumns> columns;
    for (std::size_t i = 1; i < names.size(); ++i) { // the first is "none"
        std::string words{names[i]};
        std::replace(words.begin(), words.end(), '_', '-');
        columns.push_back({fmt::format("{}s.{}", kind, names[i]),
                           fmt::format("{}_amounts.{}", kind, names[i]), std::move(words)});
    }
    return columns;
}

void add_rows(RunOverview& overview, const store::RunReader& run,
              const std::vector<std::string>& cases)
{
    if (!overview.has_cases) {
        overview.rows = ranked_rows(run);
        if (overview.is_of_lights) {
            std::ranges::reverse(overview.rows);
        }
        return;
    }
    for (std::size_t i = 0; i < std::min(cases.size(), most_rows_shown); ++i) {
        std::vector<OverviewRow> ends = best_and_worst(run, of_case(cases[i]));
        if (!ends.empty()) {
            overview.worst.push_back(ends.back());
            overview.rows.push_back(std::move(ends.front()));
        }
    }
}

} // namespace

RunOverview read_overview(const store::RunReader& run)
{
    RunOverview overview;
    overview.scene = common_scene(run);
    overview.notes = store::note_sentences(run.description());
    overview.length_unit = unit_of(run);
    const std::vector<std::string> cases = measured_cases(run);
    overview.has_cases = cases.size() > 1;
    const std::size_t lights = run.description().lights.size();
    overview.is_of_lights = lights > 1 && run.description().size == lights;
    add_rows(overview, run, cases);
    const store::PlanOutcome& outcome = run.outcome();
    overview.failed_count = outcome.failed;
    if (outcome.failed > 0) {
        for (store::ResultRow& row : run.rows(fmt::format(
                 "WHERE status = 'failed' ORDER BY ordinal LIMIT {}", most_rows_shown))) {
            overview.failed.push_back(named_row(run, std::move(row)));
        }
    }
    const bool is_one = outcome.done == 1 && run.description().size == 1;
    overview.is_one = is_one;
    if (!is_one) {
        overview.sentences.push_back(completeness(run));
    }
    if (overview.rows.empty()) {
        return overview;
    }
    overview.headline = named_row(run, overview.rows.front().result);
    const std::string id = overview.headline->result.text("id");
    overview.detail = store::find_detail(run.folder(), id);
    if (is_one && overview.detail.is_null()) {
        overview.sentences.push_back(rates_text(overview.headline->result) + ".");
    } else if (!is_one) {
        add_all_extremes(overview.sentences, run, overview.rows, cases);
        add_curve_verdict(overview.sentences, run);
    }
    add_findings(overview.sentences, overview.detail,
                 is_one ? std::string{} : headline_text(overview));
    return overview;
}

const std::vector<KindColumns>& cause_columns()
{
    static const auto columns = named_columns("cause", analysis::cause_names);
    return columns;
}

const std::vector<KindColumns>& label_columns()
{
    static const auto columns = named_columns("label", analysis::label_names);
    return columns;
}

bool has_causes(const store::ResultRow& row)
{
    return row.number(cause_columns().front().count).has_value();
}

bool has_amounts(const store::ResultRow& row)
{
    return std::ranges::any_of(cause_columns(), [&](const KindColumns& kind) {
        const auto amount = row.number(kind.amount);
        return amount && *amount != static_cast<double>(row.count(kind.count));
    });
}

} // namespace gnomon::reports
