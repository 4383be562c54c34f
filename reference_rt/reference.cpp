#include "reference_rt/reference.hpp"

#include "reference_rt/light/light_queries.hpp"
#include "reference_rt/rounded/rounded_truth.hpp"
#include "reference_rt/truth.hpp"

namespace gnomon::reference_rt {

scene::Truth EmbreeReference::find_truth(const scene::View& view,
                                         const scene::ReceiverLayers& receivers,
                                         const renderers::RasterFacts& raster) const
{
    return compute_truth(scene_, view, receivers.triangle, raster, options_);
}

std::string EmbreeReference::truth_method() const
{
    return options_.method == TruthMethod::plain ? "float" : "exact";
}

std::unique_ptr<renderers::LightQueries>
EmbreeReference::make_light_queries(const scene::Job& job, const scene::View& view,
                                    const scene::ReceiverLayers& receivers) const
{
    return reference_rt::make_light_queries(scene_, view, receivers.triangle,
                                            job.shadow_map.resolution_texels, job.shadow_map.cull,
                                            options_.threads);
}

scene::Image<scene::Vec3f> EmbreeReference::seen_points(const scene::View& view) const
{
    return receiver_points(scene_.triangles(), view,
                           first_triangles(scene_, view, options_.threads));
}

std::vector<scene::NearestSurface>
EmbreeReference::nearest_surfaces(std::span<const scene::Vec3d> points,
                                  std::span<const scene::SurfaceScope> scopes) const
{
    return reference_rt::nearest_surfaces(scene_, points, scopes, options_.threads);
}

scene::RoundedTruth
EmbreeReference::find_rounded_truth(const scene::Light& light,
                                    const scene::RoundedReceivers& receivers) const
{
    return compute_rounded_truth(scene_, light, receivers, options_.threads);
}

std::vector<renderers::BlockerHit> EmbreeReference::find_rounded_blockers(
    const scene::Light& light, const scene::RoundedReceivers& receivers,
    const scene::RoundedTruth& truth, std::span<const std::size_t> pixels) const
{
    return reference_rt::find_rounded_blockers(scene_, light, receivers, truth, pixels,
                                               options_.threads);
}

} // namespace gnomon::reference_rt
