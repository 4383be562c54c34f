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

/// What the light of a configuration is called among what tells it from others.
inline constexpr std::string_view light_distinction = "light";

/// One point of a sweep: a case, a value on each axis, and one of the job's lights.
struct SweepPoint {
    std::size_t case_index = 0;
    std::vector<std::size_t> values; ///< index of the value, by axis
    std::size_t light_index = 0;     ///< 0 also of a job with `[light]`
};

/// All configurations that a job's cases and axes span, by number.
///
/// Cases vary slowest, then the axes in their order, then the lights; with `mode = "zip"` all axes
/// move together. `sample = N` keeps N combinations of cases and axes, drawn without replacement by
/// `seed`. With several lights each is a configuration of its own: a job with that light alone.
class SweepSpace {
public:
    /// @param axis_arguments  "KEY=VALUES" as of `--axis`: each adds an axis or replaces the
    /// file's.
    /// @param case_name       the only case to run; empty: all of them.
    /// @throws InputError  for a bad axis, a value that comes twice, a key that is an axis and also
    ///                     set by a case or an override, too many configurations, …
    SweepSpace(JobSource source, const std::vector<std::string>& axis_arguments,
               std::string_view case_name = {});

    [[nodiscard]] const KeyTable& keys() const { return *source_.keys; }

    /// Number of configurations.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    /// Names of the lights of each combination of case and axes; empty: one light without a name.
    [[nodiscard]] const std::vector<std::string>& lights() const { return source_.lights; }
    [[nodiscard]] const std::vector<SweepAxis>& axes() const { return source_.sweep.axes; }
    [[nodiscard]] const std::string& mode() const { return source_.sweep.mode; }
    [[nodiscard]] std::size_t case_count() const { return source_.cases.size(); }

    /// @param ordinal  below `size()`.
    [[nodiscard]] SweepPoint at(std::uint64_t ordinal) const;
    /// Name of the point's case; empty if the job has none.
    [[nodiscard]] std::string_view case_name(const SweepPoint& point) const;
    /// Name of the point's light; empty if the job has but one.
    [[nodiscard]] std::string_view light_name(const SweepPoint& point) const;
    /// With several lights the point's as `light`, then the axes of one light alone,
    /// "lights.sun.…", whichever it is, with their values as TOML; else nothing.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>>
    light_values(const SweepPoint& point) const;
    /// What tells the points of a case from each other: the axes' keys, and with several lights
    /// `light`.
    [[nodiscard]] std::vector<std::string> distinctions() const;
    /// Whether the axis says anything of the point's light.
    [[nodiscard]] bool concerns(std::size_t axis, const SweepPoint& point) const;
    /// Whether it is one of a constant bias, of all lights or of one.
    [[nodiscard]] bool is_bias_axis(std::size_t axis) const;

    /// A number that points share iff they differ in constant biases at most, and in what the axes
    /// say of other lights.
    [[nodiscard]] std::uint64_t curve_group(const SweepPoint& point) const;

    /// The point's job.
    /// @throws InputError  if its keys do not go together.
    [[nodiscard]] Job job(const SweepPoint& point) const;
    /// The keys that the point's job is given (`scene::given_keys`), also where they do not go
    /// together.
    [[nodiscard]] std::vector<std::pair<std::string, std::string>>
    given_keys(const SweepPoint& point) const;
    /// Makes the job of one point that of another of the same curve group; much faster than `job`.
    void set_constant_bias(Job& job, const SweepPoint& point) const;
    /// The constant bias that the point's job has but for its axes: what the file, its case and the
    /// overrides say; 0 where that does not go together with the point's other keys.
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
    /// For each value of each axis the first that equals it: with zip, values may come again.
    std::vector<std::vector<std::size_t>> first_equal_;
    /// With zip, of each light and index the first index whose values for this light differ in
    /// constant biases at most.
    std::vector<std::vector<std::size_t>> zipped_groups_;
    std::uint64_t size_ = 0;
    std::vector<std::uint64_t> sample_; ///< ascending numbers of the whole space; empty: all
};

} // namespace gnomon::scene
