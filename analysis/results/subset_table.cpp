#include "analysis/results/metric_table.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace gnomon::analysis {

namespace {

constexpr std::size_t pixel_kinds = 2;

constexpr std::array<std::string_view, 2> scored{"lit", "blocked"};
constexpr std::array<std::string_view, 2> counts{"false_shadow", "false_lit"};
constexpr std::array<std::string_view, 2> amounts{"shadow_amount", "light_amount"};

double sum_of(std::span<const std::string_view> names, const SubsetCounts& of)
{
    double sum = 0;
    for (const SubsetQuantity& quantity : subset_quantities()) {
        if (std::ranges::find(names, quantity.name) != names.end()) {
            sum += quantity.number(of);
        }
    }
    return sum;
}

} // namespace

double SubsetQuantity::number(const SubsetCounts& subset) const
{
    const MetricValue number = value(subset);
    const auto* const count = std::get_if<std::uint64_t>(&number);
    return count != nullptr ? static_cast<double>(*count) : std::get<double>(number);
}

std::span<const SubsetQuantity> subset_quantities()
{
    static constexpr std::array quantities{
        SubsetQuantity{"lit", MetricType::count,
                       [](const SubsetCounts& of) { return MetricValue{of.lit}; }},
        SubsetQuantity{"blocked", MetricType::count,
                       [](const SubsetCounts& of) { return MetricValue{of.blocked}; }},
        SubsetQuantity{"false_shadow", MetricType::count,
                       [](const SubsetCounts& of) { return MetricValue{of.false_shadow}; }},
        SubsetQuantity{"false_lit", MetricType::count,
                       [](const SubsetCounts& of) { return MetricValue{of.false_lit}; }},
        SubsetQuantity{"shadow_amount", MetricType::number,
                       [](const SubsetCounts& of) { return MetricValue{of.shadow_amount}; }},
        SubsetQuantity{"light_amount", MetricType::number,
                       [](const SubsetCounts& of) { return MetricValue{of.light_amount}; }}};
    return quantities;
}

std::span<const SubsetQuantity> subset_errors()
{
    return subset_quantities().subspan(pixel_kinds);
}

std::span<const SubsetRate> subset_rates()
{
    static constexpr auto rates = std::to_array<SubsetRate>({
        {"false_shadow_rate", std::span{counts}.first<1>(), std::span{scored}.first<1>(),
         "`false_shadow` / `pixels.lit`", "false-shadow rate", true},
        {"false_lit_rate", std::span{counts}.last<1>(), std::span{scored}.last<1>(),
         "`false_lit` / `pixels.blocked`", "false-lit rate", true},
        {"error_rate", counts, scored,
         "(`false_shadow` + `false_lit`) / (`pixels.lit` + `pixels.blocked`)", "error rate", true},
        {"shadow_amount_rate", std::span{amounts}.first<1>(), std::span{scored}.first<1>(),
         "`shadow_amount` / `pixels.lit`", "amount of false shadow per lit pixel"},
        {"light_amount_rate", std::span{amounts}.last<1>(), std::span{scored}.last<1>(),
         "`light_amount` / `pixels.blocked`", "amount of false light per blocked pixel"},
        {"mean_abs_error", amounts, scored,
         "mean of \\|verdict − truth\\| over lit and blocked pixels: both amounts / "
         "(`pixels.lit` + `pixels.blocked`)",
         "mean absolute error", true},
    });
    return rates;
}

std::optional<double> rate_of(const SubsetRate& rate, const SubsetCounts& subset)
{
    const double pixels = sum_of(rate.pixels, subset);
    return pixels > 0 ? std::optional{sum_of(rate.errors, subset) / pixels} : std::nullopt;
}

} // namespace gnomon::analysis
