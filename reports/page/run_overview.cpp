#include "reports/page/run_overview.hpp"

#include "analysis/causes/cause.hpp"
#include "reports/words/text.hpp"
#include "scene/job/lights/written_key.hpp"
#include "scene/job/sweep_space.hpp"
#include "store/csv/run_csv.hpp"
#include "store/json_values.hpp"
#include "store/run/run_notes.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>

namespace gnomon::reports {

namespace {

constexpr const char* where_measured = "WHERE status = 'done' AND error_rate IS NOT NULL";
constexpr std::size_t most_rows_shown = 10;

/// A cell for people: whole numbers and texts as they are, other numbers to four digits.
std::string short_text(const store::sqlite::ValueView& cell)
{
    const auto* const real = std::get_if<double>(&cell);
    return real == nullptr || *real == std::floor(*real) ? store::cell_text(cell)
                                                         : fmt::format("{:.4g}", *real);
}
std::string short_text(const store::ResultRow& row, const std::string& column)
{
    const std::optional<double> number = row.number(column);
    return number ? short_text(*number) : row.text(column);
}

/// Configurations that differ in biases alone and have the same errors.
struct Tie {
    std::uint64_t ordinal = 0; ///< of the first
    std::uint64_t count = 1;
    std::map<std::string, std::string> ranges = {}; ///< "0.01 to 0.03", of its biases
    std::string mean_error = {};                    ///< empty: that of the first
};

/// Whether the axis says anything of the row's light: those of one light say nothing of others.
bool concerns(const std::string& axis, const store::ResultRow& row)
{
    const std::string light = scene::find_written_key(axis).light;
    return light.empty() || light == row.text(scene::light_distinction);
}

/// "shadow_map.resolution = 2048, bias.constant = 0", after the case.
std::string settings_text(const store::RunDescription& description, const store::ResultRow& row,
                          const Tie& tie)
{
    std::string text;
    const auto add = [&](const std::string& name) {
        const auto range = tie.ranges.find(name);
        const std::string value = range == tie.ranges.end() ? short_text(row, name) : range->second;
        if (!value.empty()) {
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, value);
        }
    };
    add("case");
    for (const std::string& axis : description.axes) {
        if (concerns(axis, row)) {
            add(axis);
        }
    }
    return tie.count == 1 ? text
                          : fmt::format("{} ({})", text, counted(tie.count, "configuration"));
}

std::uint64_t row_index(const store::RunReader& run, std::uint64_t ordinal)
{
    return static_cast<std::uint64_t>(run.database().integer(
        fmt::format("SELECT count(*) FROM part WHERE ordinal < {}", ordinal)));
}

OverviewRow named_row(const store::RunReader& run, store::ResultRow row, const Tie& tie = {})
{
    const std::uint64_t index = row_index(run, row.count("ordinal"));
    std::string settings = settings_text(run.description(), row, tie);
    std::string mean_error =
        tie.mean_error.empty() ? percent(row.number("mean_abs_error")) : tie.mean_error;
    return {index, std::move(settings), std::move(mean_error), std::move(row)};
}

std::vector<std::string> bias_axes(const store::RunDescription& description)
{
    std::vector<std::string> axes;
    std::ranges::copy_if(description.axes, std::back_inserter(axes),
                         [](const std::string& axis) { return axis.starts_with("bias."); });
    return axes;
}

/// SQL for ties: the first ordinal, the count, and of the mean error and each bias the smallest and
/// the largest. With several lights nothing is tied but what amounts to the same job.
/// @param condition  "AND …", of which rows; empty: of all.
std::string tie_query(const store::RunDescription& description, std::string_view condition,
                      std::string_view order, std::size_t most)
{
    std::string ranges = ", min(mean_abs_error), max(mean_abs_error)";
    for (const std::string& axis : bias_axes(description)) {
        ranges += fmt::format(", min({0}), max({0})", store::sqlite::sql_name(axis));
    }
    std::string same = "error_rate, false_shadow, false_lit, map_bytes, \"case\"";
    for (const std::string& axis : description.axes) {
        same += axis.starts_with("bias.") ? std::string{} : ", " + store::sqlite::sql_name(axis);
    }
    if (!description.lights.empty()) { // whatever the axes of other lights say
        same = fmt::format("error_rate, \"case\", {}, id",
                           store::sqlite::sql_name(scene::light_distinction));
    }
    return fmt::format("SELECT min(ordinal), {}{} FROM results {} {} GROUP BY {} ORDER BY {}"
                       " LIMIT {}",
                       description.lights.empty() ? "count(*)" : "1", ranges, where_measured,
                       condition, same, order, most);
}

std::string range_text(const std::string& low, const std::string& high)
{
    return low == high ? low : fmt::format("{} to {}", low, high);
}

std::optional<double> number_at(const store::sqlite::Statement& find, int column)
{
    const store::sqlite::ValueView cell = find.value(column);
    const auto* const real = std::get_if<double>(&cell);
    return real == nullptr ? std::nullopt : std::optional{*real};
}

std::vector<Tie> find_ties(const store::RunReader& run, std::string_view order, std::size_t most,
                           std::string_view condition = {})
{
    const std::vector<std::string> axes = bias_axes(run.description());
    store::sqlite::Statement find{run.database(),
                                  tie_query(run.description(), condition, order, most)};
    std::vector<Tie> ties;
    while (find.step()) {
        Tie tie{static_cast<std::uint64_t>(find.integer(0)),
                static_cast<std::uint64_t>(find.integer(1))};
        tie.mean_error = range_text(percent(number_at(find, 2)), percent(number_at(find, 3)));
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const auto at = static_cast<int>(4 + 2 * i);
            tie.ranges[axes[i]] =
                range_text(short_text(find.value(at)), short_text(find.value(at + 1)));
        }
        ties.push_back(std::move(tie));
    }
    return ties;
}

