#include "lane.hpp"
#include "scene/import/load_scene_file.hpp"
#include "scene_file_fixture.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <random>
#include <vector>

namespace gnomon::scene {
namespace {

using std::filesystem::path;
using test::TemporaryFolder;

constexpr std::string_view models_folder = "/usr/share/assimp/models";
constexpr double longest_s = 10;

/// Every model of the four formats in Debian's assimp-testmodels, sorted.
std::vector<path> models()
{
    std::vector<path> found;
    std::error_code missing;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(models_folder, missing)) {
        const std::string extension = entry.path().extension().string();
        for (const std::string_view known : {".gltf", ".glb", ".obj", ".ply"}) {
            if (extension == known && entry.is_regular_file()) {
                found.push_back(entry.path());
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// Checks the invariants of TriangleScene.
void expect_sound(const TriangleScene& scene, const std::string& label)
{
    EXPECT_FALSE(scene.triangles.empty()) << label;
    std::uint64_t covered = 0;
    for (const Object& object : scene.objects) {
        EXPECT_EQ(object.first_triangle, covered) << label;
        covered += object.triangle_count;
    }
    EXPECT_EQ(covered, scene.triangles.size()) << label;
    for (const auto& triangle : scene.triangles) {
        ASSERT_LT(*std::max_element(triangle.begin(), triangle.end()), scene.vertices.size())
            << label;
    }
    for (const Vec3f& v : scene.vertices) {
        ASSERT_TRUE(std::abs(double{v.x}) <= max_coordinate_m &&
                    std::abs(double{v.y}) <= max_coordinate_m &&
                    std::abs(double{v.z}) <= max_coordinate_m)
            << label;
    }
}

struct Attempt {
    std::string outcome; ///< "loaded", or the kind of refusal
    double time_s = 0;
    std::size_t triangles = 0; ///< dropped ones included
};

/// Loads; anything but a scene or an InputError of one line fails the test.
Attempt attempt(const path& file, const std::string& label)
{
    Attempt result;
    const auto start = std::chrono::steady_clock::now();
    try {
        const TriangleScene scene = load_scene_file(file).scene;
        expect_sound(scene, label);
        result.outcome = "loaded";
        result.triangles = scene.triangles.size() + scene.dropped_triangles;
    } catch (const InputError& error) {
        const std::string_view message = error.what();
        EXPECT_EQ(message.find('\n'), std::string_view::npos) << label << ": " << message;
        result.outcome = message.find("crashed") != message.npos             ? "crashed"
                         : message.find("worked for longer") != message.npos ? "hung"
                                                                             : "refused";
    } catch (const std::exception& error) {
        ADD_FAILURE() << label << ": " << error.what();
    }
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    result.time_s = time.count();
    EXPECT_LT(result.time_s, longest_s) << label;
    return result;
}

TEST(SceneFileModels, LoadsOrRefusesEveryTestModel)
{
    const std::vector<path> all = models();
    if (all.empty()) {
        GTEST_SKIP() << "assimp-testmodels is not installed";
    }
    std::map<std::string, int> outcomes;
    // The usual lane tries every third.
    const std::size_t step = tests::in_lane(3U, 1U);
    for (std::size_t i = 0; i < all.size(); i += step) {
        ++outcomes[attempt(all[i], all[i].string()).outcome];
    }
    EXPECT_EQ(outcomes["crashed"], 0);
    EXPECT_EQ(outcomes["hung"], 0);
    // The package of Debian 12 has 58 models with a triangle among the 80 of these formats.
    EXPECT_GE(outcomes["loaded"], static_cast<int>(all.size() / step) / 2);
}

TEST(SceneFileModels, FindsTheTrianglesOfKnownModels)
{
    for (const auto& [name, count] :
         {std::pair{"glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", 121'496U},
          std::pair{"glTF2/BoxTextured-glTF/BoxTextured.gltf", 12U},
          std::pair{"glTF/TwoBoxes/TwoBoxes.gltf", 24U}, std::pair{"PLY/cube_binary.ply", 12U},
          std::pair{"OBJ/WusonOBJ.obj", 3732U}}) {
        const path model = path{models_folder} / name;
        if (!std::filesystem::exists(model)) {
            GTEST_SKIP() << "assimp-testmodels is not installed";
        }
        EXPECT_EQ(attempt(model, name).triangles, count) << name;
    }
}

/// A model, and copies of the files beside it that it may refer to.
struct Victim {
    std::string name;
    std::string bytes;
    path folder;
};

std::vector<Victim> victims(const TemporaryFolder& folder)
{
    std::vector<Victim> all;
    for (const path& model : models()) {
        std::ifstream stream{model, std::ios::binary};
        std::string bytes{std::istreambuf_iterator<char>{stream}, {}};
        if (bytes.size() < 8) {
            continue;
        }
        const path copy = folder.path() / std::to_string(all.size());
        std::filesystem::create_directory(copy);
        for (const auto& entry : std::filesystem::directory_iterator(model.parent_path())) {
            if (entry.path().extension() == ".bin" || entry.path().extension() == ".mtl") {
                std::filesystem::copy_file(entry.path(), copy / entry.path().filename());
            }
        }
        all.push_back({model.filename().string(), std::move(bytes), copy});
    }
    return all;
}

/// Changes four bytes: a random word, four random bytes anywhere, or four digits into
/// others, which leaves the document readable and makes its numbers wrong.
std::string mutated(std::string bytes, std::uint32_t seed)
{
    std::mt19937 random{seed};
    const auto way = random() % 3;
    const std::size_t word = random() % (bytes.size() - 4);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t at = way == 0 ? word + k : random() % bytes.size();
        if (way == 2) {
            const std::size_t digit = bytes.find_first_of("0123456789", at);
            bytes[digit == bytes.npos ? at : digit] = static_cast<char>('0' + random() % 10);
        } else {
            bytes[at] = static_cast<char>(random() & 0xFFU);
        }
    }
    return bytes;
}

TEST(SceneFileModels, SurvivesFourByteMutations)
{
    const TemporaryFolder folder;
    const std::vector<Victim> all = victims(folder);
    if (all.empty()) {
        GTEST_SKIP() << "assimp-testmodels is not installed";
    }
    const std::uint32_t count = tests::in_lane(24U, 10'000U);
    std::map<std::string, int> outcomes;
    double slowest_s = 0;
    for (std::uint32_t seed = 0; seed < count && !HasFailure(); ++seed) {
        const Victim& victim = all[seed % all.size()];
        const path file = victim.folder / victim.name;
        std::ofstream{file, std::ios::binary} << mutated(victim.bytes, seed);
        const Attempt result = attempt(file, fmt::format("{} with seed {}", victim.name, seed));
        ++outcomes[result.outcome];
        slowest_s = std::max(slowest_s, result.time_s);
    }
    for (const auto& [outcome, times] : outcomes) {
        std::cout << outcome << ": " << times << "\n";
    }
    std::cout << fmt::format("slowest: {:.2f} s\n", slowest_s);
    EXPECT_GT(outcomes["loaded"], 0);
    EXPECT_GT(outcomes["refused"], 0);
}

} // namespace
} // namespace gnomon::scene
