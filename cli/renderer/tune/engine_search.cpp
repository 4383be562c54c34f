#include "cli/renderer/tune/engine_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace gnomon::cli {
namespace {

constexpr int scales = 8; ///< powers of ten
/// Distances from a key's start, beside the best one.
constexpr std::array<double, 4> coarse_factors{0.25, 0.5, 2, 4};
constexpr std::array<double, 4> fine_factors{0.7, 0.85, 1.2, 1.4};

std::string text_of(const EngineValues& values)
{
    std::string text;
    for (const auto& [name, value] : values) {
        text += fmt::format("{} = {}\n", name, scene::to_toml(value));
    }
    return text;
}

/// The bounds of a number or an integer; empty of other keys.
std::optional<std::pair<double, double>> bounds_of(const scene::Domain& domain)
{
    if (const auto* const real = std::get_if<scene::RealDomain>(&domain)) {
        return std::pair{real->lower, real->upper};
    }
    if (const auto* const integer = std::get_if<scene::IntegerDomain>(&domain)) {
        return std::pair{static_cast<double>(integer->lower), static_cast<double>(integer->upper)};
    }
    return std::nullopt;
}

double number_of(const scene::JobValue& value)
{
    const auto* const integer = std::get_if<std::int64_t>(&value);
    return integer != nullptr ? static_cast<double>(*integer) : std::get<double>(value);
}

class EngineSearch {
public:
    EngineSearch(const EngineValues& start, std::size_t budget, const MeasureEngine& measure)
        : start_{start},
          budget_{budget},
          measure_{measure}
    {
        const auto amount = measured(start);
        if (!amount) {
            throw std::invalid_argument("search_engine: start: it cannot be drawn");
        }
        result_.best = start;
        result_.amount = *amount;
    }

    EngineSearchResult run(const std::vector<EngineKey>& keys)
    {
        double before = 0;
        do {
            before = result_.amount;
            for (const EngineKey& key : keys) {
                search(key);
            }
        } while (result_.amount < before && !result_.is_exhausted);
        result_.measured = amounts_.size();
        return std::move(result_);
    }

private:
    std::optional<double> measured(const EngineValues& values)
    {
        const std::string text = text_of(values);
        const auto known = amounts_.find(text);
        if (known != amounts_.end()) {
            return known->second;
        }
        if (amounts_.size() >= budget_) {
            result_.is_exhausted = true;
            return std::nullopt;
        }
        return amounts_[text] = measure_(values);
    }

    /// Takes the value for the best if it is.
    void try_value(const EngineKey& key, scene::JobValue value)
    {
        EngineValues values = result_.best;
        values[key.name] = std::move(value);
        const auto amount = measured(values);
        if (amount && *amount < result_.amount) {
            result_.best = std::move(values);
            result_.amount = *amount;
        }
    }

    void search(const EngineKey& key)
    {
        if (const auto bounds = bounds_of(key.domain)) {
            search_number(key, bounds->first, bounds->second);
            return;
        }
        if (const auto* const words = std::get_if<scene::WordDomain>(&key.domain)) {
            for (const std::string& word : words->words) {
                try_value(key, word);
            }
            return;
        }
        for (const bool flag : {false, true}) {
            try_value(key, flag);
        }
    }

    void try_number(const EngineKey& key, double number)
    {
        if (std::holds_alternative<scene::IntegerDomain>(key.domain)) {
            try_value(key, static_cast<std::int64_t>(std::llround(number)));
        } else {
            try_value(key, number);
        }
    }

    void search_number(const EngineKey& key, double lower, double upper)
    {
        const double centre = number_of(start_.at(key.name));
        const auto try_at = [&](double distance) {
            try_number(key, std::clamp(centre + distance, lower, upper));
        };
        for (int k = scales - 1; k >= 0; --k) {
            const double distance = (upper - lower) * std::pow(10.0, -k);
            try_at(distance);
            try_at(-distance);
        }
        for (const auto& factors : {coarse_factors, fine_factors}) {
            const double distance = number_of(result_.best.at(key.name)) - centre;
            for (const double factor : factors) {
                try_at(distance * factor);
            }
        }
    }

    const EngineValues& start_;
    std::size_t budget_;
    const MeasureEngine& measure_;
    std::map<std::string, std::optional<double>> amounts_; ///< by the values' text
    EngineSearchResult result_;
};

} // namespace

EngineSearchResult search_engine(const std::vector<EngineKey>& keys, const EngineValues& start,
                                 std::size_t budget, const MeasureEngine& measure)
{
    return EngineSearch{start, budget, measure}.run(keys);
}

} // namespace gnomon::cli
