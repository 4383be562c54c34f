#include "lane.hpp"
#include "scene/import/load_scene_file.hpp"
#include "scene_file_fixture.hpp"

#include <gmock/gmock.h>

#include <sys/stat.h>
#include <unistd.h>

#include <limits>

namespace gnomon::scene {
namespace {

using test::file_refusal;
using test::QuadGltf;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::string_view corners_obj = "o quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\n";

TEST(SceneFileRefusal, SaysWhatIsWrongWithAPath)
{
    const TemporaryFolder folder;
    EXPECT_THAT(file_refusal(folder.path() / "none.obj"),
                HasSubstr("none.obj: there is no such file"));
    EXPECT_THAT(file_refusal(folder.path()), HasSubstr("is a folder"));
    std::filesystem::create_directory(folder.path() / "folder.obj");
    EXPECT_THAT(file_refusal(folder.path() / "folder.obj"), HasSubstr("is a folder"));
    EXPECT_THAT(file_refusal(folder.write("empty.obj", "")), HasSubstr("empty.obj: is empty"));
    EXPECT_THAT(file_refusal(folder.write("mesh.stl", "solid")),
                AllOf(HasSubstr("mesh.stl"), HasSubstr(".gltf, .glb, .obj or .ply")));
    std::filesystem::create_symlink("loop.obj", folder.path() / "loop.obj");
    EXPECT_THAT(file_refusal(folder.path() / "loop.obj"), HasSubstr("loop.obj: cannot be reached"));
    EXPECT_THAT(file_refusal(folder.write("text.glb", "this is no mesh")),
                HasSubstr("text.glb: cannot be imported: it is not what its name says"));
    ASSERT_EQ(::mkfifo((folder.path() / "pipe.obj").c_str(), 0600), 0);
    EXPECT_THAT(file_refusal(folder.path() / "pipe.obj"), HasSubstr("not a regular file"));
}

TEST(SceneFileRefusal, SaysThatAFileCannotBeRead)
{
    if (::geteuid() == 0) {
        GTEST_SKIP() << "the superuser may read every file";
    }
    const TemporaryFolder folder;
    const auto path = folder.write("secret.obj", corners_obj);
    std::filesystem::permissions(path, std::filesystem::perms::none);
    EXPECT_THAT(file_refusal(path), HasSubstr("secret.obj: cannot be read (Permission denied)"));
}

TEST(SceneFileRefusal, KeepsARenamedFileFromTheParserOfAnotherFormat)
{
    const TemporaryFolder folder;
    constexpr std::string_view stl =
        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid s\n";
    constexpr std::string_view off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const char* const name : {"mesh.obj", "mesh.ply", "mesh.gltf", "mesh.glb"}) {
        for (const std::string_view text : {stl, off}) {
            EXPECT_THAT(file_refusal(folder.write(name, text)), HasSubstr(name)) << text;
        }
    }
}

TEST(SceneFileRefusal, NamesTheMeshlessFile)
{
    const TemporaryFolder folder;
    EXPECT_THAT(file_refusal(folder.write("line.obj", std::string{corners_obj} + "l 1 2\np 3\n")),
                AllOf(HasSubstr("line.obj"), HasSubstr("no triangle"), HasSubstr("2 points")));
    EXPECT_THAT(file_refusal(folder.write("flat.obj", std::string{corners_obj} + "f 1 2 2\n")),
                AllOf(HasSubstr("flat.obj"), HasSubstr("1 of zero area")));
    EXPECT_THAT(file_refusal(folder.write("text.obj", "this is not a mesh\n")),
                HasSubstr("text.obj"));
}

TEST(SceneFileRefusal, NamesObjectAndVertexOfACoordinateThatIsNotFinite)
{
    const TemporaryFolder folder;
    for (const std::string_view bad : {"nan", "inf", "-inf", "2e15"}) {
        const auto obj = folder.write(
            "bad.obj", fmt::format("o quad\nv 0 0 0\nv 1 0 0\nv 1 {} 0\nf 1 2 3\n", bad));
        EXPECT_THAT(file_refusal(obj),
                    AllOf(HasSubstr("bad.obj"), HasSubstr("quad"), HasSubstr("2")))
            << bad;
    }
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(), -2e15F}) {
        auto corners = test::unit_quad;
        corners[7] = bad;
        QuadGltf gltf;
        gltf.buffer = fmt::format(R"("uri":"data:application/octet-stream;base64,{}",)",
                                  test::base64(test::quad_buffer(corners)));
        EXPECT_THAT(file_refusal(folder.write("bad.gltf", gltf.text())),
                    AllOf(HasSubstr("bad.gltf"), HasSubstr("\"quad\""), HasSubstr("2")))
            << bad;
        const auto ply = folder.write(
            "bad.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\n"
                       "property float y\nproperty float z\nelement face 1\n"
                       "property list uchar int vertex_indices\nend_header\n" +
                           test::bytes_of(corners) + '\x03' + test::bytes_of(std::array{0, 1, 2}));
        EXPECT_THAT(file_refusal(ply), AllOf(HasSubstr("bad.ply"), HasSubstr("vertex"))) << bad;
    }
}

TEST(SceneFileRefusal, RefusesATransformThatLeadsOutOfRange)
{
    const TemporaryFolder folder;
    QuadGltf gltf;
    gltf.nodes = R"([{"name":"far","translation":[0,1e30,0],"mesh":0}])";
    EXPECT_THAT(file_refusal(folder.write("far.gltf", gltf.text())), HasSubstr("\"far\""));
}

