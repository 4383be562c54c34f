#include "scene/import/assimp.hpp"
#include "scene/import/load_scene_file.hpp"
#include "scene_file_fixture.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace gnomon::scene {
namespace {

using test::QuadGltf;
using test::TemporaryFolder;

/// Twice the area, along the normal.
Vec3d area_vector(const TriangleScene& scene, std::uint32_t triangle)
{
    const auto corners = scene.corners(triangle);
    return glm::cross(Vec3d{corners[1]} - Vec3d{corners[0]}, Vec3d{corners[2]} - Vec3d{corners[0]});
}

Box expect_quad(const SceneFile& file)
{
    EXPECT_EQ(file.scene.triangles.size(), 2U);
    EXPECT_EQ(file.scene.vertices.size(), 4U);
    EXPECT_EQ(file.scene.objects.size(), 1U);
    EXPECT_EQ(file.scene.dropped_triangles, 0U);
    return file.scene.bounds();
}

SceneFile load_gltf(const QuadGltf& gltf)
{
    const TemporaryFolder folder;
    return load_scene_file(folder.write("quad.gltf", gltf.text()));
}

constexpr std::string_view quad_obj = "o quad\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

TEST(SceneFile, ReadsAQuadFromObj)
{
    const TemporaryFolder folder;
    const SceneFile file = load_scene_file(folder.write("quad.obj", quad_obj));
    const Box box = expect_quad(file);
    EXPECT_EQ(box.lower, Vec3d(0, 0, 0));
    EXPECT_EQ(box.upper, Vec3d(1, 1, 0));
    EXPECT_EQ(file.scene.objects.front().name, "quad");
    EXPECT_EQ(area_vector(file.scene, 0), Vec3d(0, 0, 1));
    EXPECT_EQ(area_vector(file.scene, 1), Vec3d(0, 0, 1));
    EXPECT_FALSE(file.defaults.camera);
    EXPECT_FALSE(file.defaults.light);
}

TEST(SceneFile, ReadsAQuadFromPly)
{
    const TemporaryFolder folder;
    const SceneFile file = load_scene_file(folder.write(
        "QUAD.PLY", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                    "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"));
    EXPECT_EQ(expect_quad(file).upper, Vec3d(1, 1, 0));
    EXPECT_EQ(area_vector(file.scene, 0), Vec3d(0, 0, 1));
    EXPECT_EQ(file.scene.objects.front().name, "QUAD"); // its node has no name
}

TEST(SceneFile, ReadsAQuadFromGltfAndGlb)
{
    const TemporaryFolder folder;
    for (const auto& path : {folder.write("quad.gltf", QuadGltf{}.text()),
                             folder.write("quad.glb", QuadGltf{}.binary())}) {
        const SceneFile file = load_scene_file(path);
        EXPECT_EQ(expect_quad(file).upper, Vec3d(1, 1, 0)) << path;
        EXPECT_EQ(file.scene.objects.front().name, "quad") << path;
    }
}

TEST(KnownFormats, AreToldByTheExtensionsOfAnImporterWhateverStandsBesideThem)
{
    for (const char* const known : {"gltf glb", "gltf glb vrm", "vrm glb", "glb", "obj", "ply"}) {
        EXPECT_TRUE(reads_known_format(known)) << known;
    }
    for (const char* const other :
         {"", " ", "stl", "objx", "xgltf", "off", "3ds prj", "mesh.xml"}) {
        EXPECT_FALSE(reads_known_format(other)) << other;
    }
}

TEST(SceneFile, TriangulatesPolygonsWithoutChangingTheirArea)
{
    const TemporaryFolder folder;
    // A concave pentagon of area 3/4 of the unit square's.
    const SceneFile file = load_scene_file(
        folder.write("dart.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 0.5 0\nv 0 1 0\nf 1 2 3 4 5\n"));
    ASSERT_EQ(file.scene.triangles.size(), 3U);
    double twice_area_m2 = 0;
    for (std::uint32_t t = 0; t < 3; ++t) {
        EXPECT_GT(area_vector(file.scene, t).z, 0);
        twice_area_m2 += area_vector(file.scene, t).z;
    }
    // Exact: halves of small integers.
    EXPECT_EQ(twice_area_m2, 1.5);
}

TEST(SceneFile, ComposesNestedTransforms)
{
    QuadGltf gltf;
    // The child turns x to y; the parent doubles and moves. (0..1, 0..1, 0) -> (8..10, 0..2, 5).
    gltf.nodes = R"([{"name":"parent","translation":[10,0,5],"scale":[2,2,2],"children":[1]},)"
                 R"({"name":"child","mesh":0,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,0,1]}])";
    const SceneFile file = load_gltf(gltf);
    const Box box = expect_quad(file);
    EXPECT_EQ(box.lower, Vec3d(8, 0, 5));
    EXPECT_EQ(box.upper, Vec3d(10, 2, 5));
    EXPECT_EQ(file.scene.objects.front().name, "child");
    EXPECT_EQ(area_vector(file.scene, 0), Vec3d(0, 0, 4));
}

TEST(SceneFile, ComposesTransformsInDouble)
{
    QuadGltf gltf;
    // 2^24 + 1 is no float32: only a product that stays in double brings the quad back to 1.
    gltf.nodes = R"([{"translation":[16777216,0,0],"children":[1]},)"
                 R"({"translation":[1,0,0],"children":[2]},)"
                 R"({"translation":[-16777216,0,0],"mesh":0}])";
    EXPECT_EQ(expect_quad(load_gltf(gltf)).lower, Vec3d(1, 0, 0));
}

TEST(SceneFile, FlattensInstancesAndNumbersRepeatedNames)
{
    QuadGltf gltf;
    gltf.nodes = R"([{"name":"leaf","mesh":0},{"name":"leaf","mesh":0,"translation":[0,0,1]},)"
                 R"({"name":"leaf.2","mesh":0,"translation":[0,0,2]}])";
    gltf.roots = "[0,1,2]";
    const TriangleScene scene = load_gltf(gltf).scene;
    ASSERT_EQ(scene.objects.size(), 3U);
    EXPECT_EQ(scene.triangles.size(), 6U);
    EXPECT_EQ(scene.objects[0].name, "leaf");
    EXPECT_EQ(scene.objects[1].name, "leaf.2");
    EXPECT_EQ(scene.objects[2].name, "leaf.2.2");
    EXPECT_EQ(scene.bounds().upper, Vec3d(1, 1, 2));
}

TEST(SceneFile, KeepsTheFrontOfMirroredInstances)
{
    QuadGltf gltf;
    gltf.nodes = R"([{"mesh":0,"scale":[-1,1,1]}])";
    const SceneFile mirrored = load_gltf(gltf);
    EXPECT_EQ(expect_quad(mirrored).lower, Vec3d(-1, 0, 0));
    EXPECT_EQ(area_vector(mirrored.scene, 0), Vec3d(0, 0, 1));
    EXPECT_EQ(area_vector(mirrored.scene, 1), Vec3d(0, 0, 1));
    gltf.nodes = R"([{"mesh":0,"scale":[-1,-1,1]}])"; // mirrored twice is turned
    EXPECT_EQ(area_vector(load_gltf(gltf).scene, 0), Vec3d(0, 0, 1));
}

TEST(SceneFile, NamesThePartsOfANodeWithSeveralMeshes)
{
    const TemporaryFolder folder;
    const SceneFile file = load_scene_file(folder.write(
        "two.obj", std::string{"o box\n"} + "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\n"
                                            "usemtl red\nf 1 2 3\nusemtl blue\nf 1 2 4\n"));
    ASSERT_EQ(file.scene.objects.size(), 2U);
    EXPECT_NE(file.scene.objects[0].name, file.scene.objects[1].name);
    for (const Object& object : file.scene.objects) {
        EXPECT_EQ(object.triangle_count, 1U);
        EXPECT_TRUE(object.name.starts_with("box")) << object.name;
    }
}

TEST(SceneFile, CountsPointsAndLinesAndLeavesThemOut)
{
    const TemporaryFolder folder;
    const SceneFile file =
        load_scene_file(folder.write("mixed.obj", std::string{quad_obj} + "l 1 2\nl 2 3\np 4\n"));
    EXPECT_EQ(file.scene.triangles.size(), 2U);
    EXPECT_EQ(file.scene.ignored_primitives, 3U);
}

TEST(SceneFile, CountsDroppedTrianglesOfZeroArea)
{
    const TemporaryFolder folder;
    const SceneFile file =
        load_scene_file(folder.write("flat.obj", std::string{quad_obj} + "f 1 2 2\n"));
    EXPECT_EQ(file.scene.triangles.size(), 2U);
    EXPECT_EQ(file.scene.dropped_triangles, 1U);
}

TEST(SceneFile, LoadsAnObjWhoseMaterialsAreMissing)
{
    const TemporaryFolder folder;
    const auto path = folder.write("a.obj", "mtllib ../none.mtl\nusemtl red\n" +
                                                std::string{quad_obj} + "usemtl red\n");
    EXPECT_EQ(load_scene_file(path).scene.triangles.size(), 2U);
}

TEST(SceneFile, FindsBuffersInFoldersBelowAndByPercentEncodedNames)
{
    const TemporaryFolder folder;
    (void)folder.write("data/my mesh.bin", test::quad_buffer());
    QuadGltf gltf;
    for (const std::string_view uri : {"data/my mesh.bin", "data/my%20mesh.bin"}) {
        gltf.buffer = fmt::format(R"("uri":"{}",)", uri);
        const auto path = folder.write("quad.gltf", gltf.text());
        EXPECT_EQ(load_scene_file(path).scene.triangles.size(), 2U) << uri;
    }
}

TEST(SceneFile, AcceptsASceneFileThatIsALink)
{
    const TemporaryFolder folder;
    (void)folder.write("real/quad.obj", quad_obj);
    std::filesystem::create_directory(folder.path() / "links");
    std::filesystem::create_symlink(folder.path() / "real/quad.obj", folder.path() / "links/q.obj");
    EXPECT_EQ(load_scene_file(folder.path() / "links/q.obj").scene.triangles.size(), 2U);
}

/// Degrees of an angle that the file gave as a double, that Assimp keeps as float32 and, for a
/// camera with an aspect ratio, multiplied by it: at most three roundings of 2^-24 each. Versions
/// that multiply its half's tangent round five times, tangent and arc with up to 1 ulp, and undoing
/// that makes a relative error 1.22 times as large at 0.9 rad and 1.7: 1.22 · (5 + 2) < 9 of 2^-24.
void expect_angle_deg(double actual_deg, double expected_rad, double roundings = 3)
{
    const double expected_deg = expected_rad * 180 / std::numbers::pi;
    EXPECT_NEAR(actual_deg, expected_deg, roundings * std::ldexp(expected_deg, -24));
}

TEST(SceneFile, TakesTheFirstPerspectiveCamera)
{
    QuadGltf gltf;
    gltf.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.9,"znear":0.1,)"
                R"("aspectRatio":1.7}},{"type":"perspective","perspective":{"yfov":0.5,)"
                R"("znear":0.1}}],)";
    // The first in node order is camera 1; a quarter turn about y makes it look along −x.
    gltf.nodes = R"([{"mesh":0,"children":[1]},{"name":"eye","camera":1,"translation":[3,4,5],)"
                 R"("rotation":[0,0.7071067811865476,0,0.7071067811865476]},{"camera":0}])";
    gltf.roots = "[0,2]";
    const TemporaryFolder folder;
    for (const auto& path :
         {folder.write("c.gltf", gltf.text()), folder.write("c.glb", gltf.binary())}) {
        const auto camera = load_scene_file(path).defaults.camera;
        ASSERT_TRUE(camera) << path;
        EXPECT_EQ(camera->projection, Projection::perspective);
        EXPECT_EQ(camera->eye, Vec3d(3, 4, 5));
        // The quaternion's two float32 components give the matrix errors of a few 2^-24.
        EXPECT_LT(glm::length(camera->target - camera->eye - Vec3d(-1, 0, 0)), 1e-6);
        EXPECT_LT(glm::length(camera->up - Vec3d(0, 1, 0)), 1e-6);
        expect_angle_deg(camera->vertical_fov_deg, 0.5);
    }
}

