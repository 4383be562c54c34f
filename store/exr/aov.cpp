#include "store/exr/aov.hpp"

#include "methods/job_method.hpp"
#include "scene/camera/camera.hpp"
#include "scene/error.hpp"
#include "scene/geometry/vertex_normals.hpp"
#include "store/exr/header.hpp"
#include "store/images/exr.hpp"
#include "store/images/layer_file.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace gnomon::store {

namespace {

using scene::Vec3d;

constexpr float not_a_bias = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t no_map = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t no_object = std::numeric_limits<std::uint32_t>::max();

std::uint32_t bits(float value)
{
    return std::bit_cast<std::uint32_t>(value);
}

float truth_code(const scene::Truth& truth, std::size_t pixel)
{
    return scene::is_scored(truth.pixel_class[pixel]) ? truth.share(pixel).middle() : -1.0F;
}

/// The surface that the camera sees at each pixel.
struct Surface {
    scene::Image<scene::Vec3f> normal; ///< NaN for background
    /// Interpolated from the vertices, NaN for background; empty if no lookup reads it.
    scene::Image<scene::Vec3f> vertex_normal;
    scene::Image<std::uint32_t> object; ///< `no_object` for background
};

bool reads_vertex_normals(const analysis::Comparison& comparison)
{
    return methods::vertex_normals(comparison.job) == scene::VertexNormals::kept;
}

/// @param lights  at least one; all share the camera.
Surface seen_surface(std::span<const analysis::Comparison> lights,
                     const scene::Image<scene::Vec3f>& points)
{
    constexpr float none = std::numeric_limits<float>::quiet_NaN();
    const analysis::Comparison& comparison = lights.front();
    const bool has_vertex_normals = std::ranges::any_of(lights, reads_vertex_normals);
    const scene::Image<std::uint32_t>& triangle = comparison.receivers.triangle;
    const scene::ImageSize size = triangle.size();
    const scene::Image<scene::Vec3f> no_normals{size, {none, none, none}};
    Surface surface{no_normals, has_vertex_normals ? no_normals : scene::Image<scene::Vec3f>{},
                    scene::Image<std::uint32_t>{size, no_object}};
    for (int y = 0; y < size.height_px; ++y) {
        for (int x = 0; x < size.width_px; ++x) {
            if (triangle(x, y) < comparison.triangles->triangles.size()) {
                surface.normal(x, y) = scene::Vec3f{facing_normal(comparison, x, y)};
                if (has_vertex_normals) {
                    surface.vertex_normal(x, y) = scene::Vec3f{
                        facing_vertex_normal(comparison, x, y, scene::Vec3d{points(x, y)})};
                }
                surface.object(x, y) =
                    static_cast<std::uint32_t>(comparison.triangles->object_of(triangle(x, y)));
            }
        }
    }
    return surface;
}

void add_vector(std::vector<ExrChannel>& channels, const std::string& name,
                const scene::Image<scene::Vec3f>& vectors)
{
    using enum ChannelType;
    channels.push_back({name + ".X", float32, [&](std::size_t i) { return bits(vectors[i].x); }});
    channels.push_back({name + ".Y", float32, [&](std::size_t i) { return bits(vectors[i].y); }});
    channels.push_back({name + ".Z", float32, [&](std::size_t i) { return bits(vectors[i].z); }});
}

void add_surface(std::vector<ExrChannel>& channels, const Surface& surface)
{
    using enum ChannelType;
    add_vector(channels, "N", surface.normal);
    if (!surface.vertex_normal.empty()) {
        add_vector(channels, "Ns", surface.vertex_normal);
    }
    channels.push_back({"object", uint32, [&](std::size_t i) { return surface.object[i]; }});
}

void add_images(std::vector<ExrChannel>& channels,
                std::initializer_list<std::pair<const char*, const scene::Image<float>*>> images)
{
    for (const auto& [name, image] : images) {
        channels.push_back({name, ChannelType::float32,
                            [image = image](std::size_t i) { return bits((*image)[i]); }});
    }
}

void add_terms(std::vector<ExrChannel>& channels, const scene::LookupTerms& terms)
{
    using enum ChannelType;
    const auto& moved = terms.moved;
    channels.push_back({"moved.X", float32, [&](std::size_t i) { return bits(moved[i].x); }});
    channels.push_back({"moved.Y", float32, [&](std::size_t i) { return bits(moved[i].y); }});
    channels.push_back({"moved.Z", float32, [&](std::size_t i) { return bits(moved[i].z); }});
    channels.push_back({"moved.depth", float32, [&](std::size_t i) { return bits(moved[i].w); }});
    const auto& gradients = terms.gradients;
    if (!gradients.empty()) {
        channels.push_back(
            {"tap_gradient.X", float32, [&](std::size_t i) { return bits(gradients[i].x); }});
        channels.push_back(
            {"tap_gradient.Y", float32, [&](std::size_t i) { return bits(gradients[i].y); }});
    }
}

void add_diagnosis(std::vector<ExrChannel>& channels, const analysis::Diagnosis& diagnosis,
                   const scene::Image<scene::PixelClass>& classes)
{
    using enum ChannelType;
    add_images(channels, {{"light_distance_m", &diagnosis.light_distance_m},
                          {"map_error_m", &diagnosis.map_error_m}});
    if (diagnosis.biases) {
        const scene::Image<float>& critical = diagnosis.biases->critical_bias;
        channels.push_back({"critical_bias", float32, [&](std::size_t i) {
                                return bits(is_scored(classes[i]) ? critical[i] : not_a_bias);
                            }});
        const analysis::BiasMap& map = diagnosis.biases->map;
        add_images(channels, {{"needed_bias_m", &map.metres},
                              {"needed_bias_texels", &map.texels},
                              {"needed_bias_steps", &map.steps}});
    }
    if (diagnosis.terms) {
        add_terms(channels, *diagnosis.terms);
    }
    const analysis::CauseLayers& causes = diagnosis.causes;
    channels.push_back({"cause", uint32, [&](std::size_t i) {
                            return static_cast<std::uint32_t>(causes.cause[i]);
                        }});
    channels.push_back({"label", uint32, [&](std::size_t i) {
                            return static_cast<std::uint32_t>(causes.label[i]);
                        }});
}

std::vector<ExrChannel> channels(const analysis::Comparison& comparison,
                                 const scene::Image<scene::Vec3f>& points, const Surface& surface)
{
    using enum ChannelType;
    const auto& classes = comparison.truth.pixel_class;
    const auto& witness = comparison.truth.witness;
    const auto& triangle = comparison.receivers.triangle;
    const auto& samples = comparison.lookup.samples;
    std::vector<ExrChannel> channels{
        {"truth", float32, [&](std::size_t i) { return bits(truth_code(comparison.truth, i)); }},
        {"class", uint32, [&](std::size_t i) { return static_cast<std::uint32_t>(classes[i]); }},
        {"verdict", float32, [&](std::size_t i) { return bits(samples[i].verdict); }},
        {"prim", uint32, [&](std::size_t i) { return triangle[i]; }},
        {"P.X", float32, [&](std::size_t i) { return bits(points[i].x); }},
        {"P.Y", float32, [&](std::size_t i) { return bits(points[i].y); }},
        {"P.Z", float32, [&](std::size_t i) { return bits(points[i].z); }},
        {"witness", uint32, [&](std::size_t i) { return witness[i]; }},
        {"receiver_depth", float32, [&](std::size_t i) { return bits(samples[i].receiver_depth); }},
        {"map_depth", float32, [&](std::size_t i) { return bits(samples[i].map_depth); }},
        {"tan_theta", float32, [&](std::size_t i) { return bits(samples[i].tan_theta); }},
    };
    const auto& texels = comparison.lookup.texels;
    if (!texels.empty()) { // absent for another renderer's mask
        channels.push_back({"texel.X", float32, [&](std::size_t i) { return bits(texels[i].x); }});
        channels.push_back({"texel.Y", float32, [&](std::size_t i) { return bits(texels[i].y); }});
    }
    const scene::MapIndices& maps = comparison.lookup.maps;
    if (!maps.empty()) { // the light has several maps
        channels.push_back({"map_index", uint32, [&](std::size_t i) {
                                return is_scored(classes[i]) ? std::uint32_t{maps[i]} : no_map;
                            }});
    }
    add_surface(channels, surface);
    if (comparison.diagnosis) {
        add_diagnosis(channels, *comparison.diagnosis, classes);
    }
    return channels;
}

void require_size(const analysis::Comparison& comparison, const scene::Image<scene::Vec3f>& points)
{
    const scene::ImageSize size = comparison.truth.pixel_class.size();
    if (points.size() != size) {
        throw std::invalid_argument(fmt::format(
            "write_aov: points are {}x{} but the image is {}x{}", points.size().width_px,
            points.size().height_px, size.width_px, size.height_px));
    }
}

/// Adds the texts of one light under their names without its prefix.
std::map<std::string, std::string> texts_of(const std::map<std::string, std::string>& texts,
                                            const std::string& prefix)
{
    std::map<std::string, std::string> of_light = texts;
    for (const auto& [name, text] : texts) {
        if (!prefix.empty() && name.starts_with(prefix)) {
            of_light.insert_or_assign(name.substr(prefix.size()), text);
        }
    }
    return of_light;
}

scene::Image<scene::Vec3f> positions(LayerFile& file, const std::string& prefix)
{
    const auto x = file.floats(prefix + "P.X");
    const auto y = file.floats(prefix + "P.Y");
    const auto z = file.floats(prefix + "P.Z");
    scene::Image<scene::Vec3f> points{x.size()};
    for (std::size_t i = 0; i < points.pixel_count(); ++i) {
        points[i] = {x[i], y[i], z[i]};
    }
    return points;
}

} // namespace

