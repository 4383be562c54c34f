#include "method_case.hpp"

#include "lane.hpp"
#include "methods/job_method.hpp"
#include "methods/key_table.hpp"
#include "methods/list.hpp"
#include "methods_job.hpp"
#include "raster_gl/map/depth_peeling.hpp"
#include "raster_gl/map/multisampled_depth.hpp"
#include "raster_gl/readback.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace gnomon::tests {
namespace {

/// Adds vertex normals if the job needs them.
scene::SceneFile completed(const scene::Job& job, scene::SceneFile file)
{
    if (methods::vertex_normals(job) == scene::VertexNormals::kept) {
        scene::complete_vertex_normals(file.scene);
    }
    return file;
}

} // namespace

/// A case borrows its passes from a pool, because most cases need the same compiled programs.
struct MethodCase::Passes {
    raster_gl::ReceiverPass receivers{*shared_context()};
    raster_gl::ShadowMapPass map{*shared_context()};
    raster_gl::MultisampledDepth multisampled_depth{*shared_context()};
    raster_gl::DepthPeeling depth_peeling{*shared_context()};
    raster_gl::PrefilterPass prefilter{*shared_context()};
    raster_gl::LookupPass lookup{*shared_context()};

    /// The pool. It is made after the context, and so destroyed before it.
    static std::vector<std::unique_ptr<Passes>>& idle()
    {
        shared_context();
        static std::vector<std::unique_ptr<Passes>> passes;
        return passes;
    }
};

std::unique_ptr<MethodCase::Passes, MethodCase::GiveBack> MethodCase::take_passes()
{
    auto& idle = Passes::idle();
    if (idle.empty()) {
        idle.push_back(std::make_unique<Passes>());
    }
    std::unique_ptr<Passes, GiveBack> taken{idle.back().release()};
    idle.pop_back();
    return taken;
}

void MethodCase::GiveBack::operator()(Passes* passes) const
{
    Passes::idle().emplace_back(passes);
}

MethodCase::MethodCase(scene::Job the_job, scene::SceneFile the_file)
    : job{std::move(the_job)},
      file{completed(job, std::move(the_file))},
      view{resolve_view(job, file.scene, file.defaults)},
      gpu_{*shared_context(), file.scene},
      passes_{take_passes()}
{
    receivers_ = &passes_->receivers.render(gpu_, view, file.scene.bounds());
}

MethodCase::MethodCase(const std::string& builtin, const std::vector<scene::Override>& keys)
    : MethodCase{job_of_builtin(builtin, keys),
                 scene::load_scene(job_of_builtin(builtin, keys).scene)}
{
}

void MethodCase::set(scene::Job other)
{
    job = std::move(other);
    view = resolve_view(job, file.scene, file.defaults);
    receivers_ = &passes_->receivers.render(gpu_, view, file.scene.bounds());
    map_ = nullptr;
}

void MethodCase::draw_map()
{
    if (!methods::traits(job).has_map) {
        return;
    }
    using raster_gl::Primitives;
    map_ = &passes_->map.render(gpu_, view.maps, job.shadow_map,
                                methods::passes(job).draws_primitives ? Primitives::kept
                                                                      : Primitives::dropped,
                                methods::map_offset(job, view));
    if (methods::passes(job).layers > 1) {
        prefilter({passes_->depth_peeling.render(gpu_, view.maps, job.shadow_map), true});
        return;
    }
    const int samples = methods::passes(job).samples;
    prefilter(samples == 1
                  ? raster_gl::SampledDepths{}
                  : raster_gl::SampledDepths{passes_->multisampled_depth.render(
                        gpu_, view.maps, job.shadow_map, samples, methods::map_offset(job, view))});
}

void MethodCase::give_map(scene::Image<float> depths)
{
    give_samples({static_cast<std::size_t>(methods::passes(job).depths_of_texel()), depths});
}

void MethodCase::give_samples(std::vector<scene::Image<float>> of_samples)
{
    scene::Image<float> first = of_samples.front();
    const raster_gl::Texture samples = raster_gl::upload_layers(of_samples);
    map_ = &passes_->map.store(std::move(first), view.first_map().reversed);
    prefilter({{&samples, 1}, true});
}