TEST(SceneFile, DividesTheAspectRatioOutOfTheFieldOfView)
{
    QuadGltf gltf;
    gltf.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":0.9,"znear":0.1,)"
                R"("aspectRatio":1.7}}],)";
    gltf.nodes = R"([{"mesh":0,"camera":0}])";
    const auto camera = load_gltf(gltf).defaults.camera;
    ASSERT_TRUE(camera);
    expect_angle_deg(camera->vertical_fov_deg, 0.9, 9);
}

TEST(SceneFile, TakesTheFieldOfViewOfAnOlderGltf)
{
    const std::string text = fmt::format(
        R"({{"asset":{{"version":"1.0"}},"scene":"s","scenes":{{"s":{{"nodes":["m","c"]}}}},)"
        R"("nodes":{{"m":{{"meshes":["q"]}},"c":{{"camera":"eye"}}}},"cameras":{{"eye":{{)"
        R"("type":"perspective","perspective":{{"yfov":0.9,"aspectRatio":1.7,"znear":0.1,"zfar":9}}}}}},)"
        R"("meshes":{{"q":{{"primitives":[{{"attributes":{{"POSITION":"p"}},"indices":"i","mode":4}}]}}}},)"
        R"("accessors":{{"i":{{"bufferView":"iv","byteOffset":0,"componentType":5123,"count":6,)"
        R"("type":"SCALAR"}},"p":{{"bufferView":"pv","byteOffset":0,"componentType":5126,"count":4,)"
        R"("type":"VEC3"}}}},"bufferViews":{{"iv":{{"buffer":"b","byteOffset":0,"byteLength":12}},)"
        R"("pv":{{"buffer":"b","byteOffset":12,"byteLength":48}}}},"buffers":{{"b":{{"byteLength":60,)"
        R"("type":"arraybuffer","uri":"data:application/octet-stream;base64,{}"}}}}}})",
        test::base64(test::quad_buffer()));
    const TemporaryFolder folder;
    const auto camera = load_scene_file(folder.write("old.gltf", text)).defaults.camera;
    ASSERT_TRUE(camera);
    expect_angle_deg(camera->vertical_fov_deg, 0.9, 9);
}