Vec3d facing_normal(const analysis::Comparison& comparison, int x, int y)
{
    if (comparison.evaluation) {
        return Vec3d{comparison.evaluation->normal(x, y)};
    }
    const auto [a, b, c] = comparison.triangles->corners(comparison.receivers.triangle(x, y));
    const Vec3d origin{a};
    const Vec3d across = glm::cross(Vec3d{b} - origin, Vec3d{c} - origin);
    const double twice_area = glm::length(across);
    const Vec3d normal = twice_area > 0 ? across / twice_area : Vec3d{0, 1, 0};
    const scene::Ray ray = scene::pixel_ray(comparison.view.camera, comparison.view.image, x, y);
    return glm::dot(normal, ray.direction) > 0 ? -normal : normal;
}

Vec3d facing_vertex_normal(const analysis::Comparison& comparison, int x, int y, const Vec3d& point)
{
    const std::uint32_t triangle = comparison.receivers.triangle(x, y);
    const Vec3d normal = scene::vertex_normal_at(*comparison.triangles, triangle, point);
    const double side = glm::dot(normal, facing_normal(comparison, x, y));
    return side < 0 ? -normal : normal;
}

void write_aov(const std::filesystem::path& path, const analysis::Comparison& comparison,
               const scene::Image<scene::Vec3f>& points)
{
    require_size(comparison, points);
    const Surface surface = seen_surface({&comparison, 1}, points);
    write_file(path, encode_exr(points.size(), channels(comparison, points, surface),
                                exr_header(comparison)));
}