TEST(SceneFileRefusal, RefusesIndicesOutOfRange)
{
    const TemporaryFolder folder;
    for (const std::string_view face : {"f 1 2 9", "f 1 2 -9", "f 1 2 0", "f 1 2 4294967297"}) {
        EXPECT_THAT(
            file_refusal(folder.write("i.obj", std::string{corners_obj} + face.data() + "\n")),
            HasSubstr("i.obj"))
            << face;
    }
    for (const std::string_view index : {"9", "-1", "2000000000"}) {
        const auto ply = folder.write(
            "i.ply", fmt::format("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                 "property float y\nproperty float z\nelement face 1\nproperty "
                                 "list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n"
                                 "3 0 1 {}\n",
                                 index));
        EXPECT_THAT(file_refusal(ply), AllOf(HasSubstr("i.ply"), HasSubstr("index"))) << index;
    }
    QuadGltf gltf;
    const auto buffer = test::quad_buffer(test::unit_quad, {9, 9, 9, 9, 9, 0xFFFF});
    gltf.buffer =
        fmt::format(R"("uri":"data:application/octet-stream;base64,{}",)", test::base64(buffer));
    EXPECT_THAT(file_refusal(folder.write("i.gltf", gltf.text())), HasSubstr("i.gltf"));
}

TEST(SceneFileRefusal, SurvivesNodesThatAreMissingOrContainThemselves)
{
    const TemporaryFolder folder;
    for (const std::string_view nodes :
         {R"([{"mesh":0,"children":[0]}])", R"([{"children":[1]},{"mesh":0,"children":[0]}])",
          R"([{"mesh":0,"children":[7]}])", R"([{"mesh":5}])", "[]"}) {
        QuadGltf gltf;
        gltf.nodes = nodes;
        EXPECT_THAT(file_refusal(folder.write("nodes.gltf", gltf.text())), HasSubstr("nodes.gltf"))
            << nodes;
    }
}

/// A tree of 2^depth instances in a few bytes.
std::string exponential_nodes(int depth)
{
    std::string nodes = "[";
    for (int i = 0; i < depth; ++i) {
        nodes += fmt::format(R"({{"children":[{},{}]}},)", i + 1, i + 1);
    }
    return nodes + R"({"mesh":0}])";
}

TEST(SceneFileRefusal, EndsWithinTenSecondsOnNodesThatMultiply)
{
    const TemporaryFolder folder;
    QuadGltf gltf;
    gltf.nodes = exponential_nodes(40);
    const auto path = folder.write("bomb.gltf", gltf.text());
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(file_refusal(path), HasSubstr("bomb.gltf"));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds{10});
}

TEST(SceneFileRefusal, ChecksTheNumberOfTrianglesBeforeTakingMemory)
{
    const TemporaryFolder folder;
    QuadGltf gltf;
    gltf.nodes = exponential_nodes(6);
    const auto path = folder.write("many.gltf", gltf.text());
    EXPECT_EQ(load_scene_file(path, {.triangles = 128}).scene.triangles.size(), 128U);
    EXPECT_THAT(file_refusal(path, {.triangles = 127}), HasSubstr("more than 127 triangles"));
}

TEST(SceneFileRefusal, SurvivesDeeplyNestedDocuments)
{
    const TemporaryFolder folder;
    const std::string deep(tests::in_lane(400'000U, 2'000'000U), '[');
    EXPECT_THAT(file_refusal(folder.write("deep.gltf", deep)), HasSubstr("deep.gltf"));
}

TEST(SceneFileRefusal, RefusesATruncatedGlbAtEveryLength)
{
    const TemporaryFolder folder;
    const std::string whole = QuadGltf{}.binary();
    for (std::size_t length = 1; length < whole.size(); length += 29) {
        const auto path = folder.write("cut.glb", std::string_view{whole}.substr(0, length));
        EXPECT_THAT(file_refusal(path), HasSubstr("cut.glb")) << length << " of " << whole.size();
    }
}

TEST(SceneFileRefusal, OpensNoFileOutsideTheScenesFolder)
{
    const TemporaryFolder folder;
    (void)folder.write("secret.bin", test::quad_buffer());
    std::filesystem::create_directory(folder.path() / "scene");
    std::filesystem::create_symlink(folder.path() / "secret.bin", folder.path() / "scene/link.bin");
    std::filesystem::create_symlink(folder.path(), folder.path() / "scene/up");
    for (const std::string_view uri : {"../secret.bin", "%2e%2e/secret.bin", "link.bin",
                                       "up/secret.bin", "../scene/../secret.bin"}) {
        QuadGltf gltf;
        gltf.buffer = fmt::format(R"("uri":"{}",)", uri);
        EXPECT_THAT(file_refusal(folder.write("scene/escape.gltf", gltf.text())),
                    AllOf(HasSubstr("escape.gltf"), HasSubstr("outside its own folder")))
            << uri;
    }
}

TEST(SceneFileRefusal, DoesNotWaitForAPipe)
{
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder.path() / "pipe.bin").c_str(), 0600), 0);
    QuadGltf gltf;
    gltf.buffer = R"("uri":"pipe.bin",)";
    const auto start = std::chrono::steady_clock::now();
    EXPECT_THAT(file_refusal(folder.write("pipe.gltf", gltf.text())), HasSubstr("pipe.bin"));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds{5});
}

TEST(SceneFileRefusal, MakesNamesFromFilesPrintable)
{
    const TemporaryFolder folder;
    QuadGltf gltf;
    gltf.nodes = R"([{"name":"a\u0007\nb","mesh":0}])";
    const auto file = load_scene_file(folder.write("name.gltf", gltf.text()));
    EXPECT_EQ(file.scene.objects.front().name, "a  b");
}

} // namespace
} // namespace gnomon::scene
