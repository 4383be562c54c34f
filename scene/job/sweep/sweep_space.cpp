#include "scene/job/sweep/sweep_space.hpp"

#include "scene/error.hpp"
#include "scene/job/lights.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/job/sweep/sweep_axes.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string_view>
#include <utility>

namespace gnomon::scene {
namespace {

/// Each is a row in the results; a larger sweep is a mistake or needs `sample`.
constexpr std::uint64_t most_configurations = 10'000'000;

/// A number below `bound`, from the generator's bits: standard distributions differ between
/// implementations.
std::uint64_t draw_below(std::mt19937_64& generator, std::uint64_t bound)
{
    const std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t fair = largest - largest % bound;
    std::uint64_t drawn = generator();
    while (drawn >= fair) {
        drawn = generator();
    }
    return drawn % bound;
}

/// `count` different numbers below `size`, ascending. Source: R. W. Floyd, in J. Bentley,
/// "Programming Pearls: a sample of brilliance", CACM 30 (1987).
std::vector<std::uint64_t> draw_sample(std::uint64_t size, std::uint64_t count, std::int64_t seed)
{
    std::mt19937_64 generator{static_cast<std::uint64_t>(seed)};
    std::set<std::uint64_t> drawn;
    for (std::uint64_t last = size - count; last < size; ++last) {
        if (!drawn.insert(draw_below(generator, last + 1)).second) {
            drawn.insert(last);
        }
    }
    return {drawn.begin(), drawn.end()};
}

} // namespace

SweepSpace::SweepSpace(JobSource source, const std::vector<std::string>& axis_arguments,
                       std::string_view case_name)
    : source_{std::move(source)}
{
    replace_axes(axis_arguments);
    for (const SweepAxis& axis : axes()) {
        keys_.push_back(find_written_key(*source_.keys, axis.key));
    }
    keep_case(case_name);
    check_keys();
    resolve_values();
    check_repetitions();
    number_zipped_groups();
    count();
}

void SweepSpace::replace_axes(const std::vector<std::string>& arguments)
{
    std::vector<SweepAxis>& axes = source_.sweep.axes;
    std::set<std::string> given;
    for (const std::string& argument : arguments) {
        SweepAxis axis = read_axis_argument(*source_.keys, argument);
        if (!given.insert(axis.key).second) {
            throw InputError(fmt::format("--axis {}: the axis is given twice; keep one", axis.key));
        }
        const auto same = std::find_if(axes.begin(), axes.end(), [&](const SweepAxis& other) {
            return other.key == axis.key;
        });
        if (same == axes.end()) {
            axes.push_back(std::move(axis));
        } else {
            *same = std::move(axis);
        }
    }
    check_axis_lengths(source_.sweep, source_.name);
}

void SweepSpace::keep_case(std::string_view name)
{
    if (!name.empty()) {
        source_.cases = {find_case(source_, name)};
    }
}

/// A setting that the axis overrides would be lost silently.
bool SweepSpace::is_set(const Layer& layer, std::size_t axis) const
{
    return std::ranges::any_of(layer, [&](const Setting& setting) {
        return setting.spec == keys_[axis].spec &&
               (keys_[axis].light.empty() || setting.light == keys_[axis].light);
    });
}

/// An axis for all lights has no effect on a light with its own axis for that key.
void SweepSpace::check_axes_of_lights() const
{
    for (const WrittenKey& key : keys_) {
        const WrittenKey of_all{key.spec, {}};
        if (!key.light.empty() && std::ranges::any_of(keys_, [&](const WrittenKey& other) {
                return other.spec == key.spec && other.light.empty();
            })) {
            throw InputError(fmt::format("{}: [sweep] {}: {} is an axis, too; keep one of the two, "
                                         "or give each light its own",
                                         source_.name, key.text(), of_all.text()));
        }
    }
}

void SweepSpace::check_keys() const
{
    check_axes_of_lights();
    for (std::size_t axis = 0; axis < axes().size(); ++axis) {
        const std::string& key = axes()[axis].key;
        if (is_set(source_.overrides, axis)) {
            throw InputError(fmt::format("--set {0}: {0} is an axis of the sweep; give its values "
                                         "with --axis {0}=…, or remove one of the two",
                                         key));
        }
        for (const CaseLayer& each : source_.cases) {
            if (is_set(each.layer, axis)) {
                throw InputError(fmt::format("{}: [[case]] {}: {} is an axis of the sweep too; "
                                             "remove it from the case or from the axes",
                                             source_.name, toml_excerpt({each.name}), key));
            }
        }
    }
}

void SweepSpace::resolve_values()
{
    for (const auto& [key, texts] : axes()) {
        Layer& values = values_.emplace_back();
        std::vector<std::size_t>& firsts = first_equal_.emplace_back();
        std::map<std::string_view, std::size_t> first_of;
        for (std::size_t i = 0; i < texts.size(); ++i) {
            const std::string& value = texts[i];
            Setting& setting =
                values.emplace_back(layer_from_overrides(*source_.keys, {{key, value}}).front());
            setting.label = fmt::format("[sweep] {} = {}", key, value);
            firsts.push_back(first_of.try_emplace(value, i).first->second);
        }
        check_lights(source_.lights, values);
    }
}

void SweepSpace::check_repetitions() const
{
    std::set<std::vector<std::size_t>> tuples;
    for (std::size_t axis = 0; axis < axes().size(); ++axis) {
        for (std::size_t i = 0; i < first_equal_[axis].size() && !is_zipped(); ++i) {
            if (first_equal_[axis][i] != i) {
                throw InputError(fmt::format("{}: [sweep] {}: {} comes twice; keep one",
                                             source_.name, axes()[axis].key,
                                             axes()[axis].values[i]));
            }
        }
    }
    for (std::size_t i = 0; is_zipped() && !axes().empty() && i < axes().front().values.size();
         ++i) {
        std::vector<std::size_t> tuple;
        for (const auto& firsts : first_equal_) {
            tuple.push_back(firsts[i]);
        }
        if (!tuples.insert(std::move(tuple)).second) {
            throw InputError(fmt::format("{}: [sweep] mode = \"zip\": the {}. values of all axes "
                                         "are those of an earlier one; keep one",
                                         source_.name, i + 1));
        }
    }
}

std::vector<std::size_t> SweepSpace::zipped_groups_of(std::size_t light) const
{
    std::map<std::vector<std::size_t>, std::size_t> firsts;
    std::vector<std::size_t> groups;
    const SweepPoint of_light{.light_index = light};
    for (std::size_t i = 0; i < axes().front().values.size(); ++i) {
        std::vector<std::size_t> tuple;
        for (std::size_t axis = 0; axis < axes().size(); ++axis) {
            if (!is_bias_axis(axis) && concerns(axis, of_light)) {
                tuple.push_back(first_equal_[axis][i]);
            }
        }
        groups.push_back(firsts.try_emplace(std::move(tuple), i).first->second);
    }
    return groups;
}

void SweepSpace::number_zipped_groups()
{
    for (std::size_t light = 0; is_zipped() && !axes().empty() && light < light_count(); ++light) {
        zipped_groups_.push_back(zipped_groups_of(light));
    }
}

void SweepSpace::count()
{
    std::uint64_t size = std::max<std::uint64_t>(1, source_.cases.size());
    for (std::size_t i = 0; i < axes().size() && (i == 0 || !is_zipped()); ++i) {
        const std::uint64_t length = axes()[i].values.size();
        if (size > std::numeric_limits<std::uint64_t>::max() / length) {
            throw InputError(fmt::format("{}: [sweep]: 2^64 configurations or more, too many even "
                                         "to sample; shorten the axes",
                                         source_.name));
        }
        size *= length;
    }
    const auto sample = static_cast<std::uint64_t>(source_.sweep.sample);
    const std::uint64_t kept = sample > 0 ? std::min(size, sample) : size;
    if (kept > most_configurations / light_count()) {
        throw InputError(fmt::format(
            "{}: [sweep]: more than {} configurations; shorten the axes, or draw some of them "
            "with sample = N",
            source_.name, most_configurations));
    }
    size_ = kept * light_count();
    if (kept < size) {
        sample_ = draw_sample(size, kept, source_.sweep.seed);
    }
}

SweepPoint SweepSpace::at(std::uint64_t ordinal) const
{
    SweepPoint point;
    point.light_index = ordinal % light_count();
    std::uint64_t rest = ordinal / light_count();
    rest = sample_.empty() ? rest : sample_[rest];
    point.values.resize(axes().size());
    for (std::size_t i = axes().size(); i-- > 0;) {
        const std::uint64_t length = axes()[i].values.size();
        point.values[i] = rest % length;
        rest /= is_zipped() && i > 0 ? 1 : length;
    }
    point.case_index = rest;
    return point;
}

const CaseLayer* SweepSpace::chosen_case(const SweepPoint& point) const
{
    return source_.cases.empty() ? nullptr : &source_.cases[point.case_index];
}

std::string_view SweepSpace::case_name(const SweepPoint& point) const
{
    const CaseLayer* chosen = chosen_case(point);
    return chosen == nullptr ? std::string_view{} : chosen->name;
}

std::string_view SweepSpace::light_name(const SweepPoint& point) const
{
    return lights().empty() ? std::string_view{} : lights()[point.light_index];
}

std::vector<std::pair<std::string, std::string>>
SweepSpace::light_values(const SweepPoint& point) const
{
    std::vector<std::pair<std::string, std::string>> values;
    if (!lights().empty()) {
        values.emplace_back(light_distinction, toml_quoted(light_name(point)));
    }
    for (std::size_t i = 0; i < axes().size(); ++i) {
        if (!keys_[i].light.empty()) {
            values.emplace_back(axes()[i].key, axes()[i].values[point.values[i]]);
        }
    }
    return values;
}

std::vector<std::string> SweepSpace::distinctions() const
{
    std::vector<std::string> names;
    for (const SweepAxis& axis : axes()) {
        names.push_back(axis.key);
    }
    if (!lights().empty()) {
        names.emplace_back(light_distinction);
    }
    return names;
}

bool SweepSpace::is_bias_axis(std::size_t axis) const
{
    return is_constant_bias(keys_[axis].spec->name);
}

bool SweepSpace::concerns(std::size_t axis, const SweepPoint& point) const
{
    return keys_[axis].light.empty() || keys_[axis].light == light_name(point);
}

std::uint64_t SweepSpace::curve_group(const SweepPoint& point) const
{
    std::uint64_t curve_group = point.case_index * light_count() + point.light_index;
    if (!zipped_groups_.empty()) {
        const auto& groups = zipped_groups_[point.light_index];
        return curve_group * groups.size() + groups[point.values.front()];
    }
    for (std::size_t i = 0; i < axes().size(); ++i) {
        if (!is_bias_axis(i)) {
            curve_group *= axes()[i].values.size();
            curve_group += concerns(i, point) ? first_equal_[i][point.values[i]] : 0;
        }
    }
    return curve_group;
}

Layer SweepSpace::axis_settings(const SweepPoint& point) const
{
    Layer settings;
    for (std::size_t i = 0; i < axes().size(); ++i) {
        settings.push_back(values_[i][point.values[i]]);
    }
    return settings;
}

Job SweepSpace::job(const SweepPoint& point) const
{
    return make_job(source_, chosen_case(point), axis_settings(point), light_name(point));
}

std::vector<std::pair<std::string, std::string>>
SweepSpace::given_keys(const SweepPoint& point) const
{
    return scene::given_keys(source_, chosen_case(point), axis_settings(point), light_name(point));
}

void SweepSpace::set_constant_bias(Job& job, const SweepPoint& point) const
{
    for (std::size_t i = 0; i < axes().size(); ++i) {
        if (is_bias_axis(i) && concerns(i, point)) {
            const Setting& setting = values_[i][point.values[i]];
            setting.spec->set(job, setting.value);
        }
    }
}

BiasSettings SweepSpace::own_constant_bias(const SweepPoint& point) const
{
    Layer others;
    for (std::size_t i = 0; i < axes().size(); ++i) {
        if (!is_bias_axis(i)) {
            others.push_back(values_[i][point.values[i]]);
        }
    }
    try {
        return make_job(source_, chosen_case(point), others, light_name(point)).bias;
    } catch (const InputError&) {
        return {};
    }
}

std::string point_text(const SweepSpace& space, const SweepPoint& point, bool with_bias)
{
    std::string text{space.case_name(point)};
    for (std::size_t i = 0; i < space.axes().size(); ++i) {
        const SweepAxis& axis = space.axes()[i];
        if (space.concerns(i, point) && (with_bias || !space.is_bias_axis(i))) {
            text += text.empty() ? "" : ", ";
            text += fmt::format("{} {}", axis.key, axis.values[point.values[i]]);
        }
    }
    if (const std::string_view light = space.light_name(point); !light.empty()) {
        text += fmt::format("{}light {}", text.empty() ? "" : ", ", light);
    }
    return one_line(text);
}

} // namespace gnomon::scene
