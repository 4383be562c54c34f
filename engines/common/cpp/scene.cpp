#include "cpp/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

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

/// A .glb file: its JSON, its bytes, and the offset of its buffer in them.
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
            throw std::runtime_error{"the mesh file's indices have an unknown type"};
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

/// The objects of a mesh file with positions, indices and no transforms.
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

Camera read_camera(const Json& camera)
{
    Camera read{vector_of(camera.at("eye")), vector_of(camera.at("target")),
                vector_of(camera.at("up")), std::nullopt, std::nullopt};
    if (camera.contains("orthographic_height")) {
        read.orthographic_height = camera.at("orthographic_height").get<double>();
    } else {
        read.vertical_fov_deg = camera.at("vertical_fov_deg").get<double>();
    }
    return read;
}

Light read_light(const Json& light)
{
    const auto type = light.at("type").get<std::string>();
    if (type == "directional") {
        return {LightType::directional, {}, normalized(vector_of(light.at("direction"))), 0};
    }
    const Vector3 position = vector_of(light.at("position"));
    if (type == "point") {
        return {LightType::point, position, {}, 0};
    }
    if (type != "spot") {
        throw std::runtime_error{"unknown type of light \"" + type + "\""};
    }
    return {LightType::spot, position, normalized(vector_of(light.at("target")) - position),
            light.at("cone_deg").get<double>()};
}

bool names(const Json& mesh, const char* list, const std::string& name)
{
    const auto found = mesh.find(list);
    return found != mesh.end() && std::ranges::find(*found, Json(name)) != found->end();
}

} // namespace

Vector3 vector_of(const Json& numbers)
{
    return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

Vector3 operator+(const Vector3& a, const Vector3& b)
{
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector3 operator-(const Vector3& a, const Vector3& b)
{
    return a + -1 * b;
}
Vector3 operator*(double k, const Vector3& a)
{
    return {k * a[0], k * a[1], k * a[2]};
}
double dot(const Vector3& a, const Vector3& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector3 cross(const Vector3& a, const Vector3& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vector3& a)
{
    return std::sqrt(dot(a, a));
}
Vector3 normalized(const Vector3& a)
{
    return 1 / length(a) * a;
}

Scene read_scene(const Json& open)
{
    const Json& mesh = open.at("mesh");
    Scene scene;
    for (GlbObject& shape : read_glb(mesh.at("file").get<std::string>())) {
        const bool casts = !names(mesh, "no_cast", shape.name);
        const bool is_seen = !names(mesh, "no_receive", shape.name);
        scene.objects.push_back({std::move(shape), casts, is_seen});
    }
    scene.camera = read_camera(open.at("camera"));
    scene.light = read_light(open.at("light"));
    scene.width = open.at("image").at("width").get<int>();
    scene.height = open.at("image").at("height").get<int>();
    return scene;
}

std::array<Vector3, 2> bounds(const Scene& scene)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<Vector3, 2> box{Vector3{infinity, infinity, infinity},
                               Vector3{-infinity, -infinity, -infinity}};
    for (const SceneObject& object : scene.objects) {
        const std::vector<float>& corners = object.shape.corners;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            box[0][i % 3] = std::min<double>(box[0][i % 3], corners[i]);
            box[1][i % 3] = std::max<double>(box[1][i % 3], corners[i]);
        }
    }
    return box;
}

Planes camera_planes(const Scene& scene)
{
    const auto [low, high] = bounds(scene);
    const double diagonal = length(high - low);
    Vector3 outside{};
    for (std::size_t k = 0; k < 3; ++k) {
        outside[k] = std::max({low[k] - scene.camera.eye[k], scene.camera.eye[k] - high[k], 0.0});
    }
    const double far = (length(outside) + diagonal) * 1.01;
    return {scene.camera.orthographic_height ? -far : diagonal * 1e-3, far};
}

} // namespace engine
