#include "analysis/sweep/sweep_curves.hpp"

#include "analysis/sweep/configuration_id.hpp"
#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/keys/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace gnomon::analysis {

namespace {

/// The name of the job's bias curve; without a curve, of its bias alone.
std::string curve_of(std::string_view version, std::string_view scene_name, const scene::Job& job,
                     JobParameters parameters)
{
    const bool has_curve = methods::traits(job).has_curve();
    if (has_curve && scene::scales_bias(job)) {
        parameters.emplace_back("bias", fmt::format("in {}", scene::bias_unit_of(job.bias).name));
    }
    return configuration_id(version, scene_name, parameters, !has_curve);
}

/// The constant bias of a job without the sweep's axes.
std::string job_bias_text(const scene::BiasSettings& own, const scene::Job& job)
{
    if (!methods::traits(job).has_curve()) {
        return {};
    }
    const scene::BiasUnit& unit = scene::bias_unit_of(own);
    return fmt::format("{}{}{}", scene::constant_in_unit(own), unit.is_depth() ? "" : " ",
                       unit.is_depth() ? "" : unit.symbol);
}

/// Replaces the constant bias in parameters of the curve group by the job's.
void replace_constant_bias(JobParameters& parameters, const scene::Job& job)
{
    for (auto& [key, value] : parameters) {
        if (scene::is_constant_bias(key)) {
            if (const auto held = scene::keys_of(job).find(key)->get(job)) {
                value = scene::to_toml(*held);
            }
        }
    }
}

/// Adds axes that the job does not write out: their values, too, tell configurations apart.
void add_axis_values(JobParameters& parameters, const scene::SweepSpace& space,
                     const scene::SweepPoint& point)
{
    for (std::size_t i = 0; i < space.axes().size(); ++i) {
        const scene::SweepAxis& axis = space.axes()[i];
        const bool is_written =
            std::ranges::find(parameters, axis.key, &JobParameters::value_type::first) !=
            parameters.end();
        if (!is_written && space.keys().find(axis.key) != nullptr) {
            parameters.emplace_back(axis.key, axis.values[point.values[i]]);
        }
    }
}

/// A short text in place of a longer one, only to tell texts apart: 90 bits of its 128-bit FNV-1a
/// hash, in the 15 characters that a string stores inline. Empty for an empty text.
std::string fingerprint(std::string_view text)
{
    if (text.empty()) {
        return {};
    }
    __extension__ using Hash = unsigned __int128;
    constexpr Hash prime = (Hash{1} << 88U) + 0x13B;
    Hash hash = (Hash{0x6C62272E07BB0142U} << 64U) + 0x62B821756295C58DU;
    for (const char character : text) {
        hash = (hash ^ static_cast<unsigned char>(character)) * prime;
    }
    constexpr std::size_t length = 15;
    constexpr unsigned bits = 6;
    std::string short_text(length, ' ');
    for (char& character : short_text) {
        character = static_cast<char>('0' + static_cast<char>(hash & ((1U << bits) - 1U)));
        hash >>= bits;
    }
    return short_text;
}

/// Keys of many curves in little memory: fingerprints, except for the scene, with which the curve's
/// key begins.
StageKeys shortened(const StageKeys& keys)
{
    const std::string_view treatment = std::string_view{keys.curve}.substr(keys.scene.size());
    return {keys.scene,
            fingerprint(keys.light),
            fingerprint(keys.camera),
            fingerprint(keys.truth),
            fingerprint(keys.frustum),
            fingerprint(keys.receivers),
            fingerprint(keys.texels),
            fingerprint(keys.map),
            fingerprint(keys.filtered),
            fingerprint(keys.exact),
            fingerprint(keys.lookup),
            keys.scene + fingerprint(treatment)};
}

} // namespace

class SweepCurves::Groups {
public:
    explicit Groups(const scene::SweepSpace& space) : space_{space} {}

    void add(std::uint64_t ordinal)
    {
        const std::uint64_t curve_group = space_.curve_group(space_.at(ordinal));
        auto& members = groups_[curve_group];
        if (members.empty()) {
            order_.push_back(curve_group);
        }
        members.push_back(ordinal);
    }

    template <typename Take>
    void for_each(const Take& take)
    {
        for (const std::uint64_t curve_group : order_) {
            take(std::move(groups_[curve_group]));
        }
    }

private:
    const scene::SweepSpace& space_;
    std::map<std::uint64_t, std::vector<std::uint64_t>> groups_;
    std::vector<std::uint64_t> order_; ///< by their first configurations
};

SweepCurves::SweepCurves(const scene::SweepSpace& space, bool keeps_every_bias, std::string version)
    : space_{space},
      keeps_every_bias_{keeps_every_bias},
      version_{std::move(version)}
{
    Groups groups{space};
    for (std::uint64_t ordinal = 0; ordinal < space.size(); ++ordinal) {
        groups.add(ordinal);
    }
    groups.for_each(
        [&](std::vector<std::uint64_t> ordinals) { add_curve_group(std::move(ordinals)); });
}

