#include "cli/session/case_session.hpp"

#include "analysis/evaluate/camera_positions.hpp"
#include "analysis/evaluate/check_case.hpp"
#include "reference_rt/light/exact_light.hpp"
#include "reference_rt/rounded/rounded_truth.hpp"
#include "scene/case/read_file.hpp"
#include "scene/case/space.hpp"
#include "scene/error.hpp"
#include "scene/job/key_table.hpp"
#include "scene/load_scene.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::cli {
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
      reference_{mesh_, {threads}},
      threads_{threads}
{
}

scene::Image<scene::Vec3f> CaseMesh::seen_points(const scene::View& view) const
{
    return reference_rt::receiver_points(mesh_, view,
                                         reference_rt::first_triangles(reference_, view, threads_));
}

analysis::CaseTruth CaseMesh::truth() const
{
    analysis::CaseTruth truth;
    truth.nearest_surfaces = [this](std::span<const scene::Vec3d> points,
                                    std::span<const scene::SurfaceScope> scopes) {
        return reference_rt::nearest_surfaces(reference_, points, scopes, threads_);
    };
    truth.seen_points = [this](const scene::View& view) { return seen_points(view); };
    truth.find_truth = [this](const scene::Light& light, const scene::RoundedReceivers& receivers) {
        return reference_rt::compute_rounded_truth(reference_, light, receivers, threads_);
    };
    truth.find_blockers =
        [this](const scene::Light& light, const scene::RoundedReceivers& receivers,
               const scene::RoundedTruth& found, std::span<const std::size_t> pixels) {
            return reference_rt::find_rounded_blockers(reference_, light, receivers, found, pixels,
                                                       threads_);
        };
    truth.make_exact_light = [this](const scene::Job& job, const scene::View& view,
                                    const scene::ReceiverLayers& receivers) {
        return reference_rt::make_exact_light(reference_, view, receivers.triangle,
                                              job.shadow_map.resolution_texels, job.shadow_map.cull,
                                              threads_);
    };
    truth.embree = reference_rt::embree_version();
    truth.gnomon = GNOMON_VERSION;
    return truth;
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

analysis::CheckedCase CaseSession::check(const analysis::CaseTruth& truth,
                                         std::optional<double> tolerance_m) const
{
    return in_words_of(file_, [&] { return analysis::check_case(subject(), truth, tolerance_m); });
}

/// What the centres of the camera's pixels show.
void CaseSession::take_positions()
{
    scene::Job job = scene::make_job(file_.source);
    job.image = layers_.size();
    const scene::View view = scene::resolve_view(job, mesh_.triangles(), {});
    try {
        analysis::take_camera_positions(layers_, mesh_.triangles(), view, mesh_.seen_points(view),
                                        file_.space.is_mirrored());
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

} // namespace gnomon::cli