void MethodCase::prefilter(const raster_gl::SampledDepths& samples)
{
    filtered_ = &passes_->prefilter.render(*map_, methods::passes(job),
                                           renderers::FilteredContent::of_method, samples);
}

raster_gl::LookupSource MethodCase::looked_up() const
{
    return {gpu_, *receivers_, *map_, filtered_};
}

scene::LookupLayers MethodCase::look_up(float constant_bias)
{
    if (const auto volumes = methods::passes(job).volumes) {
        if (!volume_pass_) {
            volume_pass_.emplace(*shared_context(), file.scene);
        }
        return volume_pass_->look_up({gpu_, *receivers_}, view, *volumes);
    }
    scene::View biased = view;
    biased.bias.constant = constant_bias;
    passes_->lookup.render(looked_up(), job, biased);
    return passes_->lookup.read();
}

scene::Image<float> MethodCase::find_critical_biases()
{
    return passes_->lookup.find_critical_biases(looked_up(), job, view);
}

std::array<scene::Image<double>, 4> MethodCase::stored(int level) const
{
    const int side = std::max(job.shadow_map.resolution_texels >> level, 1);
    std::vector<float> numbers(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4);
    glGetTextureImage(filtered_->layer(0).name(), level, GL_RGBA, GL_FLOAT,
                      static_cast<GLsizei>(numbers.size() * sizeof(float)), numbers.data());
    const scene::ImageSize size{side, side};
    std::array<scene::Image<double>, 4> channels{
        scene::Image<double>{size}, scene::Image<double>{size}, scene::Image<double>{size},
        scene::Image<double>{size}};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        channels.at(i % 4)[i / 4] = double{numbers[i]};
    }
    return channels;
}

scene::Image<std::uint32_t> MethodCase::triangles() const
{
    return read_triangles(*shared_context(), *receivers_);
}

namespace {

/// The values to try beside a key's default: every word or flag, the largest integer (of samples as
/// many as drivers have) and the smallest power of two.
std::vector<scene::JobValue> other_values(const scene::Key& key)
{
    std::vector<scene::JobValue> values;
    if (const auto* const words = std::get_if<scene::WordDomain>(&key.domain)) {
        values.assign(words->words.begin(), words->words.end());
    } else if (std::holds_alternative<scene::FlagDomain>(key.domain)) {
        values = {true, false};
    } else if (const auto* const integers = std::get_if<scene::IntegerDomain>(&key.domain)) {
        values = {key.name == "method.samples" ? 4 : integers->upper};
        if (integers->is_power_of_two) {
            values.emplace_back(integers->lower);
        }
    }
    std::erase(values, key.default_value);
    return values;
}

/// The usual lane tries a shared key with the first method that has it, except the stored bits.
bool is_tried(const scene::Key& key, const methods::Method& method)
{
    const auto has_key = [&](const methods::Method& other) {
        return std::ranges::any_of(other.keys,
                                   [&](const scene::Key& own) { return own.name == key.name; });
    };
    const auto first = std::ranges::find_if(methods::methods(), has_key);
    return runs_full_tests() || key.name == "method.bits" || first->name == method.name;
}

/// Whether to try the bias term that reads vertex normals with this method.
bool is_first_with_normals(const methods::Method& method)
{
    const auto has_key = [](const methods::Method& other) {
        return methods::key_table()->find("bias.normal_from")->is_of(other.name);
    };
    const auto first = std::ranges::find_if(methods::methods(), has_key);
    return has_key(method) && (runs_full_tests() || first->name == method.name);
}

} // namespace

std::vector<Configuration> configurations()
{
    std::vector<Configuration> all;
    for (const methods::Method& method : methods::methods()) {
        const std::string name{method.name};
        const std::vector<scene::Override> base{{"method.name", name}};
        if (method.filters.empty()) {
            all.push_back({name, base});
        }
        for (const methods::FilterChoice& filter : method.filters) {
            const std::string word{scene::filter_name(filter.filter)};
            all.push_back({name + " " + word, with(base, {{"lookup.filter", word}})});
        }
        for (const scene::Key& key : method.keys) {
            const auto values =
                is_tried(key, method) ? other_values(key) : std::vector<scene::JobValue>{};
            for (const scene::JobValue& value : values) {
                const std::string text = scene::to_toml(value);
                std::string shown =
                    name + " " + key.name.substr(key.name.find('.') + 1) + " " + text;
                std::erase(shown, '"');
                all.push_back({shown, with(base, {{key.name, text}})});
            }
        }
        if (is_first_with_normals(method)) {
            all.push_back(
                {name + " along normals of vertices",
                 with(base, {{"bias.normal_from", "vertices"}, {"bias.normal_texels", "1.5"}})});
        }
    }
    return all;
}

