#include "reports/page/run_overview.hpp"

#include "analysis/chain/cause.hpp"
#include "reports/page/page_images.hpp"
#include "reports/run/run_columns.hpp"
#include "reports/run/run_notes.hpp"
#include "reports/shell_text.hpp"
#include "reports/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace gnomon::reports {

namespace {

constexpr const char* measured = "WHERE status = 'done' AND error_rate IS NOT NULL";
constexpr std::size_t most_rows_shown = 10;

/// "shadow_map.resolution = 2048, bias.constant = 0", after the case.
std::string settings_text(const RunDescription& description, const ResultRow& row)
{
    std::string text;
    const auto add = [&](std::string_view name, const std::string& value) {
        if (!value.empty()) {
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, value);
        }
    };
    add("case", row.text("case"));
    for (const std::string& axis : description.axes) {
        add(axis, row.text(axis));
    }
    return text;
}

std::uint64_t place_of(const RunReader& run, std::uint64_t ordinal)
{
    return static_cast<std::uint64_t>(run.database().integer(
        fmt::format("SELECT count(*) FROM part WHERE ordinal < {}", ordinal)));
}

std::vector<OverviewRow> named_rows(const RunReader& run, std::vector<ResultRow> found)
{
    std::vector<OverviewRow> rows;
    for (ResultRow& row : found) {
        const std::uint64_t place = place_of(run, row.count("ordinal"));
        std::string settings = settings_text(run.description(), row);
        rows.push_back({place, std::move(settings), std::move(row)});
    }
    return rows;
}

std::vector<OverviewRow> ranked_rows(const RunReader& run)
{
    std::vector<ResultRow> found = run.rows(
        fmt::format("{} ORDER BY error_rate, ordinal LIMIT {}", measured, most_rows_shown));
    const auto worst =
        run.rows(fmt::format("{} ORDER BY error_rate DESC, ordinal DESC LIMIT 1", measured));
    if (!worst.empty() && found.size() == most_rows_shown) {
        found.back() = worst.front();
    }
    return named_rows(run, std::move(found));
}

std::string rates_text(const ResultRow& row)
{
    return fmt::format("{} of the scored pixels wrong: {} false shadow, {} false lit",
                       percent(row.number("error_rate")), grouped(row.count("false_shadow")),
                       grouped(row.count("false_lit")));
}

std::string completeness(const RunReader& run)
{
    const PlanOutcome& outcome = run.outcome();
    const Shard shard = run.description().shard;
    const std::uint64_t all = outcome.done + outcome.failed + outcome.planned;
    std::string text =
        shard.count == 1
            ? std::string{}
            : fmt::format("This is part {} of {} of a sweep of {}; `gnomon merge` unites them. ",
                          shard.index, shard.count,
                          counted(run.description().size, "configuration"));
    text += fmt::format("{} of {} measured", grouped(outcome.done), counted(all, "configuration"));
    if (outcome.failed > 0) {
        text += fmt::format(", {} failed", grouped(outcome.failed));
    }
    if (outcome.planned > 0) {
        text += fmt::format(", {} not computed yet", grouped(outcome.planned));
    }
    text += ".";
    if (const std::string schema = schema_text(run.schema()); !schema.empty()) {
        text += fmt::format(" T{}.", schema.substr(1)); // a sentence's beginning
    }
    return text;
}

void add_extremes(std::vector<std::string>& sentences, const std::vector<OverviewRow>& rows)
{
    const OverviewRow& best = rows.front();
    const OverviewRow& worst = rows.back();
    if (rows.size() == 1) {
        sentences.push_back(fmt::format("The one measured has {}, with {}.",
                                        rates_text(best.result), best.settings));
        return;
    }
    sentences.push_back(
        fmt::format("The best has {}, with {}.", rates_text(best.result), best.settings));
    sentences.push_back(
        fmt::format("The worst has {}, with {}.", rates_text(worst.result), worst.settings));
}

/// How many bias curves no constant bias serves.
void add_curve_verdict(std::vector<std::string>& sentences, const RunReader& run)
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
                ? fmt::format("In every one of {} some constant bias keeps both acne and "
                              "peter-panning below 0.1 % of the scored pixels.",
                              counted(all, "bias curve"))
                : fmt::format("In {} of {} no constant bias keeps both acne and peter-panning "
                              "below 0.1 % of the scored pixels.",
                              grouped(unserved), counted(all, "bias curve")));
    }
}

