#pragma once

#include "analysis/advice/checked_views.hpp"
#include "analysis/tune/tune.hpp"
#include "scene/import/scene_file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {

/// The memory that maps may take, for every method.
struct MapBudget {
    std::uint64_t max_bytes = 0; ///< of all maps of the light together
    int max_resolution_texels = 4096;
};

/// The largest side with which the job's maps stay within the budget: a multiple of 16, a power of
/// two for stabilised cascades, or the job's own if that is larger and fits.
/// @return  [texels]; 0 if none fits; the job's own if its method has no map.
[[nodiscard]] int largest_resolution(const scene::Job& job, const MapBudget& budget);

/// The values of a key that a search tries: its default, and those that its row names, in the key's
/// unit.
/// @param diagonal_m, texel_width_m  Lengths in which a row may count [m]; > 0.
[[nodiscard]] std::vector<scene::JobValue> tried_values(const scene::Key& key, double diagonal_m,
                                                        double texel_width_m);

/// The settings of one method that a search tries, along axes: each lists the values of one key, or
/// of keys that belong together. The method's keys and their rows determine the axes. Maps are as
/// large as the budget allows.
class MethodSpace {
public:
    /// All arguments but `method` must outlive it.
    /// @param method  The name of a known method.
    MethodSpace(const scene::Job& job, const std::string& method, const scene::SceneFile& file,
                const CheckedViews& views, const MapBudget& budget);
    MethodSpace(const MethodSpace&) = delete; // axes refer to it
    MethodSpace& operator=(const MethodSpace&) = delete;
    ~MethodSpace() = default;

    /// Possible starts of the search, in order of preference: the job's own settings, as far as the
    /// method has them; with other formats and without culling; without the job's bias terms.
    [[nodiscard]] std::vector<TunedSetting> starts() const;
    [[nodiscard]] std::size_t axis_count() const { return axes_.size(); }
    /// The setting with each other value of an axis.
    [[nodiscard]] std::vector<TunedSetting> along(std::size_t axis, const TunedSetting& from) const;
    /// The most settings that a search tries in so many passes along every axis.
    [[nodiscard]] std::size_t most_settings(std::size_t rounds) const;

private:
    struct Axis {
        std::function<std::vector<TunedSetting>(const TunedSetting&)> others;
        std::size_t most = 0; ///< the most that `others` returns
    };
    [[nodiscard]] bool has(std::string_view key) const;
    void add_map_axes();
    void add_lookup_axes();
    void add_added_axes(std::string_view table);
    void add_culls();
    void set_key(scene::MethodSettings& method, const scene::Key& key,
                 const scene::JobValue& value) const;
    [[nodiscard]] TunedSetting fitted(TunedSetting setting) const;
    [[nodiscard]] std::vector<scene::JobValue> values_of(const scene::Key& key,
                                                         const TunedSetting& from) const;
    [[nodiscard]] scene::LightFrustum first_map(const TunedSetting& setting) const;

    const scene::Job& job_;
    std::string method_;
    const scene::SceneFile& file_;
    const CheckedViews& views_;
    MapBudget budget_;
    std::vector<Axis> axes_;
};

} // namespace gnomon::analysis
