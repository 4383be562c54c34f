#include "store/case/case_files.hpp"

#include "scene/error.hpp"

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

namespace gnomon::store {

namespace {

using GlbJson = nlohmann::ordered_json;
using scene::Vec3f;

// Numbers that glTF 2.0 gives names to: https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html
constexpr int float_component = 5126;
constexpr int uint_component = 5125;
constexpr int vertex_target = 34962;
constexpr int index_target = 34963;
constexpr std::uint32_t glb_magic = 0x46546C67;
constexpr std::uint32_t json_chunk = 0x4E4F534A;
constexpr std::uint32_t binary_chunk = 0x004E4942;

/// Builds the bytes of a GLB file and its JSON. Assumes a little-endian machine.
class GlbWriter {
public:
    explicit GlbWriter(const scene::TriangleScene& scene)
        : scene_{scene},
          number_of_(scene.vertices.size(), scene::no_triangle)
    {
        for (const char* const list : {"meshes", "nodes", "accessors", "bufferViews"}) {
            json_[list] = GlbJson::array();
        }
    }

    void add(const scene::Object& object)
    {
        WrittenVertices written;
        std::vector<std::uint32_t> indices;
        for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
            const std::uint32_t triangle = object.first_triangle + t;
            for (std::size_t k = 0; k < 3; ++k) {
                indices.push_back(number(written, scene_.triangles[triangle].at(k), triangle, k));
            }
        }
        for (const std::uint32_t vertex : written.vertices) {
            number_of_[vertex] = scene::no_triangle;
        }
        GlbJson attributes{{"POSITION", add_positions(written.positions)}};
        if (!written.normals.empty()) {
            attributes["NORMAL"] = add_vectors(written.normals);
        }
        const std::size_t index = add_indices(indices);
        GlbJson primitive{{"attributes", std::move(attributes)}, {"indices", index}};
        json_["nodes"].push_back({{"name", object.name}, {"mesh", json_["meshes"].size()}});
        json_["meshes"].push_back({{"primitives", GlbJson::array({std::move(primitive)})}});
    }

    [[nodiscard]] std::vector<std::byte> bytes()
    {
        GlbJson roots = GlbJson::array();
        for (std::size_t i = 0; i < json_["nodes"].size(); ++i) {
            roots.push_back(i);
        }
        json_["asset"] = {{"version", "2.0"}, {"generator", "gnomon"}};
        json_["scene"] = 0;
        json_["scenes"] = GlbJson::array({{{"nodes", std::move(roots)}}});
        json_["buffers"] = GlbJson::array({{{"byteLength", binary_.size()}}});
        std::string text = json_.dump(-1, ' ', false, GlbJson::error_handler_t::replace);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const std::uint64_t total = 12 + 8 + text.size() + 8 + binary_.size();
        if (total > std::numeric_limits<std::uint32_t>::max()) {
            throw scene::InputError("the scene takes more than the 4 GiB that a .glb file can "
                                    "hold: export a smaller one");
        }
        std::vector<std::byte> file;
        file.reserve(total);
        for (const std::uint64_t word : {std::uint64_t{glb_magic}, std::uint64_t{2}, total,
                                         std::uint64_t{text.size()}, std::uint64_t{json_chunk}}) {
            append_word(file, word);
        }
        append(file, text.data(), text.size());
        append_word(file, binary_.size());
        append_word(file, binary_chunk);
        append(file, binary_.data(), binary_.size());
        return file;
    }

private:
    /// An object's vertices, duplicated if they have several normals.
    struct WrittenVertices {
        std::vector<std::uint32_t> vertices; ///< of the scene
        std::vector<Vec3f> positions;
        std::vector<Vec3f> normals;      ///< empty where the scene has none
        std::vector<std::uint32_t> next; ///< the same vertex with another normal
    };

    /// The index of a triangle's corner among the written vertices; writes it if it is new.
    std::uint32_t number(WrittenVertices& written, std::uint32_t vertex, std::uint32_t triangle,
                         std::size_t corner)
    {
        const bool has_normals = !scene_.attributes.empty();
        const Vec3f normal = has_normals ? scene_.attributes[triangle].at(corner).normal : Vec3f{};
        std::uint32_t* place = &number_of_[vertex];
        while (*place != scene::no_triangle && has_normals && written.normals[*place] != normal) {
            place = &written.next[*place];
        }
        if (*place == scene::no_triangle) {
            const auto added = static_cast<std::uint32_t>(written.positions.size());
            *place = added; // before the vector it points into grows
            written.vertices.push_back(vertex);
            written.positions.push_back(scene_.vertices[vertex]);
            written.next.push_back(scene::no_triangle);
            if (has_normals) {
                written.normals.push_back(normal);
            }
            return added;
        }
        return *place;
    }

    static void append(std::vector<std::byte>& bytes, const void* data, std::size_t size)
    {
        const std::size_t old = bytes.size();
        bytes.resize(old + size);
        if (size > 0) {
            std::memcpy(bytes.data() + old, data, size);
        }
    }
    static void append_word(std::vector<std::byte>& bytes, std::uint64_t value)
    {
        const auto word = static_cast<std::uint32_t>(value);
        append(bytes, &word, sizeof(word));
    }

    /// Returns the accessor's index.
    std::size_t add_view(const void* data, std::size_t size, int target, GlbJson accessor)
    {
        accessor["bufferView"] = json_["bufferViews"].size();
        json_["bufferViews"].push_back({{"buffer", 0},
                                        {"byteOffset", binary_.size()},
                                        {"byteLength", size},
                                        {"target", target}});
        append(binary_, data, size);
        json_["accessors"].push_back(std::move(accessor));
        return json_["accessors"].size() - 1;
    }

    std::size_t add_positions(const std::vector<Vec3f>& positions)
    {
        Vec3f lower = positions.front();
        Vec3f upper = positions.front();
        for (const Vec3f& position : positions) {
            lower = glm::min(lower, position);
            upper = glm::max(upper, position);
        }
        return add_view(positions.data(), positions.size() * sizeof(Vec3f), vertex_target,
                        {{"componentType", float_component},
                         {"count", positions.size()},
                         {"type", "VEC3"},
                         {"min", {lower.x, lower.y, lower.z}},
                         {"max", {upper.x, upper.y, upper.z}}});
    }

    std::size_t add_vectors(const std::vector<Vec3f>& vectors)
    {
        return add_view(
            vectors.data(), vectors.size() * sizeof(Vec3f), vertex_target,
            {{"componentType", float_component}, {"count", vectors.size()}, {"type", "VEC3"}});
    }

    std::size_t add_indices(const std::vector<std::uint32_t>& indices)
    {
        return add_view(
            indices.data(), indices.size() * sizeof(std::uint32_t), index_target,
            {{"componentType", uint_component}, {"count", indices.size()}, {"type", "SCALAR"}});
    }

    const scene::TriangleScene& scene_;
    std::vector<std::uint32_t> number_of_; ///< [vertex] within the object being added
    GlbJson json_;
    std::vector<std::byte> binary_;
};

} // namespace

std::vector<std::byte> encode_glb(const scene::TriangleScene& scene)
{
    static_assert(sizeof(Vec3f) == 12);
    GlbWriter writer{scene};
    for (const scene::Object& object : scene.objects) {
        writer.add(object);
    }
    return writer.bytes();
}

} // namespace gnomon::store
