#pragma once

#include "analysis/tune/tune_goal.hpp"
#include "analysis/tune/tuned_setting.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace gnomon::analysis {

/// The settings that a search has tried, and which of them are the best. What is said of errors is
/// of the job's own view.
class TriedSettings {
public:
    /// @param goal  must outlive this.
    explicit TriedSettings(const TuneGoal& goal) : goal_{goal} {}

    void add(TunedSetting setting) { all_.push_back(std::move(setting)); }
    [[nodiscard]] bool empty() const { return all_.empty(); }
    [[nodiscard]] std::size_t size() const { return all_.size(); }
    [[nodiscard]] const TunedSetting& operator[](std::size_t index) const { return all_[index]; }
    [[nodiscard]] TunedSetting& operator[](std::size_t index) { return all_[index]; }
    [[nodiscard]] std::vector<TunedSetting> take() { return std::move(all_); }

    /// Whether the mean of a's amount rates is below that of b.
    [[nodiscard]] bool is_less_wrong(std::size_t a, std::size_t b) const;
    /// The least wrong from one index on, of several the cheapest. There must be one.
    [[nodiscard]] std::size_t least_wrong(std::size_t first = 0) const;
    /// What the goal's limits come to, as far as is known.
    [[nodiscard]] TuneLimits limits() const;
    /// Limits without those that are relative: the recommended bias tells what is possible.
    [[nodiscard]] TuneLimits absolute_limits() const;
    /// The best of those that meet the limits in all views that they were looked at in.
    [[nodiscard]] std::optional<std::size_t> cheapest_meeting(const TuneLimits& limits) const;

private:
    const TuneGoal& goal_;
    std::vector<TunedSetting> all_; ///< in the order in which they were tried
};

/// Whether the setting meets the limits in every view that it was looked at in.
[[nodiscard]] bool meets_in_its_views(const TunedSetting& setting, const TuneLimits& limits);

} // namespace gnomon::analysis