void add_findings(std::vector<std::string>& sentences, const Json& detail, bool is_one)
{
    const Json* const findings =
        detail.is_object() && detail.contains("findings") ? &detail["findings"] : nullptr;
    if (findings == nullptr || !findings->is_array()) {
        return;
    }
    bool is_first = true;
    for (const Json& finding : *findings) {
        if (finding.is_string()) {
            const auto& words = finding.get_ref<const std::string&>();
            sentences.push_back(is_first && !is_one ? "Of the best: " + words : words);
            is_first = false;
        }
    }
}

/// The scene's name, where all configurations share it; of another renderer's case the case's own.
std::string common_scene(const RunReader& run)
{
    if (!run.description().environment.is_of_gl()) {
        sqlite::Statement find{run.database(), "SELECT DISTINCT \"case\" FROM results LIMIT 2"};
        std::string name = find.step() ? find.text(0) : std::string{};
        return find.step() ? std::string{} : name;
    }
    sqlite::Statement find{
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

RunOverview read_overview(const RunReader& run)
{
    RunOverview overview;
    overview.scene = common_scene(run);
    overview.notes = note_sentences(run.description());
    overview.rows = ranked_rows(run);
    const PlanOutcome& outcome = run.outcome();
    overview.failed_count = outcome.failed;
    if (outcome.failed > 0) {
        overview.failed = named_rows(
            run, run.rows(fmt::format("WHERE status = 'failed' ORDER BY ordinal LIMIT {}",
                                      most_rows_shown)));
    }
    const bool is_one = outcome.done == 1 && run.description().size == 1;
    if (!is_one) {
        overview.sentences.push_back(completeness(run));
    }
    if (overview.rows.empty()) {
        return overview;
    }
    overview.headline = overview.rows.front();
    const std::string id = overview.headline->result.text("id");
    overview.detail = find_detail(run.folder(), id);
    if (is_one && overview.detail.is_null()) {
        overview.sentences.push_back(rates_text(overview.headline->result) + ".");
    } else if (!is_one) {
        add_extremes(overview.sentences, overview.rows);
        add_curve_verdict(overview.sentences, run);
    }
    add_findings(overview.sentences, overview.detail, is_one);
    return overview;
}

std::string run_command(const RunDescription& description)
{
    const Shard shard = description.shard;
    return shard.count == 1
               ? description.command
               : fmt::format("{} --shard {}/{}", description.command, shard.index, shard.count);
}

std::string compare_command(const RunDescription& description, const ResultRow& row)
{
    std::vector<std::pair<std::string, std::string>> axes;
    for (const std::string& axis : description.axes) {
        axes.emplace_back(axis, row.text(axis));
    }
    return compare_command(description, row.text("case"), axes);
}

std::string compare_command(const RunDescription& description, const std::string& case_name,
                            const std::vector<std::pair<std::string, std::string>>& axes)
{
    if (description.compare_command.empty()) {
        return {};
    }
    if (description.compare_command.starts_with("gnomon evaluate ")) {
        return description.compare_command; // the case is all that there is
    }
    std::vector<std::string> words;
    if (!case_name.empty()) {
        words.insert(words.end(), {"--case", case_name});
    }
    for (const auto& [axis, value] : axes) {
        words.insert(words.end(), {"--set", fmt::format("{}={}", axis, value)});
    }
    words.insert(words.end(), {"--out", "DIR"});
    return fmt::format("{} {}", description.compare_command, shell_text(words));
}

std::vector<std::pair<std::string, std::string>> job_settings(const ResultRow& row)
{
    std::vector<std::pair<std::string, std::string>> settings;
    for (const JobColumn& column : job_columns()) {
        if (std::string value = row.text(column.name); !value.empty()) {
            settings.emplace_back(column.name, std::move(value));
        }
    }
    return settings;
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

bool has_amounts(const ResultRow& row)
{
    return std::ranges::any_of(cause_columns(), [&](const KindColumns& kind) {
        const auto amount = row.number(kind.amount);
        return amount && *amount != static_cast<double>(row.count(kind.count));
    });
}

} // namespace gnomon::reports
