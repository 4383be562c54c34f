#include "reference_rt/pixels/first_hit.hpp"
#include "reference_rt/truth.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace gnomon::reference_rt {

scene::Image<std::uint32_t> first_triangles(const ReferenceScene& reference,
                                            const scene::View& view, int threads)
{
    const ReferenceScene::Implementation& implementation = reference.implementation();
    const FirstHits hits{implementation, view, {}};
    scene::Image<std::uint32_t> first{view.image, scene::no_triangle};
    tbb::task_arena arena{threads > 0 ? threads : tbb::task_arena::automatic};
    arena.execute([&] {
        tbb::parallel_for(0, view.image.height_px, [&](int y) {
            SignCounts ignored;
            for (int x = 0; x < view.image.width_px; ++x) {
                const CameraRay ray{scene::pixel_ray(view.camera, view.image, x, y)};
                const auto met = hits.first_hits(ray, ignored);
                first(x, y) = met.empty() ? scene::no_triangle : std::ranges::min(met);
            }
        });
    });
    implementation.errors.check("first_triangles");
    return first;
}

} // namespace gnomon::reference_rt
