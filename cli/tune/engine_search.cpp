#include "cli/tune/engine_search.hpp"

#include "scene/error.hpp"
#include "scene/job/toml.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

namespace gnomon::cli {
namespace {

constexpr int known_decades = 3; ///< powers of ten on each side of a known value
constexpr int range_decades = 7; ///< powers of ten below a key's range, if the known value is 0
/// Factors of the best value.
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

/// The bounds of a number or an integer; empty for other types.
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

scene::JobValue value_of(const EngineKey& key, double number)
{
    if (std::holds_alternative<scene::IntegerDomain>(key.domain)) {
        return static_cast<std::int64_t>(std::llround(number));
    }
    return number;
}

/// The ends of a number's range; every value of a choice.
std::vector<scene::JobValue> ends_of(const EngineKey& key)
{
    if (const auto bounds = bounds_of(key.domain)) {
        return {value_of(key, bounds->first), value_of(key, bounds->second)};
    }
    if (const auto* const words = std::get_if<scene::WordDomain>(&key.domain)) {
        return {words->words.begin(), words->words.end()};
    }
    return {false, true};
}

class EngineSearch {
public:
    EngineSearch(const std::vector<EngineValues>& known, std::size_t budget,
                 const MeasureEngine& measure)
        : budget_{budget},
          measure_{measure}
    {
        for (const EngineValues& values : known) {
            const EngineMeasure* const found = measured(values);
            const bool is_first = &values == &known.front();
            if (is_first && (found == nullptr || !found->error)) {
                throw std::invalid_argument("search_engine: known: the first cannot be drawn");
            }
            if (is_first) {
                take(values, *found);
            } else if (found != nullptr) {
                take_if_better(values, *found);
            }
        }
        start_ = result_.best;
    }

    EngineSearchResult run(const std::vector<EngineKey>& keys)
    {
        double before = 0;
        do {
            before = result_.error;
            idle_.clear();
            for (const EngineKey& key : keys) {
                search(key);
            }
        } while (result_.error < before && !result_.is_exhausted);
        result_.measured = measures_.size();
        for (const EngineKey& key : keys) {
            if (hiding_.contains(key.name) || idle_.contains(key.name)) {
                result_.dropped.push_back({key.name, hiding_.contains(key.name)});
            }
        }
        return std::move(result_);
    }

private:
    /// Measures a setting once; nullptr if the budget is spent.
    const EngineMeasure* measured(const EngineValues& values)
    {
        const std::string text = text_of(values);
        const auto known = measures_.find(text);
        if (known != measures_.end()) {
            return &known->second;
        }
        if (measures_.size() >= budget_) {
            result_.is_exhausted = true;
            return nullptr;
        }
        return &(measures_[text] = measure_(values));
    }

    void take(const EngineValues& values, const EngineMeasure& found)
    {
        result_.best = values;
        result_.error = *found.error;
        frame_ = found.frame;
    }
    void take_if_better(const EngineValues& values, const EngineMeasure& found)
    {
        if (found.error && *found.error < result_.error) {
            take(values, found);
        }
    }

    /// Tries a value in the best setting, and keeps it if it is better.
    /// @return  nullptr if the budget is spent.
    const EngineMeasure* try_value(const EngineKey& key, scene::JobValue value)
    {
        EngineValues values = result_.best;
        values[key.name] = std::move(value);
        const EngineMeasure* const found = measured(values);
        if (found != nullptr) {
            take_if_better(values, *found);
        }
        return found;
    }

    void search(const EngineKey& key)
    {
        if (hiding_.contains(key.name) || !probe(key)) {
            return;
        }
        if (const auto bounds = bounds_of(key.domain)) {
            search_number(key, bounds->first, bounds->second);
        }
    }

    /// Tries a key's ends; returns whether the key is worth a search.
    bool probe(const EngineKey& key)
    {
        const EngineValues before = result_.best;
        const double error = result_.error;
        const std::size_t frame = frame_;
        bool is_idle = true;
        for (scene::JobValue& value : ends_of(key)) {
            const EngineMeasure* const found = try_value(key, std::move(value));
            if (found != nullptr && found->changes_view) {
                result_.best = before;
                result_.error = error;
                frame_ = frame;
                hiding_.insert(key.name);
                return false;
            }
            is_idle = is_idle && found != nullptr && found->error && found->frame == frame;
        }
        if (is_idle) {
            idle_.insert(key.name);
        }
        return !is_idle;
    }