TEST(SceneFile, TakesAnOrthographicCamera)
{
    QuadGltf gltf;
    gltf.more = R"("cameras":[{"type":"orthographic","orthographic":{"xmag":3,"ymag":1.5,)"
                R"("znear":0.1,"zfar":10}}],)";
    gltf.nodes = R"([{"mesh":0},{"camera":0,"translation":[0,0,7]}])";
    gltf.roots = "[0,1]";
    const auto camera = load_gltf(gltf).defaults.camera;
    ASSERT_TRUE(camera);
    EXPECT_EQ(camera->projection, Projection::orthographic);
    EXPECT_EQ(camera->orthographic_height_m, 3.0); // 2 ymag; 3, 1.5 and their quotient are exact
    EXPECT_EQ(camera->eye, Vec3d(0, 0, 7));
    EXPECT_EQ(camera->target, Vec3d(0, 0, 6));
}

QuadGltf gltf_with_lights(std::string_view lights, std::string_view nodes, std::string_view roots)
{
    QuadGltf gltf;
    gltf.more = fmt::format(R"("extensionsUsed":["KHR_lights_punctual"],)"
                            R"("extensions":{{"KHR_lights_punctual":{{"lights":[{}]}}}},)",
                            lights);
    gltf.nodes = nodes;
    gltf.roots = roots;
    return gltf;
}

