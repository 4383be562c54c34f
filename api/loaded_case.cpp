#include "api/loaded_case.hpp"

#include "analysis/evaluate/evaluate.hpp"
#include "reference_rt/truth.hpp"
#include "scene/case/file.hpp"
#include "scene/case/space.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/load/load_scene.hpp"
#include "scene/text.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::api {
namespace {

/// Runs `work`, and rewrites its errors to name the case's keys.
template <typename Work>
auto with_case_errors(const scene::CaseFile& file, const Work& work)
{
    try {
        return work();
    } catch (const scene::InputError& error) {
        throw scene::InputError(scene::case_message(file, error.what()));
    }
}

scene::TriangleScene load_mesh(const scene::CaseFile& file)
{
    return with_case_errors(file, [&] {
        // Offsets are compared along both kinds of normals.
        const bool is_offset = file.says("bias.normal_texels") || file.says("bias.normal_m") ||
                               file.says("bias.normal_from");
        const auto normals = is_offset ? scene::VertexNormals::kept : scene::VertexNormals::dropped;
        return scene::load_scene(scene::make_job(file.source).scene, normals).scene;
    });
}

} // namespace

CaseMesh::CaseMesh(const scene::CaseFile& file, int threads)
    : CaseMesh{load_mesh(file), file.space, threads}
{
}

CaseMesh::CaseMesh(scene::TriangleScene mesh, const scene::CaseSpace& space, int threads)
    : mesh_{scene::move_to_space(std::move(mesh), space)},
      scene_{mesh_, {threads}},
      reference_{scene_, {reference_rt::TruthMethod::exact, threads}}
{
}

LoadedCase::LoadedCase(scene::CaseFile file, scene::CaseLayers layers, const CaseMesh& mesh)
    : file_{std::move(file)},
      layers_{std::move(layers)},
      mesh_{mesh}
{
    set_image_size();
    if (!layers_.has_positions) {
        with_case_errors(file_, [&] { take_positions(); });
    }
}

analysis::CheckedCase LoadedCase::check(std::optional<double> tolerance_m) const
{
    return with_case_errors(
        file_, [&] { return analysis::check_case(subject(), mesh_.truth(), tolerance_m); });
}

analysis::Comparison LoadedCase::evaluate(analysis::CheckedCase checked) const
{
    return analysis::evaluate(subject(), std::move(checked), mesh_.truth(),
                              {file_.renderer, std::string{analysis::Environment::other_renderer},
                               reference_rt::embree_version(), GNOMON_VERSION});
}

/// Takes positions from the camera's pixel centres.
void LoadedCase::take_positions()
{
    scene::Job job = scene::make_job(file_.source);
    job.image = layers_.size();
    const scene::View view = scene::resolve_view(job, mesh_.triangles(), {});
    try {
        analysis::take_camera_positions(layers_, mesh_.triangles(), view,
                                        mesh_.truth().seen_points(view), file_.space.is_mirrored());
    } catch (const scene::InputError& error) {
        throw scene::InputError(fmt::format("{}: {}", file_.source.name, error.what()));
    }
}

/// Sets the image size keys, as a run's configuration names them.
void LoadedCase::set_image_size()
{
    const scene::ImageSize size = layers_.size();
    for (const auto& [key, pixels] :
         {std::pair{"image.width", size.width_px}, {"image.height", size.height_px}}) {
        file_.source.file.push_back({file_.source.keys->find(key), std::int64_t{pixels},
                                     scene::one_line(file_.images.front().path.string())});
    }
}

} // namespace gnomon::api
