#include "compared.hpp"
#include "lane.hpp"
#include "methods_job.hpp"
#include "placed_scene.hpp"
#include "scene/job/file.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <random>

/// Random cameras, also inside objects and so close to surfaces that the near plane cuts them:
/// every difference between GL's receiver and the exact ray's is explained.
namespace gnomon::tests {
namespace {

using scene::ClassReason;
using scene::Vec3d;

class RandomCamera {
public:
    RandomCamera(const scene::TriangleScene& scene, unsigned seed) : scene_{scene}, random_{seed} {}

    /// In turn: outside the scene, orthographic inside it, and next to a vertex.
    [[nodiscard]] scene::CameraSettings operator()(int turn)
    {
        const scene::Box box = scene_.bounds();
        const double diagonal_m = box.diagonal_m();
        scene::CameraSettings camera;
        camera.target = box.centre() + 0.2 * diagonal_m * vector();
        camera.eye = camera.target +
                     diagonal_m * std::exp2(2.5 * number_(random_)) * glm::normalize(vector());
        camera.orthographic_height_m = diagonal_m * std::exp2(2 * number_(random_));
        if (turn % 3 == 1) {
            camera.projection = scene::Projection::orthographic;
            camera.eye = camera.target + 0.2 * diagonal_m * vector();
        } else if (turn % 3 == 2) {
            const auto vertex = random_() % scene_.vertices.size();
            camera.eye = Vec3d{scene_.vertices[vertex]} +
                         diagonal_m * std::exp2(-14 + 10 * number_(random_)) * vector();
        }
        return camera;
    }

private:
    Vec3d vector() { return {number_(random_), number_(random_), number_(random_)}; }

    const scene::TriangleScene& scene_;
    std::mt19937 random_;
    std::uniform_real_distribution<double> number_{-1, 1};
};

TEST(RandomViews, LeaveNothingUnexplained)
{
    GNOMON_REQUIRE_GL();
    const int views = in_lane(3, 300);
    for (const char* const name : {"wall", "fence", "yard"}) {
        const scene::Job job = tests::builtin_job(name).job;
        const scene::SceneFile file = scene::load_scene(job.scene);
        for (const double diagonals : {0.0, 100.0, 1000.0}) {
            const Placed placed = place(job, file, {"", 1, diagonals});
            const Compared compared{placed.file};
            RandomCamera next_camera{placed.file.scene, 2};
            for (int i = 0; i < views; ++i) {
                scene::Job view = placed.job;
                view.camera = next_camera(i);
                view.image = {240, 160};
                EXPECT_EQ(compared(view).metrics.pixels.of(ClassReason::mismatch), 0U)
                    << name << ", " << diagonals << " diagonals away, view " << i;
            }
        }
    }
}

} // namespace
} // namespace gnomon::tests
