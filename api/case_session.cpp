#include "api/case_session.hpp"

#include "analysis/evaluate/camera_positions.hpp"
#include "analysis/evaluate/check_case.hpp"
#include "analysis/evaluate/evaluate.hpp"
#include "reference_rt/truth.hpp"
#include "scene/case/read_file.hpp"
#include "scene/case/space.hpp"
#include "scene/error.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/load/load_scene.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::api {
namespace {

/// Does the work; what it refuses about keys is said of those that the case has.
template <typename Work>
auto in_words_of(const scene::CaseFile& file, const Work& work)
{
    try {
        return work();
    } catch (const scene::InputError& error) {
        throw scene::InputError(scene::case_message(file, error.what()));
    }
}

scene::TriangleScene load_mesh(const scene::CaseFile& file)
{
    return in_words_of(file, [&] {
        // An offset is compared with those of both kinds.
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

CaseSession::CaseSession(scene::CaseFile file, scene::CaseLayers layers, const CaseMesh& mesh)
    : file_{std::move(file)},
      layers_{std::move(layers)},
      mesh_{mesh}
{
    set_image_size();
    if (!layers_.has_positions) {
        in_words_of(file_, [&] { take_positions(); });
    }
}

analysis::CheckedCase CaseSession::check(std::optional<double> tolerance_m) const
{
    return in_words_of(file_,
                       [&] { return analysis::check_case(subject(), mesh_.truth(), tolerance_m); });
}

analysis::Comparison CaseSession::evaluate(analysis::CheckedCase checked) const
{
    return analysis::evaluate(subject(), std::move(checked), mesh_.truth(),
                              {file_.renderer, std::string{analysis::Environment::other_renderer},
                               reference_rt::embree_version(), GNOMON_VERSION});
}

/// What the centres of the camera's pixels show.
void CaseSession::take_positions()
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

/// The image says it, and a run's configuration names it.
void CaseSession::set_image_size()
{
    const scene::ImageSize size = layers_.size();
    for (const auto& [key, pixels] :
         {std::pair{"image.width", size.width_px}, {"image.height", size.height_px}}) {
        file_.source.file.push_back({file_.source.keys->find(key), std::int64_t{pixels},
                                     scene::one_line(file_.images.front().path.string())});
    }
}

} // namespace gnomon::api
