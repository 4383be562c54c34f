#include "api/gnomon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

struct FreesScene {
    void operator()(gnomon_scene* scene) const { gnomon_scene_free(scene); }
};
using OwnScene = std::unique_ptr<gnomon_scene, FreesScene>;

/// A ground at y = 0 from −4 to 4, a plate at y = 1 from −1 to 1, and a triangle without an area.
const std::vector<double> corners{-4, 0, -4, -4, 0, 4, 4, 0, -4, 4, 0, 4,
                                  -1, 1, -1, -1, 1, 1, 1, 1, -1, 1, 1, 1};
const std::vector<std::uint32_t> triangles{0, 1, 3, 0, 3, 2, 0, 0, 1, 4, 5, 7, 4, 7, 6};

OwnScene plate()
{
    gnomon_scene* scene = nullptr;
    EXPECT_EQ(gnomon_scene_from_arrays(corners.data(), corners.size() / 3, triangles.data(),
                                       triangles.size() / 3, &scene),
              GNOMON_OK)
        << gnomon_last_error();
    return OwnScene{scene};
}

gnomon_light sun()
{
    gnomon_light light{};
    light.direction[1] = -1;
    return light;
}

TEST(CFunctions, TellWhichPointsThePlateShadows)
{
    const OwnScene scene = plate();
    const std::vector<double> points{0, 0.5, 0.25, 0, 1.5, 0, 3, 0, 3, 1, 0.5, 0.25};
    std::array<std::uint8_t, 4> classes{};
    std::array<std::uint32_t, 4> witness{};
    std::array<float, 8> share{};
    const gnomon_light light = sun();
    ASSERT_EQ(gnomon_truth_in_space(scene.get(), &light, points.data(), 4, 0,
                                    {classes.data(), witness.data(), share.data()}),
              GNOMON_OK);
    EXPECT_THAT(classes, ElementsAre(GNOMON_BLOCKED, GNOMON_LIT, GNOMON_LIT, GNOMON_INDETERMINATE));
    EXPECT_GE(witness[0], 2U); // of the plate
    EXPECT_EQ(witness[1], GNOMON_NO_TRIANGLE);
    EXPECT_THAT(share, ElementsAre(0, 0, 1, 1, 1, 1, 0, 1));
}

TEST(CFunctions, LeaveOutTrianglesWithoutAnArea)
{
    const OwnScene scene = plate();
    ASSERT_EQ(gnomon_scene_triangle_count(scene.get()), 4U);
    const std::uint32_t* const kept = gnomon_scene_kept_triangles(scene.get());
    EXPECT_THAT(std::vector<std::uint32_t>(kept, kept + 4), ElementsAre(0, 1, 3, 4));
}

TEST(CFunctions, TakePointsOnTrianglesFromEitherSide)
{
    const OwnScene scene = plate();
    const std::array<std::uint32_t, 2> on{0, 2};
    const std::array<double, 4> places{0.5, 0.25, 0.5, 0.25};
    const gnomon_light light = sun();
    std::array<std::uint8_t, 2> classes{};
    const auto classes_of = [&](int side) {
        EXPECT_EQ(gnomon_truth_on_triangles(scene.get(), &light, on.data(), places.data(), 2, side,
                                            1, {classes.data(), nullptr, nullptr}),
                  GNOMON_OK)
            << gnomon_last_error();
        return classes;
    };
    EXPECT_THAT(classes_of(GNOMON_TO_LIGHT), ElementsAre(GNOMON_LIT, GNOMON_LIT));
    EXPECT_THAT(classes_of(GNOMON_BACK), ElementsAre(GNOMON_ATTACHED, GNOMON_ATTACHED));
}

