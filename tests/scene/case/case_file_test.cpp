#include "scene/case/file.hpp"

#include "scene/case/space.hpp"
#include "scene/error.hpp"
#include "scene_file_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace gnomon::scene {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;

constexpr const char* smallest_case = R"(schema = 1
renderer = "Engine"
mesh.file = "mesh.ply"
[light]
direction = [0, -1, 0.1]
)";

CaseFile read_case(const std::string& text, std::string_view from = {})
{
    const TemporaryFolder folder;
    folder.write("case.toml", text);
    return read_case_file(folder.path(), from);
}

std::string case_refusal(const std::string& text)
{
    try {
        (void)read_case(text);
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "accepted:\n" << text;
    return {};
}

TEST(CaseFile, NeedsNoMoreThanMeshLightAndRenderer)
{
    const CaseFile file = read_case(smallest_case);
    EXPECT_EQ(file.renderer, "Engine");
    ASSERT_EQ(file.images.size(), 1U);
    EXPECT_EQ(file.images.front().path.filename(), "aov.exr");
    EXPECT_EQ(file.name, file.path.parent_path().filename());
    EXPECT_TRUE(file.space.is_of_mesh());
    EXPECT_FALSE(file.eye);
    EXPECT_FALSE(file.says_any("shadow_map"));
    const Job job = make_job(file.source);
    EXPECT_EQ(job.scene.file.filename(), "mesh.ply");
    EXPECT_EQ(job.light->direction, (Vec3d{0, -1, 0.1}));
}

TEST(CaseFile, TakesPointLights)
{
    const CaseFile file = read_case("schema = 1\nrenderer = \"E\"\nmesh.file = \"m.ply\"\n"
                                    "light = {type = \"point\", position = [1, 2, 3]}\n");
    const Light light = make_light(*make_job(file.source).light);
    EXPECT_EQ(light.type, LightType::point);
    EXPECT_EQ(light.position, (Vec3d{1, 2, 3}));
}

TEST(CaseFile, TakesAnEyeWithoutACamera)
{
    const CaseFile file = read_case(std::string{smallest_case} + "[camera]\neye = [1, 2, 3.1]\n");
    EXPECT_EQ(file.eye, (Vec3d{1, 2, double{3.1F}}));
    EXPECT_FALSE(file.says("camera.eye"));
    EXPECT_FALSE(make_job(file.source).camera);
}

TEST(CaseFile, LaysItsOwnConventionsOverAnExporters)
{
    const CaseFile unreal = read_case(smallest_case, "unreal");
    EXPECT_EQ(unreal.space.from_mesh({1, 2, 3}), (Vec3d{100, 300, 200}));
    EXPECT_TRUE(unreal.space.is_mirrored());
    EXPECT_EQ(unreal.space.metres_per_unit, 0.01);
    const CaseFile own = read_case(std::string{smallest_case} +
                                   "[conventions]\nfrom = \"blender\"\naxes = [\"x\", \"y\", "
                                   "\"z\"]\n[channels]\nshadow = \"V\"\n");
    EXPECT_TRUE(own.space.is_of_mesh());
    EXPECT_EQ(own.conventions.channels.shadow, std::vector<std::string>{"V"});
    EXPECT_EQ(own.conventions.channels.position.back(), "ViewLayer.Position");
    EXPECT_EQ(read_case(smallest_case, "blender").space.from_mesh({1, 2, 3}), (Vec3d{1, -3, 2}));
}

TEST(CaseFile, RefusesWhatIsMissingUnknownOrContradicts)
{
    const std::string whole = smallest_case;
    const auto without = [&](const std::string& part) {
        std::string text = whole;
        text.erase(text.find(part), part.size());
        return text;
    };
    EXPECT_THAT(case_refusal(without("schema = 1")), HasSubstr("schema = 1 is missing"));
    EXPECT_THAT(case_refusal(without("renderer = \"Engine\"")), HasSubstr("renderer is missing"));
    EXPECT_THAT(case_refusal(without("mesh.file = \"mesh.ply\"")),
                HasSubstr("mesh.file is missing"));
    EXPECT_THAT(case_refusal(without("direction = [0, -1, 0.1]")), HasSubstr("[light] is missing"));
    for (const auto& [more, text] :
         {std::pair{"type = \"directional\"\ndirektion = 1", "the nearest is light.direction"},
          {"cone_deg = 30", "is for a spot light, and this is a directional light"},
          {"[mesh.fiel]", "unknown key"},
          {"type = \"area\"", "light.type = \"area\": must be one of directional, spot, point"},
          {"type = 3", "light.type = 3: must be"},
          {"[sweep]", "unknown key \"sweep\""},
          {"[camera]\ntarget = [0, 0, 0]", "needs camera.eye"},
          {"[camera]\nup = [0, 0, 1]", "needs camera.target"},
          {"[conventions]\nfrom = \"blendr\"", "the nearest is \"blender\""},
          {"[conventions]\naxes = [\"x\", \"-x\", \"z\"]", "x, y and z in any order"},
          {"[conventions]\nup = \"z\"\naxes = [\"x\", \"y\", \"z\"]", "are mutually exclusive"},
          {"[channels]\nmask_range = [0.7]", "must be two numbers [a, b]"},
          {"[channels]\nmask_range = [1, 1.0]", "the values for shadowed and lit must differ"},
          {"[channels]\nmask_range = [0, 1]\nlit_above = 0", "are mutually exclusive; keep one"},
          {"[objects]\na = 1\nb = 1", "another object has this number"},
          {"[objects]\na = -1", "must be an integer"},
          {"[bias]\nconstant = 1e-39", "subnormal"},
          {"[light2]", "the nearest is light"}}) {
        EXPECT_THAT(case_refusal(whole + more + "\n"), HasSubstr(text)) << more;
    }
}

TEST(CaseFile, RefusesNamesThatAreNoLine)
{
    const std::string own = std::string{smallest_case};
    const std::string longest(200, 'x');
    EXPECT_EQ(read_case(fmt::format("name = \"{}\"\n{}", longest, own)).name, longest);
    for (const std::string& name :
         {longest + "x", std::string{"a\\nb"}, std::string{"a\\u001bb"}}) {
        EXPECT_THAT(case_refusal(fmt::format("name = \"{}\"\n{}", name, own)),
                    HasSubstr("must be one line of at most 200 bytes"));
    }
    std::string renderer = own;
    renderer.replace(renderer.find("Engine"), 6, "En\\ngine");
    EXPECT_THAT(case_refusal(renderer),
                HasSubstr("renderer = \"En\\u000Agine\": must be one line"));
}

TEST(CaseMessage, SpeaksOfTheKeysThatACaseHas)
{
    CaseFile file;
    file.source.name = "case.toml";
    EXPECT_EQ(case_message(file, "scene.no_cast: no"), "case.toml: mesh.no_cast: no");
    EXPECT_EQ(case_message(file, "light.position: no"), "case.toml: light.position: no");
    EXPECT_EQ(case_message(file, "lights.obj: no"), "lights.obj: no");
    EXPECT_EQ(case_message(file, "mesh.obj: no"), "mesh.obj: no");
}

TEST(CaseSpace, TurnsAndMirrorsWithoutLoss)
{
    TriangleScene mesh;
    mesh.vertices = {{0.1F, 0.2F, 0.3F}, {1.7F, 0.2F, 0.3F}, {0.1F, 2.9F, 0.3F}};
    mesh.triangles = {{0, 1, 2}};
    mesh.objects = {{"one", 0, 1}};
    CaseSpace space;
    space.axes = {{{0, 1}, {2, 1}, {1, 1}}};
    const TriangleScene moved = move_to_space(mesh, space);
    // Mirroring reverses the winding, so that the front stays the front.
    EXPECT_EQ(moved.corners(0), (std::array{Vec3f{0.1F, 0.3F, 0.2F}, Vec3f{0.1F, 0.3F, 2.9F},
                                            Vec3f{1.7F, 0.3F, 0.2F}}));
    EXPECT_EQ(moved.objects[0].name, "one");
}

TEST(CaseSpace, KeepsWhatCastsAndWhatReceives)
{
    TriangleScene mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 2}};
    mesh.objects = {{"glass", 0, 1, false, true}, {"hidden", 1, 1, true, false}};
    CaseSpace space;
    space.units_per_mesh_unit = 2;
    const TriangleScene moved = move_to_space(mesh, space);
    EXPECT_FALSE(moved.objects[0].casts);
    EXPECT_TRUE(moved.objects[0].receives);
    EXPECT_TRUE(moved.objects[1].casts);
    EXPECT_FALSE(moved.objects[1].receives);
}

} // namespace
} // namespace gnomon::scene