std::string light_node(int light, std::string_view more = "")
{
    return fmt::format(
        R"({{"name":"light{}",{}"extensions":{{"KHR_lights_punctual":{{"light":{}}}}}}})", light,
        more, light);
}

TEST(SceneFile, TakesADirectionalLightAlongItsNodesMinusZ)
{
    // About x by −90°: −z becomes −y.
    const auto node = light_node(0, R"("rotation":[-0.7071067811865476,0,0,0.7071067811865476],)");
    const auto light =
        load_gltf(gltf_with_lights(R"({"type":"directional"})",
                                   R"([{"mesh":0,"children":[1]},)" + node + "]", "[0]"))
            .defaults.light;
    ASSERT_TRUE(light);
    EXPECT_EQ(light->type, LightType::directional);
    EXPECT_FALSE(light->position);
    ASSERT_TRUE(light->direction);
    // The quaternion's two float32 components give the matrix errors of a few 2^-24.
    EXPECT_LT(glm::length(*light->direction - Vec3d(0, -1, 0)), 1e-6);
}

TEST(SceneFile, TakesAPointLightWhereItsNodeStands)
{
    const auto gltf =
        gltf_with_lights(R"({"type":"point"},{"type":"spot","spot":{"outerConeAngle":0.4}})",
                         R"([{"mesh":0},)" + light_node(0, R"("translation":[1,2.5,8],)") + "," +
                             light_node(1) + "]",
                         "[0,1,2]");
    const TemporaryFolder folder;
    for (const auto& path :
         {folder.write("l.gltf", gltf.text()), folder.write("l.glb", gltf.binary())}) {
        const auto light = load_scene_file(path).defaults.light;
        ASSERT_TRUE(light) << path;
        EXPECT_EQ(light->type, LightType::point);
        EXPECT_EQ(light->position, Vec3d(1, 2.5, 8));
        EXPECT_FALSE(light->target);
        EXPECT_FALSE(light->direction);
    }
}