TEST(CFunctions, KeepTheDoublesOfALight)
{
    // The plate's edge is at x = 1. The light misses it by less than a float32 step.
    const OwnScene scene = plate();
    const std::array<double, 3> point{0, 0, 0.25};
    gnomon_light light{};
    light.kind = GNOMON_POINT;
    light.position[0] = 2 + 1e-12;
    light.position[1] = 2;
    light.position[2] = 0.25;
    std::uint8_t found = 0;
    const auto class_of = [&](int keeps_doubles) {
        light.keeps_doubles = keeps_doubles;
        EXPECT_EQ(gnomon_truth_in_space(scene.get(), &light, point.data(), 1, 1,
                                        {&found, nullptr, nullptr}),
                  GNOMON_OK);
        return found;
    };
    EXPECT_EQ(class_of(0), GNOMON_INDETERMINATE);
    EXPECT_EQ(class_of(1), GNOMON_LIT);
}

/// A mask of the ground from −2 to 2, seen from above, with `wrong` wrong pixels.
struct GroundMask {
    static constexpr int side = 16;
    explicit GroundMask(int wrong)
    {
        for (int row = 0; row < side; ++row) {
            for (int column = 0; column < side; ++column) {
                const float x = -2 + (static_cast<float>(column) + 0.5F) / 4;
                const float z = -2 + (static_cast<float>(row) + 0.5F) / 4;
                positions.insert(positions.end(), {x, 0, z});
                values.push_back(std::abs(x) < 1 && std::abs(z) < 1 ? 0.0F : 1.0F);
            }
        }
        for (int i = 0; i < wrong; ++i) {
            values[static_cast<std::size_t>(i)] = 0; // in the lit corner
        }
    }
    [[nodiscard]] gnomon_mask mask() const
    {
        gnomon_mask made{};
        made.width = made.height = side;
        made.values = values.data();
        made.positions = positions.data();
        return made;
    }

    std::vector<float> values, positions;
};

TEST(CFunctions, JudgeAMask)
{
    const OwnScene scene = plate();
    const gnomon_light light = sun();
    const GroundMask ground{5};
    const gnomon_mask mask = ground.mask();
    gnomon_evaluation* found = nullptr;
    ASSERT_EQ(gnomon_evaluate(scene.get(), &light, &mask, 0, &found), GNOMON_OK)
        << gnomon_last_error();
    const auto json = nlohmann::json::parse(gnomon_evaluation_json(found));
    EXPECT_EQ(json.at("false_shadow"), 5);
    EXPECT_EQ(json.at("false_lit"), 0);
    EXPECT_EQ(gnomon_evaluation_classes(found)[0], GNOMON_LIT);
    EXPECT_EQ(gnomon_evaluation_classes(found)[GroundMask::side * 8 + 8], GNOMON_BLOCKED);
    gnomon_evaluation_free(found);
}

