#include "scene/import/load_scene_file.hpp"

#include "scene/error.hpp"
#include "scene/import/assimp.hpp"
#include "scene/import/names.hpp"
#include "scene/import/process.hpp"
#include "scene/import/stream.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {
namespace {

constexpr std::size_t longest_message = 300;
constexpr double max_m = max_coordinate_m;

bool has_known_extension(const std::filesystem::path& path)
{
    const std::string extension = lower_extension(path);
    constexpr std::array<std::string_view, 4> known{".gltf", ".glb", ".obj", ".ply"};
    return std::find(known.begin(), known.end(), extension) != known.end();
}

void check_readable(const std::filesystem::path& path)
{
    const std::string label = path.string();
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) {
        throw InputError{label + ": there is no such file; check the path"};
    }
    if (error) {
        throw InputError{
            fmt::format("{}: cannot be reached ({}); check the path", label, error.message())};
    }
    if (std::filesystem::is_directory(status)) {
        throw InputError{label + ": is a folder; name a .gltf, .glb, .obj or .ply file in it"};
    }
    if (!has_known_extension(path)) {
        throw InputError{label + ": unknown kind of file; convert it to .gltf, .glb, .obj or .ply"};
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw InputError{label + ": is not a regular file; copy its contents to one"};
    }
    if (::access(path.c_str(), R_OK) != 0) {
        throw InputError{fmt::format("{}: cannot be read ({}); check its permissions", label,
                                     std::strerror(errno))};
    }
    if (std::filesystem::file_size(path, error) == 0 && !error) {
        throw InputError{label + ": is empty; export it again"};
    }
}

bool is_usable_direction(const Vec3d& v)
{
    const double length = glm::length(v);
    return std::isfinite(length) && length > 0;
}

bool is_usable_point(const Vec3d& p)
{
    // NaN compares false.
    return std::abs(p.x) <= max_m && std::abs(p.y) <= max_m && std::abs(p.z) <= max_m;
}

std::optional<CameraSettings> camera_settings(ImportedCamera camera, const FileSpace& space)
{
    camera.eye = space.point(camera.eye);
    camera.forward = space.direction(camera.forward);
    camera.up = space.direction(camera.up);
    camera.orthographic_height_m *= space.scale;
    if (!is_usable_point(camera.eye) || !is_usable_direction(camera.forward) ||
        !is_usable_direction(camera.up)) {
        return std::nullopt;
    }
    CameraSettings settings;
    // The exact camera has a float32 eye. Rounding it here keeps the view direction.
    settings.eye = rounded_to_float32(camera.eye);
    settings.target = settings.eye + glm::normalize(camera.forward);
    settings.up = glm::normalize(camera.up);
    if (camera.vertical_fov_rad > 0 && camera.vertical_fov_rad < glm::radians(180.0)) {
        settings.vertical_fov_deg = glm::degrees(camera.vertical_fov_rad);
        return settings;
    }
    settings.projection = Projection::orthographic;
    settings.orthographic_height_m = camera.orthographic_height_m;
    const bool is_orthographic = camera.vertical_fov_rad == 0 &&
                                 settings.orthographic_height_m > 0 &&
                                 settings.orthographic_height_m <= max_m;
    return is_orthographic ? std::optional{settings} : std::nullopt;
}

std::optional<LightSettings> light_settings(ImportedLight light, const FileSpace& space)
{
    light.position = space.point(light.position);
    light.direction = space.direction(light.direction);
    LightSettings settings;
    if (light.is_point != 0) {
        settings.type = LightType::point;
        settings.position = rounded_to_float32(light.position);
        return is_usable_point(light.position) ? std::optional{settings} : std::nullopt;
    }
    if (!is_usable_direction(light.direction)) {
        return std::nullopt;
    }
    const Vec3d direction = glm::normalize(light.direction);
    if (light.outer_cone_rad == 0) {
        settings.direction = direction;
        return settings;
    }
    const double cone_deg = 2 * glm::degrees(light.outer_cone_rad);
    if (!is_usable_point(light.position) || !(cone_deg > 0 && cone_deg < 180)) {
        return std::nullopt;
    }
    settings.type = LightType::spot;
    settings.cone_deg = cone_deg;
    settings.position = rounded_to_float32(light.position);
    // The axis is the difference of two float32 points; a near target would round it coarsely.
    const double distance_m = std::max(1.0, glm::length(light.position));
    settings.target = *settings.position + distance_m * direction;
    return settings;
}

std::string refusal(const std::string& label, std::string_view reason,
                    std::string_view remedy = "; export it again")
{
    if (reason.starts_with("No suitable reader")) {
        reason = "it is not what its name says, or its first lines are damaged";
    }
    std::string text = printable(reason.substr(0, longest_message));
    if (text.ends_with('.')) {
        text.pop_back();
    }
    return fmt::format("{}: cannot be imported: {}{}", label, text, remedy);
}

/// @throws InputError  with the child's own reason, if it refused the file.
const ImportHeader& checked_header(ImportReader& reader, const std::string& label)
{
    const auto& header = reader.take<ImportHeader>();
    if (header.magic == import_magic && header.outcome == ImportOutcome::refusal) {
        throw InputError{refusal(label, reader.take_text(reader.bytes_left()))};
    }
    if (header.magic == import_magic && header.outcome == ImportOutcome::unsupported) {
        throw InputError{refusal(label, reader.take_text(reader.bytes_left()), "")};
    }
    if (header.magic != import_magic || header.outcome != ImportOutcome::scene) {
        throw CorruptStream{};
    }
    return header;
}