TEST(SceneFile, TakesASpotAndPassesOverOnesOf180Degrees)
{
    const auto gltf = gltf_with_lights(
        R"({"type":"spot","spot":{"outerConeAngle":1.6}},{"type":"spot","spot":{"innerConeAngle":0.1,"outerConeAngle":0.4}})",
        R"([{"mesh":0},)" + light_node(0) + "," + light_node(1, R"("translation":[0,0,8],)") + "]",
        "[0,1,2]");
    const TemporaryFolder folder;
    for (const auto& path :
         {folder.write("l.gltf", gltf.text()), folder.write("l.glb", gltf.binary())}) {
        const auto light = load_scene_file(path).defaults.light;
        ASSERT_TRUE(light) << path;
        EXPECT_EQ(light->type, LightType::spot);
        EXPECT_EQ(light->position, Vec3d(0, 0, 8));
        ASSERT_TRUE(light->target);
        EXPECT_EQ(glm::normalize(*light->target - *light->position), Vec3d(0, 0, -1));
        expect_angle_deg(light->cone_deg, 0.8);
    }
}

TEST(SceneFile, KnowsAllLightsThatAShadowMapMayBeOf)
{
    const SceneFile file = load_gltf(gltf_with_lights(
        R"({"type":"point"},{"type":"spot","spot":{"outerConeAngle":1.6}},{"type":"directional"})",
        R"([{"mesh":0},)" + light_node(0, R"("translation":[1,2.5,8],)") + "," + light_node(1) +
            "," + light_node(2) + "]",
        "[0,1,2,3]"));
    ASSERT_EQ(file.lights.size(), 2U);
    EXPECT_EQ(file.lights[0].name, "light0");
    EXPECT_EQ(file.lights[0].settings.type, LightType::point);
    EXPECT_EQ(file.lights[0].settings.position, file.defaults.light->position);
    EXPECT_EQ(file.lights[1].name, "light2");
    EXPECT_EQ(file.lights[1].settings.type, LightType::directional);
    EXPECT_TRUE(load_gltf(QuadGltf{}).lights.empty());
}

std::string named_light_node(std::string_view name, int light, int x)
{
    return fmt::format(R"({{"name":"{}","translation":[{},0,0],"extensions":)"
                       R"({{"KHR_lights_punctual":{{"light":{}}}}}}})",
                       name, x, light);
}

