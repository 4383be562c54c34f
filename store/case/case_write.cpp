#include "store/case/case_files.hpp"

#include "methods/job_method.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/toml.hpp"
#include "scene/text.hpp"
#include "store/exr/aov.hpp"
#include "store/exr/header.hpp"
#include "store/images/exr.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace gnomon::store {

namespace {

constexpr std::string_view case_file = "case.toml";
constexpr std::string_view mesh_file = "mesh.glb";
constexpr std::string_view image_file = "aov.exr";
constexpr std::string_view map_file = "map.exr";

using scene::LookupSample;
using scene::PixelClass;

/// A case leaves out pixels where GL shows another surface than the exact one.
bool is_judged(PixelClass pixel_class)
{
    return pixel_class != PixelClass::background && pixel_class != PixelClass::unmatched;
}

std::uint32_t float_bits(float value)
{
    return std::bit_cast<std::uint32_t>(value);
}

/// The channels of an image. They refer to their values, which must outlive them.
class CaseChannels {
public:
    template <typename Value>
    void add(std::string name, const Value& value)
    {
        channels_.push_back({std::move(name), ChannelType::float32,
                             [value](std::size_t i) { return float_bits(value(i)); }});
    }
    template <typename Value>
    void add_integer(std::string name, const Value& value)
    {
        channels_.push_back({std::move(name), ChannelType::uint32, value});
    }
    template <typename Vector>
    void add_vector(const std::string& name, const scene::Image<Vector>& image)
    {
        constexpr std::array<std::string_view, 3> endings{".X", ".Y", ".Z"};
        for (int k = 0; k < Vector::length(); ++k) {
            add(fmt::format("{}{}", name, endings[static_cast<std::size_t>(k)]),
                [&image, k](std::size_t i) { return image[i][k]; });
        }
    }
    void add_terms(const scene::LookupTerms& terms)
    {
        constexpr std::array<std::string_view, 4> names{"moved.X", "moved.Y", "moved.Z",
                                                        "moved.depth"};
        for (int k = 0; k < scene::Vec4f::length(); ++k) {
            add(std::string{names[static_cast<std::size_t>(k)]},
                [&moved = terms.moved, k](std::size_t i) { return moved[i][k]; });
        }
        if (!terms.gradients.empty()) {
            add_vector("tap_gradient", terms.gradients);
        }
    }
    void add_samples(const std::string& prefix, const scene::LookupLayers& lookup)
    {
        const auto& samples = lookup.samples;
        add(prefix + "z.light", [&samples](std::size_t i) { return samples[i].receiver_depth; });
        add(prefix + "z.map", [&samples](std::size_t i) { return samples[i].map_depth; });
        add_vector(prefix + "texel", lookup.texels);
        if (!lookup.kernel_axes.empty()) {
            add_vector(prefix + "kernel_axis", lookup.kernel_axes);
        }
        if (const auto& maps = lookup.maps; !maps.empty()) {
            add_integer(prefix + "map_index",
                        [&maps](std::size_t i) -> std::uint32_t { return maps[i]; });
        }
    }

