#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::reference_rt {

enum class TruthMethod : std::uint8_t {
    exact, ///< Embree proposes candidates, exact predicates decide
    plain, ///< float Embree rays, trusting GL's triangles; for comparing speed
};

struct TruthOptions {
    TruthMethod method = TruthMethod::exact;
    int threads = 0; ///< 0 for all cores
};

/// The hierarchies that a reference scene builds.
struct ReferenceOptions {
    int threads = 0;                ///< for building; 0 for all cores
    bool serves_exact_truth = true; ///< TruthMethod::exact and `nearest_blockers`
    bool serves_plain_rays = false; ///< TruthMethod::plain and `audit_float_methods`
    std::string embree_isa{};       ///< "sse4.2", "avx2", …; empty for the best available
    /// The allowed error, in each component, of the start points of exact segments [m].
    double start_error_m = 0;
};

/// The scene with its Embree hierarchies. Immutable, so any number of threads may use it.
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
    /// Takes over an implementation, for tests.
    explicit ReferenceScene(std::unique_ptr<Implementation> implementation);
    [[nodiscard]] const Implementation& implementation() const { return *implementation_; }

private:
    std::unique_ptr<Implementation> implementation_;
};

} // namespace gnomon::reference_rt
