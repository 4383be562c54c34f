#include "scene/import/gltf_facts.hpp"

#include <assimp/scene.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

namespace gnomon::scene {

namespace {

using Json = nlohmann::json;

constexpr std::string_view draco = "KHR_draco_mesh_compression";
constexpr std::string_view quantization = "KHR_mesh_quantization";

/// Whether Assimp reads the extension, or ignoring it leaves all triangles in place.
bool is_read_or_harmless(std::string_view extension)
{
    constexpr std::array<std::string_view, 12> known{draco,
                                                     "KHR_lights_punctual",
                                                     "KHR_xmp",
                                                     "KHR_xmp_json_ld",
                                                     "KHR_techniques_webgl",
                                                     "KHR_technique_webgl",
                                                     "KHR_binary_glTF",
                                                     "KHR_materials_common",
                                                     "FB_ngon_encoding",
                                                     "EXT_lights_image_based",
                                                     "EXT_structural_metadata",
                                                     "EXT_mesh_features"};
    constexpr std::array<std::string_view, 5> families{
        "KHR_materials_", "KHR_texture_", "EXT_materials_", "EXT_texture_", "MSFT_texture_"};
    return std::ranges::find(known, extension) != known.end() ||
           std::ranges::any_of(
               families, [&](std::string_view family) { return extension.starts_with(family); });
}

std::uint32_t little_endian(const char* bytes)
{
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) {
        value = value << 8U | static_cast<unsigned char>(bytes[i]);
    }
    return value;
}

/// The file's JSON text: all of a .gltf, the first chunk of a .glb.
std::string json_text(const std::filesystem::path& path)
{
    std::ifstream file{path, std::ios::binary};
    std::array<char, 20> start{};
    file.read(start.data(), start.size());
    const bool is_binary = file.gcount() == start.size() &&
                           std::string_view{start.data(), 4} == "glTF" &&
                           std::string_view{&start[16], 4} == "JSON";
    std::string text;
    if (is_binary) {
        std::error_code error;
        const std::uint64_t bytes = std::filesystem::file_size(path, error);
        text.resize(static_cast<std::size_t>(
            std::min<std::uint64_t>(little_endian(&start[12]), error ? 0 : bytes)));
        file.read(text.data(), static_cast<std::streamsize>(text.size()));
        text.resize(static_cast<std::size_t>(file.gcount()));
        return text;
    }
    file.clear();
    file.seekg(0);
    return {std::istreambuf_iterator<char>{file}, {}};
}

/// A member of an object or an element of an array; null if it is missing.
template <typename Key>
const Json& at(const Json& json, const Key& key)
{
    static const Json none;
    if constexpr (std::is_convertible_v<Key, std::string_view>) {
        const auto found = json.is_object() ? json.find(key) : json.end();
        return json.is_object() && found != json.end() ? *found : none;
    } else {
        return json.is_array() && key < json.size() ? json[key] : none;
    }
}

/// An index or a count; empty if it is missing.
std::optional<std::size_t> number(const Json& json)
{
    return json.is_number_unsigned() ? std::optional{json.get<std::size_t>()} : std::nullopt;
}

/// The elements of an array that are strings.
std::vector<std::string> texts(const Json& json)
{
    std::vector<std::string> all;
    if (json.is_array()) {
        for (const Json& element : json) {
            if (element.is_string()) {
                all.push_back(element.get<std::string>());
            }
        }
    }
    return all;
}

/// The element at the index; without an index, the first element, glTF's default.
const Json& indexed(const Json& array, const Json& index)
{
    static const Json none;
    const auto i = number(index);
    return i ? at(array, *i) : none;
}

template <typename Visit>
void for_each_primitive(const Json& mesh, const Visit& visit)
{
    const Json& primitives = at(mesh, "primitives");
    if (primitives.is_array()) {
        std::ranges::for_each(primitives, visit);
    }
}

const Json& positions_of(const Json& gltf, const Json& primitive)
{
    return indexed(at(gltf, "accessors"), at(at(primitive, "attributes"), "POSITION"));
}

/// Assimp misreads the bytes of quantized positions as floats.
bool has_quantized_positions(const Json& gltf)
{
    constexpr std::size_t float_type = 5126;
    bool found = false;
    const Json& meshes = at(gltf, "meshes");
    if (meshes.is_array()) {
        for (const Json& mesh : meshes) {
            for_each_primitive(mesh, [&](const Json& primitive) {
                const auto type = number(at(positions_of(gltf, primitive), "componentType"));
                found = found || type.value_or(float_type) != float_type;
            });
        }
    }
    return found;
}

void require_known_extensions(const Json& gltf)
{
    for (const std::string& extension : texts(at(gltf, "extensionsRequired"))) {
        const bool is_known = extension == quantization ? !has_quantized_positions(gltf)
                                                        : is_read_or_harmless(extension);
        if (!is_known) {
            throw UnsupportedContent{fmt::format(
                "it requires the extension {}, which is not supported; export without it",
                extension)};
        }
    }
}

std::vector<std::string> unread_extensions(const Json& gltf)
{
    std::vector<std::string> all = texts(at(gltf, "extensionsUsed"));
    std::erase_if(all, [](const std::string& extension) {
        return extension == quantization || is_read_or_harmless(extension);
    });
    return all;
}

/// Debian 12's Assimp crashes on a skin without them, although glTF makes them optional.
void require_bind_matrices(const Json& gltf)
{
    const Json& skins = at(gltf, "skins");
    for (std::size_t i = 0; i < skins.size(); ++i) {
        if (at(skins, i).is_object() && at(at(skins, i), "inverseBindMatrices").is_null()) {
            throw UnsupportedContent{fmt::format("its skin {} has no inverseBindMatrices, which "
                                                 "the importer needs; export without skins",
                                                 i)};
        }
    }
}

constexpr std::size_t triangle_mode = 4; // the modes are GL's: strips and fans follow

/// @return  a third of the corners
std::uint64_t whole_triangles(const Json& mesh, std::size_t corners)
{
    if (corners % 3 != 0) {
        const Json& name = at(mesh, "name");
        throw std::runtime_error{
            fmt::format("mesh \"{}\" has {} indices, which is not a whole number of triangles",
                        name.is_string() ? name.get<std::string>() : "", corners)};
    }
    return corners / 3;
}

/// How many triangles a primitive's indices make.
std::uint64_t triangle_count(const Json& gltf, const Json& mesh, const Json& primitive)
{
    constexpr std::size_t last_mode = 6;
    const Json& positions = positions_of(gltf, primitive);
    const Json& indices = at(primitive, "indices");
    const Json& corners = indices.is_null() ? positions : indexed(at(gltf, "accessors"), indices);
    const std::size_t mode = number(at(primitive, "mode")).value_or(triangle_mode);
    const std::size_t count = number(at(corners, "count")).value_or(0);
    if (positions.is_null() || mode < triangle_mode || mode > last_mode) {
        return 0;
    }
    if (mode != triangle_mode) {
        return count < 2 ? 0 : count - 2;
    }
    return whole_triangles(mesh, count);
}

/// In glTF 1.0, meshes and accessors have names. Assimp refuses out-of-range indices there itself.
void require_whole_triangles_of_1_0(const Json& gltf)
{
    for (const Json& mesh : at(gltf, "meshes")) {
        for_each_primitive(mesh, [&](const Json& primitive) {
            const Json& indices = at(primitive, "indices");
            if (indices.is_string() &&
                number(at(primitive, "mode")).value_or(triangle_mode) == triangle_mode) {
                const Json& accessor =
                    at(at(gltf, "accessors"), indices.get_ref<const std::string&>());
                (void)whole_triangles(mesh, number(at(accessor, "count")).value_or(0));
            }
        });
    }
}

/// The nodes of the shown scene, parents before children, each once.
std::vector<const Json*> shown_nodes(const Json& gltf)
{
    const Json& all_nodes = at(gltf, "nodes");
    std::vector<bool> is_visited(all_nodes.size());
    std::vector<const Json*> shown;
    std::vector<const Json*> open; // indices of nodes, the next one last
    const auto push = [&](const Json& indices) {
        for (std::size_t i = indices.is_array() ? indices.size() : 0; i-- > 0;) {
            open.push_back(&indices[i]);
        }
    };
    push(at(at(at(gltf, "scenes"), number(at(gltf, "scene")).value_or(0)), "nodes"));
    while (!open.empty()) {
        const auto i = number(*open.back());
        open.pop_back();
        if (i && *i < is_visited.size() && !is_visited[*i]) {
            is_visited[*i] = true;
            shown.push_back(&at(all_nodes, *i));
            push(at(*shown.back(), "children"));
        }
    }
    return shown;
}

/// Which meshes the shown scene uses.
std::vector<bool> placed_meshes(const Json& gltf)
{
    std::vector<bool> is_placed(at(gltf, "meshes").size());
    for (const Json* node : shown_nodes(gltf)) {
        const auto mesh = number(at(*node, "mesh"));
        if (mesh && *mesh < is_placed.size()) {
            is_placed[*mesh] = true;
        }
    }
    return is_placed;
}

std::string text_of(const Json& json)
{
    return json.is_string() ? json.get<std::string>() : std::string{};
}

const Json& punctual_lights(const Json& json)
{
    return at(at(json, "extensions"), "KHR_lights_punctual");
}

void read_lights(const Json& gltf, GltfFacts& facts)
{
    constexpr double default_outer_cone_rad = std::numbers::pi / 4; // KHR_lights_punctual
    const Json& definitions = at(punctual_lights(gltf), "lights");
    const std::vector<const Json*> nodes = shown_nodes(gltf);
    facts.node_count = nodes.size();
    facts.root_count =
        at(at(at(gltf, "scenes"), number(at(gltf, "scene")).value_or(0)), "nodes").size();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Json& light = indexed(definitions, at(punctual_lights(*nodes[i]), "light"));
        if (light.is_null()) {
            continue;
        }
        const Json& angle = at(at(light, "spot"), "outerConeAngle");
        const double outer_cone_rad =
            angle.is_number() ? angle.get<double>() : default_outer_cone_rad;
        std::string name = text_of(at(*nodes[i], "name"));
        facts.lights.push_back({i, name.empty() ? text_of(at(light, "name")) : std::move(name),
                                text_of(at(light, "type")), static_cast<float>(outer_cone_rad)});
    }
}