/// Assimp joins them by name and keeps one of the lights that share a definition.
TEST(SceneFile, KnowsLightsThatShareANameOrADefinition)
{
    const auto places = [](const std::string& nodes, const std::string& roots) {
        const auto gltf = gltf_with_lights(
            R"({"type":"point"},{"type":"spot","spot":{"outerConeAngle":0.4}})", nodes, roots);
        const TemporaryFolder folder;
        std::vector<std::string> found;
        for (const FileLight& light :
             load_scene_file(folder.write("l.glb", gltf.binary())).lights) {
            found.push_back(fmt::format("{} {} {}", light.name,
                                        light_type_name(light.settings.type),
                                        light.settings.position->x));
        }
        return found;
    };
    const std::string mesh = R"({"mesh":0})";
    const auto list = [](const auto&... nodes) {
        return fmt::format("[{}]", fmt::join(std::vector<std::string>{nodes...}, ","));
    };
    EXPECT_EQ(
        places(list(mesh, named_light_node("A", 0, 1), named_light_node("B", 0, 2)), "[0,1,2]"),
        (std::vector<std::string>{"A point 1", "B point 2"}));
    EXPECT_EQ(places(list(mesh, named_light_node("Lamp", 0, 1), named_light_node("Lamp", 1, 2)),
                     "[0,1,2]"),
              (std::vector<std::string>{"Lamp point 1", "Lamp spot 2"}));
    // Under one root, and deeper than it.
    EXPECT_EQ(
        places(list(R"({"mesh":0,"children":[1,2]})", R"({"translation":[10,0,0],"children":[3]})",
                    named_light_node("Lamp", 1, 2), named_light_node("Lamp", 1, 5)),
               "[0]"),
        (std::vector<std::string>{"Lamp spot 15", "Lamp spot 2"}));
    EXPECT_EQ(places(list(mesh, named_light_node("", 0, 3)), "[0,1]"),
              (std::vector<std::string>{" point 3"}));
}

TEST(SceneFile, GivesASpotWithoutAnglesTheDefaultCone)
{
    const auto light = load_gltf(gltf_with_lights(R"({"type":"spot","spot":{}})",
                                                  R"([{"mesh":0},)" + light_node(0) + "]", "[0,1]"))
                           .defaults.light;
    ASSERT_TRUE(light);
    expect_angle_deg(light->cone_deg, std::numbers::pi / 2); // KHR_lights_punctual: outer = pi/4
}

TEST(SceneFile, PassesOverCamerasAndLightsThatCannotBeUsed)
{
    auto gltf = gltf_with_lights(R"({"type":"spot","spot":{"outerConeAngle":1.5707963267948966}})",
                                 R"([{"mesh":0,"camera":0},)" + light_node(0) + "]", "[0,1]");
    gltf.more += R"("cameras":[{"type":"perspective","perspective":{"yfov":3.5,"znear":0.1}}],)";
    const SceneDefaults defaults = load_gltf(gltf).defaults;
    EXPECT_FALSE(defaults.camera);
    EXPECT_FALSE(defaults.light);
}

TEST(SceneFile, ReadsRealMeshesCompletely)
{
    const char* folder = std::getenv("GNOMON_SHARED_SCENES");
    if (folder == nullptr || !std::filesystem::exists(folder)) {
        GTEST_SKIP() << "GNOMON_SHARED_SCENES names no folder with bunny.obj and nefertiti.obj";
    }
    for (const auto& [name, count] :
         {std::pair{"bunny.obj", 69'451U}, std::pair{"nefertiti.obj", 99'938U}}) {
        const auto start = std::chrono::steady_clock::now();
        const TriangleScene scene = load_scene_file(std::filesystem::path{folder} / name).scene;
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        EXPECT_EQ(scene.triangles.size() + scene.dropped_triangles, count) << name;
        // A closed surface has about half as many vertices as triangles: they are shared.
        EXPECT_LT(scene.vertices.size(), scene.triangles.size() * 6 / 10) << name;
        RecordProperty(std::string{name} + "_ms", static_cast<int>(time.count() * 1e3));
    }
}

} // namespace
} // namespace gnomon::scene