SweepCurves::SweepCurves(const scene::SweepSpace& space, std::span<const std::uint64_t> ordinals,
                         std::string version)
    : space_{space},
      keeps_every_bias_{false},
      version_{std::move(version)}
{
    Groups groups{space};
    std::ranges::for_each(ordinals, [&](std::uint64_t ordinal) { groups.add(ordinal); });
    groups.for_each(
        [&](std::vector<std::uint64_t> members) { add_curve_group(std::move(members)); });
}

void SweepCurves::add_curve_group(std::vector<std::uint64_t> ordinals)
{
    scene::Job job;
    try {
        job = space_.job(space_.at(ordinals.front()));
        methods::check(job);
    } catch (const scene::InputError& error) {
        refusals_.push_back({std::move(ordinals), error.what()});
        return;
    }
    if (!keeps_every_bias_ && methods::traits(job).has_curve()) {
        add_request(job, std::move(ordinals));
        return;
    }
    for (const std::uint64_t ordinal : ordinals) {
        space_.set_constant_bias(job, space_.at(ordinal));
        add_request(job, {ordinal});
    }
}

void SweepCurves::add_request(const scene::Job& job, std::vector<std::uint64_t> ordinals)
{
    const auto side = static_cast<std::uint64_t>(job.shadow_map.resolution_texels);
    requests_.push_back({shortened(keeps_every_bias_ ? stage_keys_with_bias(job) : stage_keys(job)),
                         std::move(ordinals), job.image.pixel_count(), side * side,
                         !methods::traits(job).has_formula()});
}

scene::Job SweepCurves::job(std::size_t request) const
{
    return space_.job(space_.at(requests_[request].ordinals.front()));
}

SweepTask SweepCurves::task(std::size_t request, const SceneIdentity& scene) const
{
    const auto& ordinals = requests_[request].ordinals;
    scene::Job job = this->job(request);
    SweepTask task;
    task.id = curve_of(version_, scene.name(), job, scene::resolved_keys(job));
    task.job = job;
    const scene::BiasSettings own = space_.own_constant_bias(space_.at(ordinals.front()));
    scene::set_constant(task.job.bias, scene::bias_unit_of(own), scene::constant_in_unit(own));
    for (const std::uint64_t ordinal : ordinals) {
        space_.set_constant_bias(job, space_.at(ordinal));
        task.rows.push_back({ordinal, job.bias});
    }
    return task;
}

std::string SweepCurves::curve_key(std::size_t request, const SceneIdentity& scene) const
{
    const StageKeys& keys = requests_[request].keys;
    return scene.name() + keys.curve.substr(keys.scene.size());
}

bool SweepCurves::may_repeat(std::span<const SceneIdentity> scenes) const
{
    std::set<std::string> curves;
    for (std::size_t i = 0; i < requests_.size(); ++i) {
        if (!curves.insert(curve_key(i, scenes[i])).second || has_equal_biases(requests_[i])) {
            return true;
        }
    }
    return false;
}

bool SweepCurves::has_equal_biases(const CurveRequest& request) const
{
    std::set<std::pair<std::string_view, double>> biases;
    scene::Job job = space_.job(space_.at(request.ordinals.front()));
    return std::ranges::any_of(request.ordinals, [&](std::uint64_t ordinal) {
        space_.set_constant_bias(job, space_.at(ordinal));
        return !biases.emplace(scene::bias_unit_of(job.bias).key, scene::constant_in_unit(job.bias))
                    .second;
    });
}

void SweepCurves::describe(std::size_t request, const SceneIdentity& scene, const Visit& visit,
                           std::uint32_t shard) const
{
    const auto& ordinals = requests_[request].ordinals;
    scene::Job job = this->job(request);
    Configuration configuration;
    configuration.parameters = scene::resolved_keys(job);
    configuration.scene_hash = scene.hash;
    configuration.shard = shard;
    const scene::SweepPoint first = space_.at(ordinals.front());
    const std::string name = scene_in_ids(scene, space_.given_keys(first));
    configuration.curve = curve_of(version_, name, job, configuration.parameters);
    configuration.case_name = space_.case_name(first);
    configuration.job_bias = job_bias_text(space_.own_constant_bias(first), job);
    for (const std::uint64_t ordinal : ordinals) {
        space_.set_constant_bias(job, space_.at(ordinal));
        replace_constant_bias(configuration.parameters, job);
        configuration.ordinal = ordinal;
        configuration.light_values = space_.light_values(space_.at(ordinal));
        configuration.id = configuration_id(version_, name, configuration.parameters, true);
        Configuration shown = configuration;
        add_axis_values(shown.parameters, space_, space_.at(ordinal));
        visit(shown);
    }
}

void SweepCurves::describe(const Refusal& refusal, const Visit& visit, std::uint32_t shard) const
{
    for (const std::uint64_t ordinal : refusal.ordinals) {
        const scene::SweepPoint point = space_.at(ordinal);
        Configuration configuration;
        configuration.ordinal = ordinal;
        configuration.shard = shard;
        configuration.case_name = space_.case_name(point);
        configuration.light_values = space_.light_values(point);
        configuration.parameters = space_.given_keys(point);
        const std::string name = scene_in_ids({}, configuration.parameters);
        configuration.id = configuration_id(version_, name, configuration.parameters, true);
        configuration.curve = configuration_id(version_, name, configuration.parameters, false);
        visit(configuration);
    }
}

} // namespace gnomon::analysis