std::uint64_t placed_triangles(const Json& gltf)
{
    const Json& meshes = at(gltf, "meshes");
    const std::vector<bool> is_placed = placed_meshes(gltf);
    std::uint64_t sum = 0;
    for (std::size_t m = 0; m < is_placed.size(); ++m) {
        const Json& mesh = at(meshes, m);
        if (is_placed[m]) {
            for_each_primitive(
                mesh, [&](const Json& primitive) { sum += triangle_count(gltf, mesh, primitive); });
        }
    }
    return sum;
}

} // namespace

GltfFacts read_gltf_facts(const std::filesystem::path& scene_file)
{
    const Json gltf = Json::parse(json_text(scene_file), nullptr, false);
    if (!gltf.is_object()) {
        return {}; // Assimp reports the error
    }
    require_known_extensions(gltf);
    GltfFacts facts;
    facts.unread_extensions = unread_extensions(gltf);
    const auto required = texts(at(gltf, "extensionsRequired"));
    facts.requires_draco = std::ranges::find(required, draco) != required.end();
    if (at(gltf, "meshes").is_array() && at(gltf, "nodes").is_array()) {
        require_bind_matrices(gltf);
        facts.triangles = placed_triangles(gltf);
        read_lights(gltf, facts);
    } else if (at(gltf, "meshes").is_object()) {
        require_whole_triangles_of_1_0(gltf);
    }
    return facts;
}

void require_triangles(const GltfFacts& facts, const aiScene& scene)
{
    std::vector<const aiNode*> open{scene.mRootNode};
    std::vector<bool> is_counted(scene.mNumMeshes);
    std::uint64_t read = 0;
    while (!open.empty()) {
        const aiNode& node = *open.back();
        open.pop_back();
        open.insert(open.end(), node.mChildren, node.mChildren + node.mNumChildren);
        for (unsigned k = 0; k < node.mNumMeshes; ++k) {
            const unsigned m = node.mMeshes[k];
            const aiMesh& mesh = *scene.mMeshes[m];
            if (!is_counted[m]) {
                is_counted[m] = true;
                read += static_cast<std::uint64_t>(
                    std::count_if(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                                  [](const aiFace& face) { return face.mNumIndices == 3; }));
            }
        }
    }
    if (read >= facts.triangles) {
        return;
    }
    if (facts.requires_draco) {
        throw UnsupportedContent{fmt::format("it requires the extension {}, which this Assimp was "
                                             "built without; export without it",
                                             draco)};
    }
    throw std::runtime_error{fmt::format("vertex index out of range, in {} of its {} triangles",
                                         facts.triangles - read, facts.triangles)};
}

} // namespace gnomon::scene
