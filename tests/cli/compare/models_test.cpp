#include "child_process.hpp"
#include "lane.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <iostream>
#include <map>
#include <random>

namespace gnomon::testing {
namespace {

using std::filesystem::path;
using Json = nlohmann::json;

constexpr double longest_refusal_s = 10;

/// Compares a model; expects valid results or a refusal in one line.
/// @return  the exit code.
int compare(const path& model, const std::string& label)
{
    SCOPED_TRACE(label);
    const Ending ending = gnomon(small({"compare", model, "--json"}));
    if (ending.exit_code != 0) {
        expect_refused(ending, 2, model.string());
        EXPECT_LT(ending.time_s, longest_refusal_s);
        return ending.exit_code;
    }
    expect_done(ending);
    const Json pixels = Json::parse(ending.out).at("pixels");
    std::int64_t sum = 0;
    for (const auto& [name, count] : pixels.items()) {
        sum += name == "total" ? 0 : count.get<std::int64_t>();
    }
    EXPECT_EQ(sum, 160 * 90);
    EXPECT_EQ(pixels.at("total"), 160 * 90);
    return 0;
}

/// Whether Assimp's own tool loads the model and finds a triangle in it.
bool assimp_finds_a_triangle(const path& model)
{
    const Ending info = run({"assimp", "info", model});
    const std::size_t types = info.out.find("Primitive Types:");
    return info.exit_code == 0 && types != std::string::npos &&
           info.out.substr(types, info.out.find('\n', types) - types).find("triangles") !=
               std::string::npos;
}

TEST(TestModels, AreComparedOrRefusedInOneLine)
{
    const std::vector<path> models = test_models();
    if (models.empty()) {
        GTEST_SKIP() << "assimp-testmodels is not installed";
    }
    std::map<int, int> endings;
    // The usual lane tries every third.
    const std::size_t step = tests::in_lane(3U, 1U);
    for (std::size_t i = 0; i < models.size(); i += step) {
        ++endings[compare(models[i], models[i].string())];
    }
    std::cout << endings[0] << " compared, " << endings[2] << " refused\n";
    // Debian 12's package: 87 models, 55 of them with a triangle that has an area.
    EXPECT_GE(endings[0], static_cast<int>(models.size() / step) / 2);
}

TEST(LongTestModels, AreComparedWhereverAssimpFindsATriangle)
{
    if (!is_installed("assimp")) {
        GTEST_SKIP() << "assimp (assimp-utils) is not installed";
    }
    for (const path& model : test_models()) {
        // Its one face has no area: the three vertices test number formats only.
        const bool has_no_area = model.filename() == "number_formats.obj";
        // It has indices of missing vertices: Assimp drops those triangles, Gnomon refuses the
        // file.
        const bool loses_triangles =
            model.filename() == "IndexOutOfRange.gltf" ||
            model.parent_path().filename() == "IncorrectVertexArrays"; // of glTF 1.0 and 2.0
        const bool is_loaded = assimp_finds_a_triangle(model) && !has_no_area && !loses_triangles;
        EXPECT_EQ(compare(model, model.string()), is_loaded ? 0 : 2) << model;
    }
}

TEST(TestModels, ThatAreMalformedAreRefused)
{
    const path folder = path{test_models_folder} / "invalid";
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << "assimp-testmodels is not installed";
    }
    for (const auto& entry : std::filesystem::directory_iterator{folder}) {
        // Its defect is in a material, which Gnomon does not read.
        const bool is_readable = entry.path().filename() == "malformed2.obj";
        EXPECT_EQ(compare(entry.path(), entry.path().string()), is_readable ? 0 : 2);
    }
}

/// Changes four bytes: a random word, four bytes anywhere, or four digits, which keeps the syntax
/// valid and makes numbers wrong.
std::string mutated(std::string bytes, std::uint32_t seed)
{
    std::mt19937 random{seed};
    const auto way = random() % 3;
    const std::size_t word = random() % (bytes.size() - 4);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t at = way == 0 ? word + k : random() % bytes.size();
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        if (way == 2 && digit != bytes.npos) {
            bytes[digit] = static_cast<char>('0' + random() % 10);
        } else {
            bytes[at] = static_cast<char>(random() & 0xFFU);
        }
    }
    return bytes;
}

/// Copies the files that a model may refer to.
void copy_companions(const path& model, const path& folder)
{
    for (const auto& entry : std::filesystem::directory_iterator(model.parent_path())) {
        if (entry.path().extension() == ".bin" || entry.path().extension() == ".mtl") {
            std::filesystem::copy_file(entry.path(), folder / entry.path().filename());
        }
    }
}

TEST(TestModels, WithFourBytesChangedNeverCrashTheProgram)
{
    const std::vector<path> models = test_models();
    if (models.empty()) {
        GTEST_SKIP() << "assimp-testmodels is not installed";
    }
    const std::uint32_t count = tests::in_lane(20U, 500U);
    std::map<int, int> endings;
    for (std::uint32_t seed = 0; seed < count && !HasFailure(); ++seed) {
        // 31 does not divide the number of models, so a short run has all formats too.
        const path& model = models[seed * 31 % models.size()];
        const std::string bytes = text_of(model);
        if (bytes.size() < 8) {
            continue;
        }
        const TemporaryFolder folder;
        copy_companions(model, folder.path());
        const path copy = folder.write(model.filename(), mutated(bytes, seed));
        ++endings[compare(copy, fmt::format("{} with seed {}", model.string(), seed))];
    }
    EXPECT_GT(endings[0], 0);
    EXPECT_GT(endings[2], 0);
}

} // namespace
} // namespace gnomon::testing
