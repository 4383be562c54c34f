#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::reference_rt {

enum class TruthMethod : std::uint8_t {
    exact, ///< Embree proposes, exact predicates decide
    plain, ///< float Embree rays, and GL's triangles taken as seen: for comparing speed
};

struct TruthOptions {
    TruthMethod method = TruthMethod::exact;
    int threads = 0; ///< 0: all cores
};

/// Which hierarchies a reference scene holds.
struct ReferenceOptions {
    int threads = 0;                ///< with which they are built; 0: all cores
    bool serves_exact_truth = true; ///< TruthMethod::exact and `nearest_blockers`
    bool serves_plain_rays = false; ///< TruthMethod::plain and `audit_float_methods`
    std::string embree_isa{};       ///< "sse4.2", "avx2", …; empty: the best that there is
    /// By how much, in each component, the points from which exact segments start may be off [m].
    double start_error_m = 0;
};

/// The scene with Embree's hierarchies over it; built once, then read by any number of threads.
class ReferenceScene {
public:
    /// @throws scene::EnvironmentError  if Embree fails.
    explicit ReferenceScene(const scene::TriangleScene& triangles,
                            const ReferenceOptions& options = {});
    ~ReferenceScene();
    ReferenceScene(ReferenceScene&&) noexcept;
    ReferenceScene& operator=(ReferenceScene&&) noexcept;

    [[nodiscard]] const scene::TriangleScene& triangles() const;

    struct Implementation;
    /// Takes over what was made elsewhere, as tests do.
    explicit ReferenceScene(std::unique_ptr<Implementation> implementation);
    [[nodiscard]] const Implementation& implementation() const { return *implementation_; }

private:
    std::unique_ptr<Implementation> implementation_;
};

} // namespace gnomon::reference_rt