void write_aov(const std::filesystem::path& path, std::span<const analysis::Comparison> lights,
               const scene::Image<scene::Vec3f>& points)
{
    for (const analysis::Comparison& light : lights) {
        require_size(light, points);
    }
    const Surface surface = seen_surface(lights, points);
    std::vector<ExrChannel> all;
    for (const analysis::Comparison& light : lights) {
        for (ExrChannel& channel : channels(light, points, surface)) {
            channel.name = fmt::format("{}.{}", light.light, channel.name);
            all.push_back(std::move(channel));
        }
    }
    write_file(path, encode_exr(points.size(), all, exr_header(lights)));
}

Aov read_aov(const std::filesystem::path& path, scene::ImageSize image, const std::string& light)
{
    LayerFile file{path, "write it again with `gnomon compare JOB --aov FILE.exr`"};
    const scene::ImageSize size = file.size();
    if (size != image) {
        throw scene::InputError(fmt::format(
            "{}: the image is {}x{} pixels but the job's is {}x{}: give the job that it was made "
            "from",
            path.string(), size.width_px, size.height_px, image.width_px, image.height_px));
    }
    const std::string prefix =
        light.empty() || file.has("class") ? std::string{} : fmt::format("{}.", light);
    Aov aov;
    aov.texts = texts_of(file.texts(), prefix);
    aov.pixel_class = file.classes(prefix + "class");
    aov.truth = file.floats(prefix + "truth");
    aov.prim = file.integers(prefix + "prim");
    aov.witness = file.integers(prefix + "witness");
    aov.position = positions(file, prefix);
    return aov;
}

} // namespace gnomon::store
