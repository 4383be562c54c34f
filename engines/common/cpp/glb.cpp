#include "cpp/glb.hpp"

#include "cpp/json.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace engine {
namespace {

using Bytes = std::vector<char>;

constexpr std::size_t file_header_bytes = 12;
constexpr std::size_t chunk_header_bytes = 8;
constexpr int component_uint16 = 5123;
constexpr int component_uint32 = 5125;

template <typename Number>
Number number_at(const Bytes& bytes, std::size_t place)
{
    Number number{};
    if (place + sizeof number > bytes.size()) {
        throw std::runtime_error{"the mesh file ends too early"};
    }
    std::memcpy(&number, bytes.data() + place, sizeof number);
    return number;
}

/// A .glb file: its JSON, its bytes, and where its buffer begins in them.
struct Glb {
    Json json;
    Bytes bytes;
    std::size_t buffer = 0;
};

Glb load(const std::string& file)
{
    std::ifstream stream{file, std::ios::binary};
    if (!stream) {
        throw std::runtime_error{file + " cannot be read"};
    }
    Glb glb{{}, Bytes{std::istreambuf_iterator<char>{stream}, {}}, 0};
    const std::size_t begin = file_header_bytes + chunk_header_bytes;
    const std::size_t end = begin + number_at<std::uint32_t>(glb.bytes, file_header_bytes);
    if (end > glb.bytes.size()) {
        throw std::runtime_error{file + " ends too early"};
    }
    glb.json = Json::parse(glb.bytes.data() + begin, glb.bytes.data() + end);
    glb.buffer = end + chunk_header_bytes;
    return glb;
}

std::size_t start_of(const Glb& glb, const Json& accessor)
{
    const Json& view = glb.json.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    return glb.buffer + view.value("byteOffset", std::size_t{0}) +
           accessor.value("byteOffset", std::size_t{0});
}

std::vector<std::uint32_t> indices(const Glb& glb, const Json& accessor)
{
    const std::size_t start = start_of(glb, accessor);
    const int type = accessor.at("componentType").get<int>();
    std::vector<std::uint32_t> read(accessor.at("count").get<std::size_t>());
    for (std::size_t i = 0; i < read.size(); ++i) {
        if (type == component_uint32) {
            read[i] = number_at<std::uint32_t>(glb.bytes, start + 4 * i);
        } else if (type == component_uint16) {
            read[i] = number_at<std::uint16_t>(glb.bytes, start + 2 * i);
        } else {
            throw std::runtime_error{"the mesh file's indices are of an unknown type"};
        }
    }
    return read;
}

void add_triangles(const Glb& glb, const Json& part, std::vector<float>& corners)
{
    const Json& accessors = glb.json.at("accessors");
    const Json& position = accessors.at(part.at("attributes").at("POSITION").get<std::size_t>());
    const std::size_t start = start_of(glb, position);
    for (const std::uint32_t index :
         indices(glb, accessors.at(part.at("indices").get<std::size_t>()))) {
        for (std::size_t k = 0; k < 3; ++k) {
            corners.push_back(number_at<float>(glb.bytes, start + 4 * (3 * index + k)));
        }
    }
}

} // namespace

std::vector<GlbObject> read_glb(const std::string& file)
{
    const Glb glb = load(file);
    std::vector<GlbObject> objects;
    for (const Json& node : glb.json.at("nodes")) {
        GlbObject object{node.at("name").get<std::string>(), {}};
        const Json& mesh = glb.json.at("meshes").at(node.at("mesh").get<std::size_t>());
        for (const Json& part : mesh.at("primitives")) {
            add_triangles(glb, part, object.corners);
        }
        objects.push_back(std::move(object));
    }
    return objects;
}

} // namespace engine