TEST(CFunctions, SayInOneLineWhatIsWrong)
{
    const OwnScene scene = plate();
    const gnomon_light light = sun();
    const std::array<double, 3> point{0, std::numeric_limits<double>::quiet_NaN(), 0};
    std::uint8_t found = 0;
    const gnomon_truth truth{&found, nullptr, nullptr};
    const auto expect_refused = [](gnomon_status status, const std::string& words) {
        EXPECT_EQ(status, GNOMON_BAD_INPUT);
        EXPECT_THAT(gnomon_last_error(), HasSubstr(words));
        EXPECT_THAT(gnomon_last_error(), Not(HasSubstr("\n")));
    };
    const auto in_space = [&](const gnomon_light& given) {
        return gnomon_truth_in_space(scene.get(), &given, point.data(), 1, 0, truth);
    };
    expect_refused(in_space(light), "points[0]: y is nan");
    expect_refused(gnomon_truth_in_space(nullptr, &light, point.data(), 1, 0, truth),
                   "scene is null");
    expect_refused(gnomon_truth_in_space(scene.get(), nullptr, point.data(), 1, 0, truth),
                   "light is null");
    expect_refused(gnomon_truth_in_space(scene.get(), &light, nullptr, 1, 0, truth),
                   "points is null");
    expect_refused(gnomon_truth_in_space(scene.get(), &light, point.data(), 1, -1, truth),
                   "threads = -1");
    gnomon_light other = light;
    other.kind = 9;
    expect_refused(in_space(other), "light.kind = 9");
    other = light;
    other.direction[0] = std::numeric_limits<double>::infinity();
    expect_refused(in_space(other), "light.direction: x is inf");
    other = gnomon_light{};
    expect_refused(in_space(other), "light.direction is zero");
    other.kind = GNOMON_SPOT;
    expect_refused(in_space(other), "light.cone_deg = 0");
    gnomon_scene* made = nullptr;
    const std::array<std::uint32_t, 3> beyond{0, 1, 8};
    expect_refused(gnomon_scene_from_arrays(corners.data(), 8, beyond.data(), 1, &made),
                   "triangles[0, 2] is 8: there are 8 vertices");
    expect_refused(gnomon_scene_from_arrays(nullptr, 0, nullptr, 0, &made),
                   "no triangle has an area");
    expect_refused(gnomon_scene_from_arrays(corners.data(), 8, triangles.data(), 1, nullptr),
                   "scene is null");
    expect_refused(gnomon_scene_load("/nonexistent.obj", &made), "/nonexistent.obj");
    EXPECT_EQ(made, nullptr);
    const GroundMask ground{0};
    gnomon_evaluation* evaluation = nullptr;
    gnomon_mask mask = ground.mask();
    mask.width = 0;
    expect_refused(gnomon_evaluate(scene.get(), &light, &mask, 0, &evaluation), "0 × 16 pixels");
    mask = ground.mask();
    mask.positions = nullptr;
    expect_refused(gnomon_evaluate(scene.get(), &light, &mask, 0, &evaluation),
                   "mask.positions is null");
    GroundMask inverted{0};
    for (float& value : inverted.values) {
        value = 1 - value;
    }
    mask = inverted.mask();
    expect_refused(gnomon_evaluate(scene.get(), &light, &mask, 0, &evaluation), "invert");
    EXPECT_EQ(evaluation, nullptr);
}

TEST(CFunctions, NeverCrashWhateverNumbersTheyGet)
{
    constexpr unsigned seed = 11;
    std::mt19937 random{seed};
    const std::vector<double> numbers{0,
                                      1,
                                      -1,
                                      0.5,
                                      1e-320,
                                      1e300,
                                      -0.0,
                                      3e15,
                                      std::numeric_limits<double>::infinity(),
                                      -1e15,
                                      1e-9,
                                      4.2e9,
                                      std::numeric_limits<double>::quiet_NaN()};
    const auto number = [&] { return numbers[random() % numbers.size()]; };
    const OwnScene scene = plate();
    int answered = 0;
    for (int call = 0; call < 2000; ++call) {
        gnomon_light light{};
        light.kind = static_cast<int>(random() % 4);
        light.keeps_doubles = static_cast<int>(random() % 2);
        light.cone_deg = number();
        for (auto* const vector : {light.direction, light.position, light.target}) {
            for (int axis = 0; axis < 3; ++axis) {
                vector[axis] = number();
            }
        }
        std::array<double, 6> points{};
        for (double& coordinate : points) {
            coordinate = number();
        }
        std::array<std::uint8_t, 2> classes{};
        const std::array<std::uint32_t, 2> on{static_cast<std::uint32_t>(random() % 6), 0};
        const gnomon_truth truth{classes.data(), nullptr, nullptr};
        const auto side = static_cast<int>(random() % 4);
        const gnomon_status status =
            call % 2 == 0 ? gnomon_truth_in_space(scene.get(), &light, points.data(), 2, 1, truth)
                          : gnomon_truth_on_triangles(scene.get(), &light, on.data(), points.data(),
                                                      2, side, 1, truth);
        ASSERT_THAT(status, ::testing::AnyOf(GNOMON_OK, GNOMON_BAD_INPUT))
            << "seed " << seed << ", call " << call << ": " << gnomon_last_error();
        answered += status == GNOMON_OK ? 1 : 0;
    }
    EXPECT_GT(answered, 0);
}

} // namespace
} // namespace gnomon::testing
