#pragma once

#include "analysis/evaluate/case_truth.hpp"
#include "analysis/evaluate/checked_case.hpp"
#include "reference_rt/truth.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/triangles.hpp"

#include <optional>

namespace gnomon::cli {

/// A case's mesh in the renderer's space, loaded by Embree: for any number of cases that have it.
class CaseMesh {
public:
    /// @param threads  of the reference; 0: all cores.
    /// @throws scene::InputError  in the case's words, as `scene::load_scene` and
    ///                            `scene::move_to_space` do.
    CaseMesh(const scene::CaseFile& file, int threads);
    /// Of a scene in memory, with its roles.
    CaseMesh(scene::TriangleScene mesh, const scene::CaseSpace& space, int threads);

    [[nodiscard]] const scene::TriangleScene& triangles() const { return mesh_; }
    [[nodiscard]] const reference_rt::ReferenceScene& reference() const { return reference_; }
    [[nodiscard]] int threads() const { return threads_; }
    /// What the pixel centres of a view show: P, or NaN.
    [[nodiscard]] scene::Image<scene::Vec3f> seen_points(const scene::View& view) const;
    /// Valid as long as this.
    [[nodiscard]] analysis::CaseTruth truth() const;

private:
    scene::TriangleScene mesh_;
    reference_rt::ReferenceScene reference_;
    int threads_ = 0;
};

/// A case with everything that it names in memory.
class CaseSession {
public:
    /// @param mesh  of the case; it must outlive this.
    CaseSession(scene::CaseFile file, scene::CaseLayers layers, const CaseMesh& mesh);

    [[nodiscard]] const scene::CaseFile& file() const { return file_; }
    [[nodiscard]] const scene::CaseLayers& layers() const { return layers_; }
    [[nodiscard]] analysis::Case subject() const { return {file_, layers_, mesh_.triangles()}; }

    /// `analysis::check_case`, whose refusals are in the case's words.
    [[nodiscard]] analysis::CheckedCase check(const analysis::CaseTruth& truth,
                                              std::optional<double> tolerance_m) const;

private:
    void take_positions();
    void set_image_size();

    scene::CaseFile file_;
    scene::CaseLayers layers_;
    const CaseMesh& mesh_;
};

} // namespace gnomon::cli
