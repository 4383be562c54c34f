#pragma once

#include "analysis/comparison/comparison.hpp"
#include "analysis/evaluate/evaluate.hpp"
#include "reference_rt/reference.hpp"
#include "reference_rt/reference_scene.hpp"
#include "scene/case/case_layers.hpp"
#include "scene/case/file.hpp"
#include "scene/geometry/triangles.hpp"

#include <optional>

namespace gnomon::api {

/// A mesh in a renderer's space, loaded by Embree for any number of cases.
class CaseMesh {
public:
    /// @param threads  of the reference; 0 for all cores.
    /// @throws scene::InputError  as `scene::load_scene` and `scene::move_to_space`, naming the
    ///                            case's keys.
    CaseMesh(const scene::CaseFile& file, int threads);
    /// For a scene in memory, with its roles.
    CaseMesh(scene::TriangleScene mesh, const scene::CaseSpace& space, int threads);

    [[nodiscard]] const scene::TriangleScene& triangles() const { return mesh_; }
    /// Valid as long as this object.
    [[nodiscard]] const renderers::RoundedReference& truth() const { return reference_; }

private:
    scene::TriangleScene mesh_;
    reference_rt::ReferenceScene scene_;
    reference_rt::EmbreeReference reference_;
};

/// A case with its images in memory.
class LoadedCase {
public:
    /// @param mesh  the case's mesh; it must outlive this object.
    LoadedCase(scene::CaseFile file, scene::CaseLayers layers, const CaseMesh& mesh);

    [[nodiscard]] const scene::CaseFile& file() const { return file_; }
    [[nodiscard]] const scene::CaseLayers& layers() const { return layers_; }
    [[nodiscard]] analysis::Case subject() const { return {file_, layers_, mesh_.triangles()}; }

    /// Calls `analysis::check_case`; errors name the case's keys.
    [[nodiscard]] analysis::CheckedCase check(std::optional<double> tolerance_m) const;
    /// Calls `analysis::evaluate`.
    /// @param checked  a check that found no mistake.
    [[nodiscard]] analysis::Comparison evaluate(analysis::CheckedCase checked) const;

private:
    void take_positions();
    void set_image_size();

    scene::CaseFile file_;
    scene::CaseLayers layers_;
    const CaseMesh& mesh_;
};

} // namespace gnomon::api