std::vector<scene::Override> with(std::vector<scene::Override> keys,
                                  const std::vector<scene::Override>& more)
{
    for (const scene::Override& key : more) {
        std::erase_if(keys, [&](const scene::Override& old) { return old.key == key.key; });
        keys.push_back(key);
    }
    return keys;
}

scene::Job job_of_builtin(const std::string& builtin, const std::vector<scene::Override>& keys)
{
    std::string method = methods::key_table()->default_method();
    for (const scene::Override& key : keys) {
        method = key.key == "method.name" ? key.value : method;
    }
    std::vector<scene::Override> of_method = keys;
    std::erase_if(of_method, [&](const scene::Override& key) {
        return !methods::key_table()->has_key(method, key.key);
    });
    return tests::builtin_job(builtin, of_method).job;
}

namespace {

void add(scene::SceneBuilder& builder, const std::string& name, const Plate& plate)
{
    const std::array<scene::Vec3d, 4> corners{
        scene::Vec3d{plate.x0, plate.y, plate.z0}, scene::Vec3d{plate.x0, plate.y, plate.z1},
        scene::Vec3d{plate.x1, plate.y, plate.z1}, scene::Vec3d{plate.x1, plate.y, plate.z0}};
    const std::array<std::array<std::uint32_t, 3>, 2> triangles{{{0, 1, 2}, {0, 2, 3}}};
    builder.add(name, corners, triangles);
}

} // namespace

scene::SceneFile plates_over_ground(const std::vector<Plate>& plates)
{
    scene::SceneBuilder builder;
    add(builder, "ground", {-4, 4, -4, 4, 0});
    std::vector<std::string> casting;
    for (std::size_t i = 0; i < plates.size(); ++i) {
        casting.push_back("plate " + std::to_string(i));
        add(builder, casting.back(), plates[i]);
    }
    scene::SceneFile file{builder.take(), {}};
    scene::set_roles(file.scene, {}, casting);
    return file;
}

scene::Job looking_down(scene::Job job)
{
    job.image = {128, 128};
    job.camera = scene::CameraSettings{.eye = {0, 8, 0},
                                       .target = {0, 0, 0},
                                       .up = {0, 0, -1},
                                       .projection = scene::Projection::orthographic,
                                       .orthographic_height_m = 8};
    job.light = scene::LightSettings{};
    job.light->type = scene::LightType::directional;
    job.light->position = scene::Vec3d{0, 8, 0};
    job.light->target = scene::Vec3d{0, 0, 0};
    job.shadow_map.resolution_texels = 64;
    job.shadow_map.depth_format = {scene::DepthFormat::Kind::d32f, 32};
    job.shadow_map.frustum = {};
    job.shadow_map.frustum.fit = scene::Fit::fixed;
    job.shadow_map.frustum.half_extent_m = 4;
    job.shadow_map.frustum.near_m = 0.5;
    job.shadow_map.frustum.far_m = 8.5;
    return job;
}

scene::Image<float> random_depths(std::mt19937& random, int side)
{
    std::uniform_real_distribution<double> share{0, 1};
    scene::Image<float> depths{{side, side}};
    constexpr int block = 8;
    for (int y = 0; y < side; y += block) {
        for (int x = 0; x < side; x += block) {
            const double middle = share(random);
            const double spread = std::exp2(-26 * share(random)) - 0x1p-26;
            for (int j = y; j < std::min(side, y + block); ++j) {
                for (int i = x; i < std::min(side, x + block); ++i) {
                    depths(i, j) = static_cast<float>(
                        std::clamp(middle + spread * (share(random) - 0.5), 0.0, 1.0));
                }
            }
        }
    }
    return depths;
}

} // namespace gnomon::tests
