#pragma once

#include "analysis/comparison/comparison.hpp"
#include "scene/job/file.hpp"

#include <memory>
#include <string>

namespace gnomon::analysis {

/// Compares a job with each of its lights, one after the other. Receivers that lights have in
/// common, as they have with `lookup.position = "pixel"`, are drawn once.
class LightComparisons {
public:
    /// @param file, renderers  must outlive this; `file` also the comparisons.
    LightComparisons(const scene::SceneFile& file, const Renderers& renderers);
    LightComparisons(const LightComparisons&) = delete;
    LightComparisons& operator=(const LightComparisons&) = delete;

    /// As `analysis::compare` of the light's job.
    [[nodiscard]] Comparison compare(const scene::LightJob& job);

private:
    const scene::SceneFile& file_;
    const Renderers& renderers_;
    std::string kept_; ///< stage key of the receivers
    std::shared_ptr<const renderers::Receivers> receivers_;
};

} // namespace gnomon::analysis
