#include "analysis/metrics/part_table.hpp"

#include <algorithm>
#include <array>

namespace gnomon::analysis {

namespace {

constexpr std::size_t pixel_kinds = 2;

constexpr std::array<std::string_view, 2> scored{"lit", "blocked"};
constexpr std::array<std::string_view, 2> counts{"false_shadow", "false_lit"};
constexpr std::array<std::string_view, 2> amounts{"shadow_amount", "light_amount"};

double sum_of(std::span<const std::string_view> names, const PartCounts& of)
{
    double sum = 0;
    for (const PartQuantity& quantity : part_quantities()) {
        if (std::ranges::find(names, quantity.name) != names.end()) {
            sum += quantity.number(of);
        }
    }
    return sum;
}

} // namespace

double PartQuantity::number(const PartCounts& counts_of_part) const
{
    const MetricValue number = value(counts_of_part);
    const auto* const count = std::get_if<std::uint64_t>(&number);
    return count != nullptr ? static_cast<double>(*count) : std::get<double>(number);
}

std::span<const PartQuantity> part_quantities()
{
    static constexpr std::array quantities{
        PartQuantity{"lit", MetricType::count,
                     [](const PartCounts& of) { return MetricValue{of.lit}; }},
        PartQuantity{"blocked", MetricType::count,
                     [](const PartCounts& of) { return MetricValue{of.blocked}; }},
        PartQuantity{"false_shadow", MetricType::count,
                     [](const PartCounts& of) { return MetricValue{of.false_shadow}; }},
        PartQuantity{"false_lit", MetricType::count,
                     [](const PartCounts& of) { return MetricValue{of.false_lit}; }},
        PartQuantity{"shadow_amount", MetricType::number,
                     [](const PartCounts& of) { return MetricValue{of.shadow_amount}; }},
        PartQuantity{"light_amount", MetricType::number,
                     [](const PartCounts& of) { return MetricValue{of.light_amount}; }}};
    return quantities;
}

std::span<const PartQuantity> part_errors()
{
    return part_quantities().subspan(pixel_kinds);
}

std::span<const PartRate> part_rates()
{
    static constexpr std::array<PartRate, 6> rates{
        {{"false_shadow_rate", std::span{counts}.first<1>(), std::span{scored}.first<1>()},
         {"false_lit_rate", std::span{counts}.last<1>(), std::span{scored}.last<1>()},
         {"error_rate", counts, scored},
         {"shadow_amount_rate", std::span{amounts}.first<1>(), std::span{scored}.first<1>()},
         {"light_amount_rate", std::span{amounts}.last<1>(), std::span{scored}.last<1>()},
         {"mean_abs_error", amounts, scored}}};
    return rates;
}

std::optional<double> rate_of(const PartRate& rate, const PartCounts& counts_of_part)
{
    const double pixels = sum_of(rate.pixels, counts_of_part);
    return pixels > 0 ? std::optional{sum_of(rate.errors, counts_of_part) / pixels} : std::nullopt;
}

} // namespace gnomon::analysis