constexpr std::string_view best_first = "error_rate, map_bytes, min(ordinal)";
constexpr std::string_view worst_first = "error_rate DESC, min(ordinal) DESC";

OverviewRow row_of(const store::RunReader& run, const Tie& tie)
{
    return named_row(
        run, std::move(run.rows(fmt::format("WHERE ordinal = {}", tie.ordinal)).front()), tie);
}

/// Of equal error rates that with the smallest map is first.
std::vector<OverviewRow> ranked_rows(const store::RunReader& run)
{
    std::vector<Tie> ties = find_ties(run, best_first, most_rows_shown);
    if (ties.size() == most_rows_shown) {
        ties.back() = find_ties(run, worst_first, 1).front();
    }
    std::vector<OverviewRow> rows;
    for (const Tie& tie : ties) {
        rows.push_back(row_of(run, tie));
    }
    return rows;
}

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
        text += fmt::format(" T{}.", schema.substr(1)); // a sentence's beginning
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

/// "Light sun: the best has …": what suits one light is no matter to another.
void add_extremes_of_light(std::vector<std::string>& sentences, const store::RunReader& run,
                           const std::string& light)
{
    const std::string condition = fmt::format(
        "AND {} = '{}'", store::sqlite::sql_name(scene::light_distinction), light); // a name
    const auto best = find_ties(run, best_first, 2, condition);
    if (best.empty()) {
        sentences.push_back(fmt::format("Light {}: nothing was measured.", light));
        return;
    }
    const OverviewRow row = row_of(run, best.front());
    if (best.size() == 1) {
        sentences.push_back(fmt::format("Light {} has {}.", light, rates_text(row.result)));
        return;
    }
    const OverviewRow worst = row_of(run, find_ties(run, worst_first, 1, condition).front());
    sentences.push_back(fmt::format(
        "Light {}: the best has {}, with {}; the worst has {}, with {}.", light,
        rates_text(row.result), row.settings, rates_text(worst.result), worst.settings));
}

/// How many bias curves no constant bias serves.
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
                ? fmt::format("In each of {} some constant bias keeps both acne and "
                              "peter-panning below 0.1 % of the scored pixels.",
                              counted(all, "bias curve"))
                : fmt::format("In {} of {} no constant bias keeps both acne and peter-panning "
                              "below 0.1 % of the scored pixels.",
                              grouped(unserved), counted(all, "bias curve")));
    }
}

/// @param whose  what the first begins with: "The best: ".
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

/// How what is said of the headline configuration begins.
std::string headline_words(const store::ResultRow& headline)
{
    const std::string light = headline.text(scene::light_distinction);
    return light.empty() ? "The best: " : fmt::format("The best, of light {}: ", light);
}

/// The scene's name, where all configurations share it; of another renderer's case the case's own.
std::string common_scene(const store::RunReader& run)
{
    // A case's mesh is no name; what a renderer was told to draw is that of its job.
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

} // namespace

RunOverview read_overview(const store::RunReader& run)
{
    RunOverview overview;
    overview.scene = common_scene(run);
    overview.notes = store::note_sentences(run.description());
    overview.rows = ranked_rows(run);
    const store::PlanOutcome& outcome = run.outcome();
    overview.failed_count = outcome.failed;
    if (outcome.failed > 0) {
        for (store::ResultRow& row : run.rows(fmt::format(
                 "WHERE status = 'failed' ORDER BY ordinal LIMIT {}", most_rows_shown))) {
            overview.failed.push_back(named_row(run, std::move(row)));
        }
    }
    const bool is_one = outcome.done == 1 && run.description().size == 1;
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
        const auto& lights = run.description().lights;
        for (const std::string& light : lights) {
            add_extremes_of_light(overview.sentences, run, light);
        }
        if (lights.empty()) {
            add_extremes(overview.sentences, overview.rows);
        }
        add_curve_verdict(overview.sentences, run);
    }
    add_findings(overview.sentences, overview.detail,
                 is_one ? std::string{} : headline_words(overview.headline->result));
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
