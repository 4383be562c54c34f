#pragma once

#include "scene/job/setting_layers.hpp"
#include "scene/job/source.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {

/// The name of the light among the columns that tell configurations apart.
inline constexpr std::string_view light_distinction = "light";

/// One point of a sweep: a case, a value on each axis, and one of the job's lights.
struct SweepPoint {
    std::size_t case_index = 0;
    std::vector<std::size_t> values; ///< by axis, the index of the value
    std::size_t light_index = 0;     ///< 0 also of a job with `[light]`
};

/// All configurations of a job's cases and axes, by number.
///
/// Cases vary slowest, then the axes in order, then the lights. With `mode = "zip"` all axes
/// advance together. `sample = N` keeps N combinations of cases and axes, drawn without replacement
/// by `seed`. Each of several lights is a separate configuration: a job with only that light.
class SweepSpace {
public:
    /// @param axis_arguments  "KEY=VALUES" as for `--axis`; each adds an axis or replaces one of
    ///                        the file.
    /// @param case_name       the only case to run; empty: all of them.
    /// @throws InputError  for an invalid axis, a repeated value, an axis that a case or override
    ///                     also sets, too many configurations, …
    SweepSpace(JobSource source, const std::vector<std::string>& axis_arguments,
               std::string_view case_name = {});

    [[nodiscard]] const KeyTable& keys() const { return *source_.keys; }

    /// Number of configurations.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// Names of the lights; empty: one light without a name.
    [[nodiscard]] const std::vector<std::string>& lights() const { return source_.lights; }
    [[nodiscard]] const std::vector<SweepAxis>& axes() const { return source_.sweep.axes; }
    [[nodiscard]] const std::string& mode() const { return source_.sweep.mode; }
    [[nodiscard]] std::size_t case_count() const { return source_.cases.size(); }

    /// @param ordinal  below `size()`.
    [[nodiscard]] SweepPoint at(std::uint64_t ordinal) const;
    /// Name of the point's case; empty if the job has no cases.
    [[nodiscard]] std::string_view case_name(const SweepPoint& point) const;
    /// Name of the point's light; empty if the job has only one.
    [[nodiscard]] std::string_view light_name(const SweepPoint& point) const;
    /// With several lights, the point's as `light`, then all axes that belong to one light,
    /// "lights.sun.…", with their values as TOML. Empty with one light.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>>
    light_values(const SweepPoint& point) const;
    /// The columns that tell the points of a case apart: the axes' keys and, with several lights,
    /// `light`.
    [[nodiscard]] std::vector<std::string> distinctions() const;
    /// Whether the axis applies to the point's light.
    [[nodiscard]] bool concerns(std::size_t axis, const SweepPoint& point) const;
    /// Whether the axis varies a constant bias, of all lights or of one.
    [[nodiscard]] bool is_bias_axis(std::size_t axis) const;

    /// A number that points share iff they differ at most in constant biases and in settings of
    /// other lights.
    [[nodiscard]] std::uint64_t curve_group(const SweepPoint& point) const;

    /// The point's job.
    /// @throws InputError  if its keys are incompatible.
    [[nodiscard]] Job job(const SweepPoint& point) const;
    /// The settings that the point's job is given (`scene::given_keys`), even if incompatible.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>>
    given_keys(const SweepPoint& point) const;
    /// Changes a job to that of another point in its curve group; much faster than `job`.
    void set_constant_bias(Job& job, const SweepPoint& point) const;
    /// The point's constant bias without the axes: from the file, its case and the overrides; 0 if
    /// that is incompatible with the point's other keys.
    [[nodiscard]] BiasSettings own_constant_bias(const SweepPoint& point) const;

private:
    void replace_axes(const std::vector<std::string>& arguments);
    void keep_case(std::string_view name);
    void check_axes_of_lights() const;
    void check_keys() const;
    void resolve_values();
    void check_repetitions() const;
    [[nodiscard]] std::vector<std::size_t> zipped_groups_of(std::size_t light) const;
    void number_zipped_groups();
    void count();

    [[nodiscard]] std::size_t light_count() const
    {
        return std::max<std::size_t>(1, lights().size());
    }
    [[nodiscard]] bool is_set(const Layer& layer, std::size_t axis) const;
    [[nodiscard]] Layer axis_settings(const SweepPoint& point) const;
    [[nodiscard]] const CaseLayer* chosen_case(const SweepPoint& point) const;
    [[nodiscard]] bool is_zipped() const { return source_.sweep.mode == "zip"; }

    JobSource source_;
    std::vector<WrittenKey> keys_; ///< the axes'
    std::vector<Layer> values_;    ///< each axis's values as settings
    /// By axis and value, the first equal value: with zip, values may repeat.
    std::vector<std::vector<std::size_t>> first_equal_;
    /// With zip, by light and index, the first index whose values for this light differ at most in
    /// constant biases.
    std::vector<std::vector<std::size_t>> zipped_groups_;
    std::uint64_t size_ = 0;
    std::vector<std::uint64_t> sample_; ///< ascending numbers of the whole space; empty: all
};

/// The axes' values at a point, the case's name first: "noon, shadow_map.resolution 512".
/// @param with_bias  also the constant bias.
[[nodiscard]] std::string point_text(const SweepSpace& space, const SweepPoint& point,
                                     bool with_bias);

} // namespace gnomon::scene