    void search_number(const EngineKey& key, double lower, double upper)
    {
        const double known = number_of(start_.at(key.name));
        const auto try_at = [&](double number) {
            return try_value(key, value_of(key, std::clamp(number, lower, upper)));
        };
        if (known != 0) {
            for (int k = 1; k <= known_decades; ++k) {
                try_at(known * std::pow(10.0, k));
                try_at(known * std::pow(10.0, -k));
            }
            try_at(0);
        } else {
            for (const double side : {1.0, -1.0}) {
                step_towards_zero(key, side * (upper - lower), try_at);
            }
        }
        for (const auto& factors : {coarse_factors, fine_factors}) {
            const double best = number_of(result_.best.at(key.name));
            for (const double factor : factors) {
                try_at(best * factor);
            }
        }
    }

    /// Tries the range times powers of ten down to 0, until a step gives the same frame as 0.
    template <typename TryAt>
    void step_towards_zero(const EngineKey& key, double range, const TryAt& try_at)
    {
        EngineValues zero = result_.best;
        zero[key.name] = value_of(key, 0);
        const EngineMeasure* const at_zero = measured(zero);
        for (int k = 1; k <= range_decades; ++k) {
            const EngineMeasure* const found = try_at(range * std::pow(10.0, -k));
            const bool is_as_zero = found != nullptr && at_zero != nullptr && found->error &&
                                    at_zero->error && found->frame == at_zero->frame;
            if (found == nullptr || is_as_zero) {
                return;
            }
        }
    }

    std::size_t budget_;
    const MeasureEngine& measure_;
    EngineValues start_;                            ///< the best known setting
    std::map<std::string, EngineMeasure> measures_; ///< by the values' text
    std::size_t frame_ = 0;                         ///< of the best setting
    std::set<std::string> idle_;                    ///< keys that change no pixel of it
    std::set<std::string> hiding_;                  ///< keys that show other surfaces
    EngineSearchResult result_;
};

/// The table of that name; nullptr if there is none.
const scene::TomlTable* find_table(const scene::TomlTable& table, std::string_view name)
{
    const auto found = std::ranges::find(table, name, &scene::TomlMember::key);
    return found == table.end() ? nullptr : std::get_if<scene::TomlTable>(&found->node.value);
}

void add_values(EngineValues& values, const scene::TomlTable& table,
                const std::vector<EngineKey>& keys, const std::string& source)
{
    for (const scene::TomlMember& member : table) {
        const auto key = std::ranges::find(keys, member.key, &EngineKey::name);
        const auto value =
            key == keys.end() ? std::nullopt : scene::read_value(key->domain, member.node);
        if (!value) {
            throw scene::InputError(fmt::format(
                "{}:{}: documented: {}: {}", source, member.line, scene::one_line(member.key),
                key == keys.end() ? "the engine has no such key"
                                  : scene::refusal_text(key->domain, member.node)));
        }
        values[member.key] = *value;
    }
}

} // namespace

EngineSearchResult search_engine(const std::vector<EngineKey>& keys,
                                 const std::vector<EngineValues>& known, std::size_t budget,
                                 const MeasureEngine& measure)
{
    return EngineSearch{known, budget, measure}.run(keys);
}

EngineValues documented_values(const std::filesystem::path& description, scene::LightType light,
                               const std::vector<EngineKey>& keys)
{
    EngineValues values;
    std::error_code none;
    if (description.empty() || !std::filesystem::is_regular_file(description, none)) {
        return values;
    }
    const std::string source = scene::one_line(description.string());
    const scene::TomlTable file =
        scene::parse_toml(scene::read_text_file(description, source, "league.toml"), source);
    const scene::TomlTable* const documented = find_table(file, "documented");
    for (const std::string_view name :
         {std::string_view{"engine"}, scene::light_type_name(light)}) {
        const scene::TomlTable* const table =
            documented == nullptr ? nullptr : find_table(*documented, name);
        if (table != nullptr) {
            add_values(values, *table, keys, source);
        }
    }
    return values;
}

} // namespace gnomon::cli