FileContents file_contents(const ImportHeader& header, ImportReader& reader)
{
    FileContents contents{header.contents, {}};
    std::string_view names = reader.take_text(header.extension_bytes);
    while (!names.empty()) {
        const std::size_t end = std::min(names.find('\n'), names.size() - 1);
        contents.unread_extensions.push_back(printable(names.substr(0, end)));
        names.remove_prefix(end + 1);
    }
    return contents;
}

/// Reads the lights; the first one, if usable, becomes the default.
void read_lights(SceneFile& file, std::uint64_t light_count, ImportReader& reader,
                 const FileSpace& space)
{
    for (std::uint64_t i = 0; i < light_count; ++i) {
        const auto& light = reader.take<ImportedLight>();
        std::string name = printable(reader.take_text(light.name_bytes));
        const auto settings = light_settings(light, space);
        if (i == 0) {
            file.defaults.light = settings;
        }
        if (settings) {
            file.lights.push_back({std::move(name), *settings});
        }
    }
}

/// Adds one object of the stream, converted to the scene's space.
/// @throws InputError  as `SceneBuilder::add` does.
void add_object(SceneBuilder& builder, const std::string& name, std::span<const Vec3d> vertices,
                std::span<const TriangleIndices> triangles,
                std::span<const TriangleAttributes> attributes, const FileSpace& space)
{
    if (space.is_of_file()) {
        builder.add(name, vertices, triangles, attributes);
        return;
    }
    std::vector<Vec3d> moved(vertices.size());
    std::ranges::transform(vertices, moved.begin(), [&](const Vec3d& v) { return space.point(v); });
    std::vector<TriangleAttributes> turned{attributes.begin(), attributes.end()};
    for (TriangleAttributes& corners : turned) {
        for (CornerAttributes& corner : corners) {
            // Only permutes and negates components: exact.
            corner.normal = Vec3f{space.direction(Vec3d{corner.normal})};
        }
    }
    builder.add(name, moved, triangles, turned);
}

/// Decodes the child's bytes into a scene. Checks every length: the bytes are not trusted.
/// @param label  the file's name, for messages; its stem names objects without a name.
SceneFile decoded_scene(const std::string& label, std::span<const std::byte> bytes,
                        const ImportLimits& limits, const FileSpace& space)
{
    ImportReader reader{bytes};
    const ImportHeader& header = checked_header(reader, label);
    SceneFile file;
    SceneBuilder builder;
    builder.count_ignored_primitives(header.ignored_primitives);
    builder.keep_contents(file_contents(header, reader));
    read_lights(file, header.light_count, reader, space);
    UniqueNames names;
    const std::string fallback = printable(std::filesystem::path{label}.stem().string());
    std::uint64_t triangle_count = 0;
    for (std::uint64_t i = 0; i < header.object_count; ++i) {
        const auto& object = reader.take<ImportedObject>();
        const std::string given = printable(reader.take_text(object.name_bytes));
        const std::string name = names.make(given.empty() ? fallback : given);
        const auto vertices = reader.take_array<Vec3d>(object.vertex_count);
        const auto triangles = reader.take_array<TriangleIndices>(object.triangle_count);
        const auto attributes = reader.take_array<TriangleAttributes>(object.normal_count / 3);
        triangle_count += triangles.size();
        if (triangle_count > limits.triangles ||
            (object.normal_count != 0 && object.normal_count != 3 * triangles.size())) {
            throw CorruptStream{};
        }
        try {
            add_object(builder, name, vertices, triangles, attributes, space);
        } catch (const InputError& error) {
            throw InputError{label + ": " + error.what()};
        }
    }
    file.scene = builder.take();
    file.defaults.camera =
        header.has_camera != 0 ? camera_settings(header.camera, space) : std::nullopt;
    return file;
}

} // namespace

SealedBytes pack_scene_file(const std::filesystem::path& path, const ImportLimits& limits,
                            VertexNormals normals)
{
    check_readable(path);
    const auto folder = std::filesystem::canonical(std::filesystem::absolute(path).parent_path());
    const auto scene_file = folder / path.filename();
    return run_in_child(path.string(), limits, [&](int output, ImportAllowance& allowance) {
        write_imported_scene(scene_file, limits, normals, allowance, output);
    });
}

SceneFile unpack_scene_file(const std::filesystem::path& path, std::span<const std::byte> packed,
                            const ImportLimits& limits, const FileSpace& space)
{
    const std::string label = path.string();
    try {
        SceneFile file = decoded_scene(label, packed, limits, space);
        if (file.scene.triangles.empty()) {
            throw InputError{fmt::format("{}: has no triangle that casts a shadow ({} of zero "
                                         "area, {} points and lines); name a file with a mesh",
                                         label, file.scene.dropped_triangles,
                                         file.scene.ignored_primitives)};
        }
        return file;
    } catch (const CorruptStream& error) {
        throw InputError{refusal(label, error.what())};
    }
}

SceneFile load_scene_file(const std::filesystem::path& path, const ImportLimits& limits,
                          VertexNormals normals, const FileSpace& space)
{
    return unpack_scene_file(path, pack_scene_file(path, limits, normals).bytes(), limits, space);
}

} // namespace gnomon::scene
