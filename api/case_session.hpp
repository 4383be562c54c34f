#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/evaluate/checked_case.hpp"
#include "reference_rt/reference.hpp"
#include "reference_rt/reference_scene.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"

#include <optional>

namespace gnomon::api {

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
    /// Valid as long as this.
    [[nodiscard]] const renderers::RoundedReference& truth() const { return reference_; }

private:
    scene::TriangleScene mesh_;
    reference_rt::ReferenceScene scene_;
    reference_rt::EmbreeReference reference_;
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
    [[nodiscard]] analysis::CheckedCase check(std::optional<double> tolerance_m) const;
    /// `analysis::evaluate`.
    /// @param checked  without a mistake.
    [[nodiscard]] analysis::Comparison evaluate(analysis::CheckedCase checked) const;

private:
    void take_positions();
    void set_image_size();

    scene::CaseFile file_;
    scene::CaseLayers layers_;
    const CaseMesh& mesh_;
};

} // namespace gnomon::api
