#include "scene/load/scene_notes.hpp"

#include "scene/import/load_scene_file.hpp"
#include "scene/load/load_scene.hpp"
#include "scene_file_fixture.hpp"

#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {
namespace {

using test::QuadGltf;
using test::refusal_of;
using test::TemporaryFolder;
using test::with_primitives;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// "kind count: text" of each note on a file's scene.
std::vector<std::string> notes_of(const SceneFile& file, LeftToFile left = {true, true})
{
    std::vector<std::string> lines;
    for (const SceneNote& note : scene_notes(file.scene, file.defaults, left)) {
        lines.push_back(fmt::format("{} {}: {}", note.kind, note.count, note.text));
    }
    return lines;
}

std::vector<std::string> notes_of(const std::string& name, const std::string& contents,
                                  LeftToFile left = {true, true})
{
    const TemporaryFolder folder;
    return notes_of(load_scene_file(folder.write(name, contents)), left);
}

std::string quad_of_material(const std::string& material)
{
    QuadGltf gltf;
    gltf.more = fmt::format(R"("materials":[{}],)", material);
    return with_primitives(gltf, R"([{"attributes":{"POSITION":1},"indices":0,"material":0}])");
}

/// The quad with a node for each of these lights.
QuadGltf with_lights(const std::string& lights, int count)
{
    QuadGltf gltf;
    gltf.more = fmt::format(R"("extensionsUsed":["KHR_lights_punctual"],)"
                            R"("extensions":{{"KHR_lights_punctual":{{"lights":[{}]}}}},)",
                            lights);
    gltf.nodes = R"([{"name":"quad","mesh":0})";
    gltf.roots = "[0";
    for (int i = 0; i < count; ++i) {
        gltf.nodes += fmt::format(
            R"(,{{"name":"light{0}","extensions":{{"KHR_lights_punctual":{{"light":{0}}}}}}})", i);
        gltf.roots += fmt::format(",{}", i + 1);
    }
    gltf.nodes += "]";
    gltf.roots += "]";
    return gltf;
}

constexpr const char* triangle_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";

TEST(SceneNotes, AreNoneForAPlainMeshAndForBuiltinScenes)
{
    EXPECT_THAT(notes_of("quad.gltf", QuadGltf{}.text()), IsEmpty());
    EXPECT_THAT(notes_of("quad.glb", QuadGltf{}.binary()), IsEmpty());
    EXPECT_THAT(notes_of("a.obj", triangle_obj), IsEmpty());
    SceneSettings builtin;
    builtin.builtin = "sphere-cube";
    EXPECT_THAT(notes_of(load_scene(builtin)), IsEmpty());
}

TEST(SceneNotes, TellMasksAndBlendsThatAreTakenAsSolid)
{
    EXPECT_THAT(notes_of("a.gltf", quad_of_material(R"({"alphaMode":"MASK"})")),
                ElementsAre("alpha_mask 1: 1 material is cut out by alpha, but taken as solid: 1 "
                            "object"));
    EXPECT_THAT(notes_of("a.gltf", quad_of_material(R"({"alphaMode":"BLEND",)"
                                                    R"("pbrMetallicRoughness":)"
                                                    R"({"baseColorFactor":[1,1,1,0]}})")),
                ElementsAre("alpha_blend 1: 1 material is transparent, but taken as solid: 1 "
                            "object",
                            "alpha_zero 1: 1 material has a base alpha of 0, and would not be seen "
                            "at all, but is taken as solid"));
    // In glTF, the alpha of an opaque material is ignored.
    EXPECT_THAT(notes_of("a.gltf", quad_of_material(R"({"pbrMetallicRoughness":)"
                                                    R"({"baseColorFactor":[1,1,1,0]}})")),
                IsEmpty());
}

TEST(SceneNotes, CountTheObjectsOfTransparentMaterials)
{
    std::string text = quad_of_material(R"({"alphaMode":"MASK"})");
    const std::string one = R"("nodes":[{"name":"quad","mesh":0}])";
    text.replace(text.find(one), one.size(), R"("nodes":[{"mesh":0,"children":[1]},{"mesh":0}])");
    EXPECT_THAT(notes_of("a.gltf", text),
                ElementsAre("alpha_mask 1: 1 material is cut out by alpha, but taken as solid: 2 "
                            "objects"));
}

TEST(SceneNotes, TellTransparencyOfObjMaterials)
{
    const TemporaryFolder folder;
    folder.write("a.mtl", "newmtl glass\nKd 1 1 1\nd 0.5\n");
    const auto file =
        folder.write("a.obj", std::string{"mtllib a.mtl\nusemtl glass\n"} + triangle_obj);
    EXPECT_THAT(notes_of(load_scene_file(file)),
                ElementsAre(HasSubstr("alpha_blend 1: 1 material is transparent")));
}

TEST(SceneNotes, TellTheAlphaOfPlyVertices)
{
    const auto ply = [](int alpha) {
        std::string text = "ply\nformat ascii 1.0\nelement vertex 3\n"
                           "property float x\nproperty float y\nproperty float z\n"
                           "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                           "property uchar alpha\nelement face 1\n"
                           "property list uchar int vertex_indices\nend_header\n";
        for (const char* place : {"0 0 0", "1 0 0", "1 1 0"}) {
            text += fmt::format("{} 9 9 9 {}\n", place, alpha);
        }
        return text + "3 0 1 2\n";
    };
    EXPECT_THAT(notes_of("a.ply", ply(255)), IsEmpty());
    EXPECT_THAT(notes_of("a.ply", ply(254)),
                ElementsAre("alpha_vertices 1: 1 object has vertices with an alpha below 1, but is "
                            "taken as solid"));
}

TEST(SceneNotes, TellWhatTheFileGaveUnlessTheJobGivesItself)
{
    QuadGltf gltf = with_lights(R"({"type":"directional"},{"type":"point"})", 2);
    EXPECT_THAT(notes_of("a.gltf", gltf.text()),
                ElementsAre("light_from_file 1: the light is the file's own, directional",
                            "unused_lights 1: the file's 1 other light is left out"));
    EXPECT_THAT(notes_of("a.gltf", gltf.text(), {true, false}), IsEmpty());
    gltf = {};
    gltf.more = R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":0.1}}],)";
    gltf.nodes = R"([{"mesh":0},{"name":"eye","camera":0,"translation":[0,0,3]}])";
    gltf.roots = "[0,1]";
    EXPECT_THAT(notes_of("a.gltf", gltf.text()),
                ElementsAre("camera_from_file 1: the camera is the file's own"));
    EXPECT_THAT(notes_of("a.gltf", gltf.text(), {false, true}), IsEmpty());
}

TEST(SceneNotes, TellLightsThatCannotBeUsed)
{
    const QuadGltf wide = with_lights(R"({"type":"spot","spot":{"outerConeAngle":3.0}})", 1);
    EXPECT_THAT(notes_of("a.gltf", wide.text()),
                ElementsAre(HasSubstr("unused_lights 1: 1 light of the file cannot be used")));
}

TEST(SceneNotes, TellOfAPointLight)
{
    EXPECT_THAT(notes_of("a.gltf", with_lights(R"({"type":"point"})", 1).text()),
                ElementsAre("light_from_file 1: the light is the file's own, point"));
}

TEST(SceneNotes, AreAboutTheJobAsItIs)
{
    Job job;
    EXPECT_EQ(left_to_file(job), (LeftToFile{true, true}));
    job.light.emplace();
    EXPECT_EQ(left_to_file(job), (LeftToFile{true, false}));
}

TEST(SceneNotes, TellMorphTargetsAndAnimationsAtRest)
{
    EXPECT_THAT(notes_of("a.gltf", with_primitives({}, R"([{"attributes":{"POSITION":1},)"
                                                       R"("indices":0,"targets":)"
                                                       R"([{"POSITION":1}]}])")),
                ElementsAre(HasSubstr("morphs_at_rest 1: 1 object has the base shape")));
    QuadGltf moving;
    moving.more = R"("animations":[{"channels":[{"sampler":0,"target":{"node":0,)"
                  R"("path":"translation"}}],"samplers":[{"input":0,"output":1}]}],)";
    EXPECT_THAT(notes_of("a.gltf", moving.text()),
                ElementsAre(HasSubstr("animations_at_rest 1: 1 animation is not played")));
}

/// The quad with a skin of one joint; its accessors 2 to 4 are joints, weights and a bind matrix.
std::string skinned_quad(std::string_view bind_matrices)
{
    std::string bytes(16, '\0');
    for (int corner = 0; corner < 4; ++corner) {
        bytes += test::bytes_of(std::array<float, 4>{1, 0, 0, 0});
    }
    bytes += test::bytes_of(std::array<float, 16>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    QuadGltf gltf;
    gltf.nodes = R"([{"mesh":0,"skin":0},{"name":"joint"}])";
    gltf.roots = "[0,1]";
    gltf.more = fmt::format(R"("skins":[{{"joints":[1]{}}}],)", bind_matrices);
    std::string text = with_primitives(
        gltf, R"([{"attributes":{"POSITION":1,"JOINTS_0":2,"WEIGHTS_0":3},"indices":0}])");
    const auto insert = [&](std::string_view before, const std::string& what) {
        text.insert(text.find(before), what);
    };
    insert(R"(],"bufferViews")",
           R"(,{"bufferView":2,"componentType":5121,"count":4,"type":"VEC4"},)"
           R"({"bufferView":3,"componentType":5126,"count":4,"type":"VEC4"},)"
           R"({"bufferView":4,"componentType":5126,"count":1,"type":"MAT4"})");
    insert(R"(],"buffers")", R"(,{"buffer":1,"byteOffset":0,"byteLength":16},)"
                             R"({"buffer":1,"byteOffset":16,"byteLength":64},)"
                             R"({"buffer":1,"byteOffset":80,"byteLength":64})");
    text.insert(text.rfind("]}"),
                fmt::format(R"(,{{"uri":"data:application/octet-stream;base64,{}",)"
                            R"("byteLength":144}})",
                            test::base64(bytes)));
    return text;
}

TEST(SceneNotes, TellSkinsAtRest)
{
    EXPECT_THAT(notes_of("a.gltf", skinned_quad(R"(,"inverseBindMatrices":4)")),
                ElementsAre(HasSubstr("skins_at_rest 1: 1 object stands as modelled")));
}

TEST(SceneNotes, AreNotReachedWhereAssimpWouldCrashOnASkin)
{
    EXPECT_THAT(refusal_of("a.gltf", skinned_quad("")),
                HasSubstr("its skin 0 has no inverseBindMatrices, which the importer needs; export "
                          "without skins"));
}

TEST(SceneNotes, TellExtensionsThatTheFileCanDoWithout)
{
    QuadGltf gltf;
    gltf.more = R"("extensionsUsed":["KHR_materials_unlit","EXT_mesh_gpu_instancing"],)";
    EXPECT_THAT(notes_of("a.gltf", gltf.text()),
                ElementsAre("unread_extensions 1: 1 extension of the file is not read: "
                            "EXT_mesh_gpu_instancing"));
}

TEST(SceneNotes, CountWhatIsLeftOut)
{
    EXPECT_THAT(
        notes_of("a.obj", std::string{triangle_obj} + "l 1 2\np 3\nf 1 1 2\nsurf 0 1 0 1 1 2 3\n"),
        ElementsAre("free_form_shapes 1: 1 free-form shape is left out: export polygons",
                    "points_and_lines 2: points and lines cast no shadow, and 2 are left "
                    "out",
                    "flat_triangles 1: 1 flat triangle is left out: no area is left in "
                    "float32"));
}

TEST(SceneNotes, TellWhereFloat32IsCoarseBesideTheScene)
{
    // Beyond 4 million float32 has steps of 0.5: the second triangle's corners fall together.
    const std::string wall = "o wall\nv 6000000 0 0\nv 6000001 0 0\nv 6000000 1 0\n"
                             "v 6000000.1 0 0\nf 1 2 3\nf 1 4 3\n";
    EXPECT_THAT(notes_of("a.obj", wall),
                ElementsAre(HasSubstr("flat_triangles 1: "),
                            "coarse_float32 3: the scene lies up to 6,000,001 from its origin, "
                            "where float32 has steps of 0.5: coordinates were moved by up to 0.25, "
                            "and no area is left of 1 triangle of \"wall\"; move the scene near "
                            "its origin"));
    // The diagonal is 1.41: at 256 a step of 2^-15 is less than 2^-14 of it.
    EXPECT_THAT(notes_of("a.obj", "v 256 0 0\nv 257 0 0\nv 256 1 0\nf 1 2 3\n"), IsEmpty());
    EXPECT_THAT(notes_of("a.obj", "v 4096 0 0\nv 4097 0 0\nv 4096 1 0\nf 1 2 3\n"),
                ElementsAre(HasSubstr("coarse_float32 3: ")));
}

TEST(SceneNotes, GroupTheThousandsOfACount)
{
    std::string flat;
    for (int i = 0; i < 1200; ++i) {
        flat += "f 1 1 2\n";
    }
    EXPECT_THAT(notes_of("a.obj", std::string{triangle_obj} + flat),
                ElementsAre("flat_triangles 1200: 1,200 flat triangles are left out: no area is "
                            "left in float32"));
}

TEST(RequiredExtensions, AreRefusedByNameUnlessTheyMoveNoTriangle)
{
    for (const std::string extension :
         {"EXT_mesh_gpu_instancing", "EXT_meshopt_compression", "XYZ_unheard_of"}) {
        QuadGltf gltf;
        gltf.more = fmt::format(R"("extensionsRequired":["{}"],)", extension);
        for (const auto& [name, contents] :
             {std::pair{"a.gltf", gltf.text()}, {"a.glb", gltf.binary()}}) {
            EXPECT_THAT(refusal_of(name, contents),
                        HasSubstr(fmt::format("cannot be imported: it requires the extension {}, "
                                              "which is not supported; export without it",
                                              extension)));
        }
    }
    QuadGltf harmless;
    harmless.more = R"("extensionsRequired":["KHR_texture_transform","KHR_mesh_quantization"],)";
    EXPECT_THAT(notes_of("a.gltf", harmless.text()), IsEmpty());
}

TEST(RequiredExtensions, AreRefusedWherePositionsAreQuantized)
{
    QuadGltf gltf;
    gltf.more = R"("extensionsRequired":["KHR_mesh_quantization"],)";
    std::string text = gltf.text();
    const std::string floats = R"("componentType":5126)";
    text.replace(text.find(floats), floats.size(), R"("componentType":5122)");
    EXPECT_THAT(refusal_of("a.gltf", text), HasSubstr("extension KHR_mesh_quantization, which"));
}

} // namespace
} // namespace gnomon::scene