    [[nodiscard]] const std::vector<ExrChannel>& all() const { return channels_; }

private:
    std::vector<ExrChannel> channels_;
};

scene::Image<scene::Vec3f> seen_normals(const analysis::Comparison& comparison)
{
    const auto& triangles = comparison.receivers.triangle;
    scene::Image<scene::Vec3f> normals{triangles.size()};
    for (int y = 0; y < triangles.size().height_px; ++y) {
        for (int x = 0; x < triangles.size().width_px; ++x) {
            if (triangles(x, y) != scene::no_triangle) {
                normals(x, y) = scene::Vec3f{facing_normal(comparison, x, y)};
            }
        }
    }
    return normals;
}

std::vector<std::byte> case_image(const analysis::Comparison& comparison, const CaseExtras& extras)
{
    const auto& classes = comparison.truth.pixel_class;
    const auto& samples = comparison.lookup.samples;
    const auto normals = seen_normals(comparison);
    CaseChannels channels;
    channels.add("shadow.V", [&](std::size_t i) { return samples[i].verdict; });
    channels.add("valid", [&](std::size_t i) { return is_judged(classes[i]) ? 1.0F : 0.0F; });
    channels.add_vector("P", extras.points);
    channels.add_vector("Ng", normals);
    channels.add_integer("id.geom", [&](std::size_t i) {
        const std::uint32_t triangle = comparison.receivers.triangle[i];
        return triangle == scene::no_triangle
                   ? std::numeric_limits<std::uint32_t>::max()
                   : static_cast<std::uint32_t>(comparison.triangles->object_of(triangle));
    });
    channels.add_samples("", comparison.lookup);
    channels.add("tan_theta", [&](std::size_t i) { return samples[i].tan_theta; });
    if (comparison.diagnosis && comparison.diagnosis->terms) {
        channels.add_terms(*comparison.diagnosis->terms);
    }
    if (!extras.unmoved.samples.empty()) {
        const auto& unmoved = extras.unmoved.samples;
        channels.add("unmoved.V", [&](std::size_t i) { return unmoved[i].verdict; });
        channels.add_samples("unmoved.", extras.unmoved);
    }
    return encode_exr(classes.size(), channels.all(), exr_header(comparison));
}

std::string name_list(const scene::TriangleScene& scene, bool scene::Object::*role)
{
    std::string text;
    for (const scene::Object& object : scene.objects) {
        if (!(object.*role)) {
            text += fmt::format("{}{}", text.empty() ? "" : ", ", scene::toml_quoted(object.name));
        }
    }
    return text;
}

/// The job's tables for `case.toml`. It holds the method only if that determines which texels make
/// up a verdict.
std::string job_tables(scene::Job job, const CaseExtras& extras)
{
    job.camera = extras.camera;
    job.light = extras.light;
    const methods::LookupTraits promised = methods::traits(job);
    const bool says_method = promised.is_made_of_taps() && promised.scatters_taps();
    std::string text;
    std::string last_table;
    for (const auto& [key, value] : scene::resolved_keys(job)) {
        const std::size_t dot = key.find('.');
        const std::string table = key.substr(0, dot);
        if (table == "scene" || table == "image" || (table == "method" && !says_method)) {
            continue;
        }
        if (table != last_table) {
            text += fmt::format("\n[{}]\n", table);
            last_table = table;
        }
        text += fmt::format("{} = {}\n", key.substr(dot + 1), value);
    }
    return text;
}

std::string case_toml(const analysis::Comparison& comparison, const CaseExtras& extras)
{
    const scene::TriangleScene& scene = *comparison.triangles;
    const std::string& renderer = comparison.environment.gl_renderer;
    std::string text = "schema = 1\n";
    text += fmt::format("name = {}\n", scene::toml_quoted(comparison.scene.name));
    text +=
        fmt::format("renderer = {}\n", scene::toml_quoted(renderer.empty() ? "unknown" : renderer));
    text += fmt::format("\n[mesh]\nfile = \"{}\"\n", mesh_file);
    text += fmt::format("no_cast = [{}]\n", name_list(scene, &scene::Object::casts));
    text += fmt::format("no_receive = [{}]\n", name_list(scene, &scene::Object::receives));
    text += job_tables(comparison.job, extras);
    if (!scene::has_filters(comparison.job)) {
        text += "\n[channels]\nfractions = true\n";
    }
    if (!extras.map_depths.empty()) {
        text += fmt::format("\n[map]\nfile = \"{}\"\n", map_file);
    }
    text += "\n[objects]\n";
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        text += fmt::format("{} = {}\n", scene::toml_quoted(scene.objects[i].name), i);
    }
    return text;
}

} // namespace

std::span<const std::string_view> case_files()
{
    static constexpr std::array files{case_file, mesh_file, image_file, map_file};
    return files;
}

void write_case(const std::filesystem::path& folder, const analysis::Comparison& comparison,
                const CaseExtras& extras)
{
    if (extras.points.size() != comparison.truth.pixel_class.size()) {
        throw std::invalid_argument("write_case: extras.points: not of the image's size");
    }
    if (std::ranges::none_of(comparison.truth.pixel_class, is_judged)) {
        throw scene::InputError(fmt::format(
            "{}: no case is written, because no pixel of the image can be judged: point "
            "the camera at the scene",
            scene::one_line(folder.string())));
    }
    make_folder(folder);
    write_file(folder / mesh_file, encode_glb(*comparison.triangles));
    write_file(folder / image_file, case_image(comparison, extras));
    if (!extras.map_depths.empty()) {
        const auto& depths = extras.map_depths;
        CaseChannels channels;
        channels.add("map.d", [&depths](std::size_t i) { return depths[i]; });
        write_file(folder / map_file, encode_exr(depths.size(), channels.all(), {}));
    }
    // Last, so that a case with case.toml is complete.
    write_file(folder / case_file, case_toml(comparison, extras));
}

} // namespace gnomon::store
