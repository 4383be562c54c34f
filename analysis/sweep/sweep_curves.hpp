#pragma once

#include "analysis/results/results.hpp"
#include "analysis/sweep/configuration_id.hpp"
#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/runner.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "scene/settings/job.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// Configurations that no stage runs for, and why.
struct Refusal {
    std::vector<std::uint64_t> ordinals; ///< ascending
    std::string message;
    Retry retry = Retry::is_useless;
};

/// All configurations of a sweep, grouped into bias curves, with their jobs.
class SweepCurves {
public:
    /// @param space             Must outlive this.
    /// @param keeps_every_bias  Each configuration is its own request, to keep its pixels.
    /// @param version           Gnomon's; part of every id.
    SweepCurves(const scene::SweepSpace& space, bool keeps_every_bias, std::string version);
    SweepCurves(const scene::SweepSpace&& space, bool keeps_every_bias,
                std::string version) = delete;
    /// Covers a part of the sweep: whole bias curves.
    /// @param ordinals  The part's configurations, ascending.
    SweepCurves(const scene::SweepSpace& space, std::span<const std::uint64_t> ordinals,
                std::string version);

    /// One for each bias curve, in the order of their first configurations.
    [[nodiscard]] const std::vector<CurveRequest>& requests() const { return requests_; }
    /// Configurations whose keys contradict each other.
    [[nodiscard]] const std::vector<Refusal>& refusals() const { return refusals_; }

    /// The job of the request's first configuration.
    [[nodiscard]] scene::Job job(std::size_t request) const;
    /// @param scene  The request's; it must be readable.
    [[nodiscard]] SweepTask task(std::size_t request, const SceneIdentity& scene) const;

    /// The request's curve: equal for requests that differ only in the path of one scene.
    [[nodiscard]] std::string curve_key(std::size_t request, const SceneIdentity& scene) const;
    /// Whether two ordinals may name one configuration; false is certain.
    /// @param scenes  Of all requests, in order.
    [[nodiscard]] bool may_repeat(std::span<const SceneIdentity> scenes) const;

    using Visit = std::function<void(const Configuration&)>;
    /// Calls `visit` with each of the request's configurations.
    /// @param scene  The request's; if unreadable, its file replaces it in the ids.
    /// @param shard  That computes them.
    void describe(std::size_t request, const SceneIdentity& scene, const Visit& visit,
                  std::uint32_t shard = 1) const;
    /// Calls `visit` with the refused configurations, with the keys that they set.
    void describe(const Refusal& refusal, const Visit& visit, std::uint32_t shard = 1) const;

private:
    /// Groups configurations that differ only in the constant bias, by their first ones.
    class Groups;
    void add_curve_group(std::vector<std::uint64_t> ordinals);
    void add_request(const scene::Job& job, std::vector<std::uint64_t> ordinals);
    [[nodiscard]] bool has_equal_biases(const CurveRequest& request) const;

    const scene::SweepSpace& space_;
    bool keeps_every_bias_;
    std::string version_;
    std::vector<CurveRequest> requests_;
    std::vector<Refusal> refusals_;
};

} // namespace gnomon::analysis
