#pragma once

#include "analysis/results/results.hpp"
#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/runner.hpp"
#include "analysis/sweep/scene_identity.hpp"
#include "scene/job/sweep/sweep_space.hpp"
#include "scene/settings/job.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::analysis {

/// Configurations that no stage is run for, and why.
struct Refusal {
    std::vector<std::uint64_t> ordinals; ///< ascending
    std::string message;
    Retry retry = Retry::is_useless;
};

/// All configurations of a sweep, sorted into bias curves: the jobs behind the numbers.
class SweepCurves {
public:
    /// @param space             must outlive this.
    /// @param keeps_every_bias  each configuration is a request of its own, to keep its pixels.
    /// @param version           of the program: part of every id.
    SweepCurves(const scene::SweepSpace& space, bool keeps_every_bias, std::string version);
    SweepCurves(const scene::SweepSpace&& space, bool keeps_every_bias,
                std::string version) = delete;
    /// Of a part of the sweep alone: whole bias curves.
    /// @param ordinals  the part's configurations, ascending.
    SweepCurves(const scene::SweepSpace& space, std::span<const std::uint64_t> ordinals,
                std::string version);

    /// One for each bias curve, in the order of their first configurations.
    [[nodiscard]] const std::vector<CurveRequest>& requests() const { return requests_; }
    /// Configurations whose keys do not go together.
    [[nodiscard]] const std::vector<Refusal>& refusals() const { return refusals_; }

    /// The job of the request's first configuration.
    [[nodiscard]] scene::Job job(std::size_t request) const;
    /// @param scene  the request's, which could be read.
    [[nodiscard]] SweepTask task(std::size_t request, const SceneIdentity& scene) const;

    /// The request's curve: equal for requests that differ in nothing but the place of the same
    /// scene.
    [[nodiscard]] std::string curve_key(std::size_t request, const SceneIdentity& scene) const;
    /// Whether two ordinals may stand for the same configuration; false only if none do.
    /// @param scenes  of all requests, in their order.
    [[nodiscard]] bool may_repeat(std::span<const SceneIdentity> scenes) const;

    using Visit = std::function<void(const Configuration&)>;
    /// Calls `visit` with each of the request's configurations.
    /// @param scene  the request's; if it cannot be read, its file stands for it in the ids.
    /// @param shard  that computes them.
    void describe(std::size_t request, const SceneIdentity& scene, const Visit& visit,
                  std::uint32_t shard = 1) const;
    /// The same for the refused ones, which are described by the keys that they are given.
    void describe(const Refusal& refusal, const Visit& visit, std::uint32_t shard = 1) const;

private:
    /// Sorts configurations into groups that differ in the constant bias alone, in the order of
    /// their first ones.
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
