#include "analysis/comparison/enclosed_light.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::analysis {
namespace {

using scene::PixelClass;
using scene::SceneBuilder;
using scene::Vec3d;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Corner = std::array<std::uint32_t, 3>;

/// A lamp at (0, 2, 0) over a floor, and a camera at (0, 3, 6). Every pixel shows the floor and is
/// blocked.
class Lamp {
public:
    Lamp()
    {
        const std::vector<Vec3d> corners{{-99, 0, 99}, {99, 0, 99}, {0, 0, -99}};
        builder_.add("floor", corners, std::vector<Corner>{{0, 1, 2}});
    }

    /// Adds a box without the faces from `left_out` on; its faces are visible from outside, or from
    /// inside.
    Lamp& add_box(std::string_view name, const Vec3d& centre, double half_m,
                  std::size_t left_out = 6, bool is_turned = false)
    {
        std::vector<Vec3d> corners;
        for (unsigned i = 0; i < 8; ++i) {
            const Vec3d side{(i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1,
                             (i & 4U) != 0 ? 1 : -1};
            corners.push_back(centre + half_m * side);
        }
        constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
            {{0, 4, 6, 2}, {1, 3, 7, 5}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}}};
        std::vector<Corner> triangles;
        for (std::size_t f = 0; f < left_out; ++f) {
            const auto [a, b, c, d] = faces.at(f);
            triangles.push_back(is_turned ? Corner{a, c, b} : Corner{a, b, c});
            triangles.push_back(is_turned ? Corner{a, d, c} : Corner{a, c, d});
        }
        builder_.add(name, corners, triangles);
        return *this;
    }

    /// @param lit   Number of lit pixels among the 1600.
    /// @param seen  The triangle that 801 of the pixels show.
    [[nodiscard]] std::vector<std::string> find(std::uint64_t lit = 0, std::uint32_t seen = 0,
                                                scene::LightType type = scene::LightType::point)
    {
        const scene::TriangleScene scene = builder_.take();
        scene::CameraSettings camera;
        camera.eye = {0, 3, 6};
        camera.target = {0, 0, 0};
        scene::LightSettings light;
        light.type = type;
        light.position = Vec3d{0, 2, 0};
        light.target = Vec3d{0, 0, 0};
        light.direction = Vec3d{0, -1, 0};
        const scene::View view{
            scene::make_camera(camera), {40, 40}, scene::make_light(light), {}, {}};
        scene::Image<std::uint32_t> receivers{view.image, 0};
        scene::Image<PixelClass> classes{view.image, PixelClass::blocked};
        for (std::size_t i = 0; i < classes.pixel_count() / 2 + 1; ++i) {
            receivers[i] = seen;
        }
        for (std::uint64_t i = 0; i < lit; ++i) {
            classes[classes.pixel_count() - 1 - i] = PixelClass::lit;
        }
        return objects_around_light(scene, view, receivers, classes);
    }

private:
    SceneBuilder builder_;
};

const Vec3d lamp{0.02, 2.01, 0.03}; // the light is not in the middle

TEST(ObjectsAroundLight, AreTheBulbHoweverItsFacesAreTurned)
{
    for (const bool is_turned : {false, true}) {
        EXPECT_THAT(Lamp{}.add_box("bulb", lamp, 0.1, 6, is_turned).find(), ElementsAre("bulb"));
    }
}

TEST(ObjectsAroundLight, AreAllThatAreToBeTakenAway)
{
    EXPECT_THAT(Lamp{}
                    .add_box("bulb", lamp, 0.1)
                    .add_box("shade", lamp, 0.4)
                    .add_box("crate", {2, 1, 0}, 1)
                    .find(),
                ElementsAre("bulb", "shade"));
}

TEST(ObjectsAroundLight, AreNotTheRoomThatHasTheCameraInIt)
{
    // The floor is 2 m below the light, the eye 6 m beside it: both lie within.
    EXPECT_THAT(Lamp{}.add_box("room", {0, 2, 0}, 500).find(), IsEmpty());
    EXPECT_THAT(Lamp{}.add_box("bulb", lamp, 0.1).add_box("room", {0, 2, 0}, 500).find(),
                ElementsAre("bulb"));
}

TEST(ObjectsAroundLight, AreNotTheHouseThatTheCameraSees)
{
    EXPECT_THAT(Lamp{}.add_box("house", lamp, 1).find(0, 1), IsEmpty());
    EXPECT_THAT(Lamp{}.add_box("house", lamp, 1).find(0, 0), ElementsAre("house"));
}

TEST(ObjectsAroundLight, AreNotWhatStandsBesideTheLightOrIsOpen)
{
    // A face is a sixth of all directions, and one in sixteen may be open.
    EXPECT_THAT(Lamp{}.add_box("open", lamp, 0.1, 5).find(), IsEmpty());
    // The light is in the bounding box of this corner of two walls and a lid, but not inside the
    // corner.
    EXPECT_THAT(Lamp{}.add_box("corner", lamp, 0.1, 3).find(), IsEmpty());
    EXPECT_THAT(Lamp{}.add_box("beside", {0, 1, 0}, 0.5).find(), IsEmpty());
}

TEST(ObjectsAroundLight, AreNoneWhereMoreThanOnePixelInAHundredIsLit)
{
    EXPECT_THAT(Lamp{}.add_box("bulb", lamp, 0.1).find(16), ElementsAre("bulb"));
    EXPECT_THAT(Lamp{}.add_box("bulb", lamp, 0.1).find(17), IsEmpty());
}

TEST(ObjectsAroundLight, AreNoneOfADirectionalLight)
{
    EXPECT_THAT(Lamp{}.add_box("bulb", lamp, 0.1).find(0, 0, scene::LightType::directional),
                IsEmpty());
    EXPECT_THAT(Lamp{}.add_box("bulb", lamp, 0.1).find(0, 0, scene::LightType::spot),
                ElementsAre("bulb"));
}

} // namespace
} // namespace gnomon::analysis
