#include "store/csv/view_depth_csv.hpp"

#include "analysis/comparison/view_depth_errors.hpp"
#include "analysis/metrics/map_results.hpp"
#include "analysis/results/metric_table.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "store/csv/csv_text.hpp"
#include "store/run/run_columns.hpp"
#include "store/sqlite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace gnomon::store {

namespace {

class CsvLine {
public:
    void add(const sqlite::Value& value)
    {
        begin_cell();
        if (const auto* text = std::get_if<std::string>(&value)) {
            append_csv_text(text_, *text);
        } else if (const auto* real = std::get_if<double>(&value)) {
            append_csv_number(text_, *real);
        } else if (const auto* integer = std::get_if<std::int64_t>(&value)) {
            text_ += fmt::format("{}", *integer);
        }
    }
    [[nodiscard]] std::string text() const { return text_ + "\n"; }

private:
    void begin_cell()
    {
        text_ += has_cells_ ? "," : "";
        has_cells_ = true;
    }

    std::string text_;
    bool has_cells_ = false;
};

/// "[1, 2.5]"; empty without numbers.
std::string list_text(const std::vector<double>& numbers)
{
    if (numbers.empty()) {
        return {};
    }
    std::string text = "[";
    for (const double number : numbers) {
        text += text.size() > 1 ? ", " : "";
        append_csv_number(text, number);
    }
    return text + "]";
}

void add_job(CsvLine& line, const scene::Job& job)
{
    const auto keys = scene::resolved_keys(job);
    for (const JobColumn& column : job_columns()) {
        const auto found =
            std::ranges::find(keys, column.name, &std::pair<std::string, std::string>::first);
        line.add(found == keys.end() ? sqlite::Value{} : job_cell(found->second));
    }
}

/// Adds empty lists for a job without cascades.
void add_slices(CsvLine& line, const analysis::Comparison& comparison)
{
    const scene::View& view = comparison.view;
    std::vector<double> edges_m;
    std::vector<double> texels_m;
    for (std::size_t map = 0; map < view.slices.ends.size(); ++map) {
        const auto facts = analysis::facts_of_map(comparison.job, view, map);
        if (map == 0) {
            edges_m.push_back(facts.begin_m.value());
        }
        edges_m.push_back(facts.end_m.value());
        texels_m.push_back(facts.texel_m);
    }
    line.add(list_text(edges_m));
    line.add(list_text(texels_m));
}

constexpr auto quantiles = std::to_array<std::pair<const char*, float analysis::Quantiles::*>>(
    {{"min", &analysis::Quantiles::min},
     {"median", &analysis::Quantiles::median},
     {"p95", &analysis::Quantiles::p95},
     {"max", &analysis::Quantiles::max}});

std::string header()
{
    CsvLine line;
    for (const JobColumn& column : job_columns()) {
        line.add(column.name);
    }
    for (const char* const name : {"slice_edges_m", "slice_texels_m", "lower_m", "upper_m"}) {
        line.add(std::string{name});
    }
    for (const analysis::SubsetQuantity& quantity : analysis::subset_quantities()) {
        line.add(std::string{quantity.name});
    }
    for (const analysis::SubsetRate& rate : analysis::subset_rates()) {
        line.add(std::string{rate.name});
    }
    for (const auto& [name, quantile] : quantiles) {
        line.add(std::string{"texel_m."} + name);
    }
    return line.text();
}

void add_band(CsvLine& line, const analysis::ViewDepthErrors& band)
{
    line.add(band.lower_m);
    line.add(band.upper_m);
    for (const analysis::SubsetQuantity& quantity : analysis::subset_quantities()) {
        line.add(quantity.number(band.counts));
    }
    for (const analysis::SubsetRate& rate : analysis::subset_rates()) {
        const std::optional<double> value = rate_of(rate, band.counts);
        line.add(value ? sqlite::Value{*value} : sqlite::Value{});
    }
    for (const auto& [name, quantile] : quantiles) {
        line.add(band.texel_m ? sqlite::Value{double{(*band.texel_m).*quantile}} : sqlite::Value{});
    }
}

} // namespace

std::string view_depth_csv(const analysis::Comparison& comparison, int bands)
{
    CsvLine settings;
    add_job(settings, comparison.job);
    add_slices(settings, comparison);
    std::string text = header();
    for (const analysis::ViewDepthErrors& band : errors_by_view_depth(comparison, bands)) {
        CsvLine line = settings;
        add_band(line, band);
        text += line.text();
    }
    return text;
}

} // namespace gnomon::store
