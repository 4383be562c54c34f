#include "reports/page/page_data.hpp"

#include "analysis/bias/bias_units.hpp"
#include "reports/page/image_layers.hpp"
#include "scene/error.hpp"
#include "scene/text.hpp"
#include "store/json_values.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::reports {

namespace {

using scene::Image;
using scene::PixelClass;

struct NamedLayer {
    std::string name;
    LayerValues values;
    std::optional<PackedArray> packed = {};
};

float with_11_bits(float value)
{
    if (!std::isfinite(value)) {
        return value;
    }
    int exponent = 0;
    const float fraction = std::frexp(value, &exponent);
    return std::ldexp(std::round(std::ldexp(fraction, 11)), exponent - 11);
}

template <typename Value, typename From, typename Convert>
NamedLayer converted(std::string name, const Image<From>& image, const Convert& convert)
{
    std::vector<Value> values;
    values.reserve(image.pixel_count());
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
        values.push_back(convert(image[i]));
    }
    return {std::move(name), std::move(values)};
}

NamedLayer unchanged(std::string name, const Image<float>& image)
{
    return converted<float>(std::move(name), image, [](float value) { return value; });
}

NamedLayer small(std::string name, const Image<std::uint32_t>& image)
{
    return converted<std::uint8_t>(std::move(name), image, [](std::uint32_t value) {
        return static_cast<std::uint8_t>(value);
    });
}

/// A fraction as 0…255; NaN is 0.
std::uint8_t level(float fraction)
{
    return std::isnan(fraction)
               ? std::uint8_t{0}
               : static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(fraction, 0.0F, 1.0F)));
}

/// The layers for shading: the cosine to the light, and how far a surface faces the sky.
void add_shading(std::vector<NamedLayer>& layers, store::LayerFile& file)
{
    if (!file.has("tan_theta") || !file.has("N.Y")) {
        return;
    }
    layers.push_back(
        converted<std::uint8_t>("cos_theta", file.floats("tan_theta"), [](float tangent) {
            return level(1.0F / std::sqrt(1.0F + tangent * tangent));
        }));
    layers.push_back(converted<std::uint8_t>("sky", file.floats("N.Y"), [](float upwards) {
        return level(std::isnan(upwards) ? upwards : 0.5F + 0.5F * upwards);
    }));
}

/// Column or row of the texel that contains each receiver, from the map's lower left; 65535 without
/// a receiver, and beyond 16 bits.
NamedLayer texel_indices(std::string name, const Image<float>& positions)
{
    constexpr std::uint16_t none = std::numeric_limits<std::uint16_t>::max();
    return converted<std::uint16_t>(std::move(name), positions, [](float position) {
        return position >= 0 && position < float{none} ? static_cast<std::uint16_t>(position)
                                                       : none;
    });
}

void add_indices(std::vector<NamedLayer>& layers, store::LayerFile& file)
{
    const auto same = [](std::uint32_t value) { return value; };
    layers.push_back(converted<std::uint32_t>("prim", file.integers("prim"), same));
    layers.push_back(converted<std::uint32_t>("witness", file.integers("witness"), same));
    if (file.has("object")) {
        layers.push_back(
            converted<std::uint16_t>("object", file.integers("object"), [](std::uint32_t object) {
                constexpr std::uint32_t none = std::numeric_limits<std::uint16_t>::max();
                return static_cast<std::uint16_t>(std::min(object, none));
            }));
    }
    for (const char* const name : {"cause", "label", "map_index"}) {
        if (file.has(name)) {
            layers.push_back(small(name, file.integers(name)));
        }
    }
    if (file.has("texel.X") && file.has("texel.Y")) {
        layers.push_back(texel_indices("texel_x", file.floats("texel.X")));
        layers.push_back(texel_indices("texel_y", file.floats("texel.Y")));
    }
}

std::vector<NamedLayer> page_layers(store::LayerFile& file, const ImageLayers& image,
                                    const store::Json& derive)
{
    std::vector<NamedLayer> layers;
    layers.push_back(small("class", file.integers("class")));
    layers.push_back(unchanged("verdict", file.floats("verdict")));
    layers.push_back(unchanged("receiver_depth", image.receiver_depth()));
    layers.push_back(unchanged("map_depth", image.map_depth()));
    add_indices(layers, file);
    add_shading(layers, file);
    if (image.has_diagnosis()) {
        layers.push_back(unchanged("light_distance_m", image.light_distance_m()));
        layers.push_back(converted<float>("map_error_m", file.floats("map_error_m"), with_11_bits));
    }
    if (image.has_biases()) {
        layers.push_back({"critical_bias_steps", image.critical_steps()});
        for (const auto& [name, values] :
             {std::pair{"needed_bias_m", &image.needed_m()},
              std::pair{"needed_bias_texels", &image.needed_texels()}}) {
            if (!derive.at(name).get<bool>()) {
                layers.push_back(unchanged(name, *values));
            }
        }
    }
    return layers;
}

/// Number of pixels kept per row or column.
int thinned_count(int count, int step)
{
    return (count + step - 1) / step;
}

LayerValues thinned(const LayerValues& values, scene::ImageSize size, int step)
{
    return std::visit(
        [&](const auto& all) -> LayerValues {
            std::remove_cvref_t<decltype(all)> taken;
            for (int y = 0; y < size.height_px; y += step) {
                for (int x = 0; x < size.width_px; x += step) {
                    taken.push_back(
                        all[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width_px) +
                            static_cast<std::size_t>(x)]);
                }
            }
            return taken;
        },
        values);
}

/// Whether two layers are equal bit for bit.
bool are_equal(const LayerValues& a, const LayerValues& b)
{
    const auto bytes = [](const LayerValues& values) {
        return std::visit([](const auto& all) { return std::as_bytes(std::span{all}); }, values);
    };
    return a.index() == b.index() && std::ranges::equal(bytes(a), bytes(b));
}

store::Json depth_step(const std::optional<scene::DepthFormat>& format)
{
    if (!format) {
        return nullptr;
    }
    return {{"is_float", format->is_float()}, {"step", analysis::depth_step(*format, 1.0F)}};
}

PackedArray packed(const LayerValues& values)
{
    return std::visit([](const auto& all) { return pack(std::span{all}); }, values);
}

store::Json object_names(const store::Json& detail)
{
    store::Json names = store::Json::array();
    for (const store::Json& object : detail.at("by_object")) {
        names.push_back(object.at("object"));
    }
    return names;
}

/// @param pack_layers  Turns layers into the JSON that names their blocks.
template <typename Pack>
store::Json image_entry(store::LayerFile& file, const store::Json& detail, int step,
                        const Pack& pack_layers)
{
    const PixelRules rules{detail};
    const ImageLayers image{file, rules};
    const bool derives_lengths = image.can_derive_lengths();
    const store::Json derive{{"needed_bias_m", derives_lengths},
                             {"needed_bias_texels", derives_lengths}};
    store::Json frustum = rules.frustum;
    const scene::DepthRange stored = rules.light.stored_range();
    frustum["is_linear"] = stored.projection == scene::Projection::orthographic;
    frustum["range_m"] = stored.far_m - stored.near_m;
    frustum["inverse_range_per_m"] = 1.0 / rules.light.near_m - 1.0 / rules.light.far_m;
    std::vector<NamedLayer> layers = page_layers(file, image, derive);
    for (NamedLayer& layer : layers) {
        layer.values =
            step == 1 ? std::move(layer.values) : thinned(layer.values, file.size(), step);
    }
    return {{"width", thinned_count(file.size().width_px, step)},
            {"height", thinned_count(file.size().height_px, step)},
            {"step", step},
            {"layers", pack_layers(std::move(layers))},
            {"derive", derive},
            {"frustum", std::move(frustum)},
            {"outside", rules.outside},
            {"filter", rules.filter},
            {"slope", rules.slope},
            {"bias_constant", rules.bias},
            {"depth_step", depth_step(rules.format)},
            {"objects", object_names(detail)},
            {"detail", detail}};
}

constexpr std::string_view kept_advice =
    "remove it and the file of the same name beside it, and run the command of the run again";

[[noreturn]] void refuse_detail(const std::filesystem::path& path)
{
    throw scene::InputError(fmt::format("{}: is damaged, or belongs to another configuration: {}",
                                        scene::one_line(path.string()), kept_advice));
}

/// Whether the JSON belongs to the configuration.
bool is_of(const store::Json& detail, const KeptImage& image)
{
    return detail.at("pixels").at("lit") == image.lit &&
           detail.at("pixels").at("blocked") == image.blocked &&
           detail.at("false_shadow") == image.false_shadow &&
           detail.at("false_lit") == image.false_lit;
}

/// Whether the image has the JSON's job and pixel counts.
bool is_of(store::LayerFile& file, const store::Json& detail)
{
    const auto texts = file.texts();
    const auto job = texts.find("job");
    if (job == texts.end() || store::Json::parse(job->second, nullptr, false) != detail.at("job")) {
        return false;
    }
    const scene::Image<PixelClass> classes = file.classes();
    const auto count = [&](PixelClass pixel_class) {
        return std::count(classes.begin(), classes.end(), pixel_class);
    };
    return detail.at("pixels").at("lit") == count(PixelClass::lit) &&
           detail.at("pixels").at("blocked") == count(PixelClass::blocked);
}

} // namespace

store::Json PageImages::read(const KeptImage& image, int step)
{
    store::LayerFile file{store::pixels_path(folder_, image.id), std::string{kept_advice}};
    store::Json detail = store::find_detail(folder_, image.id);
    try {
        // Check the size before allocating memory for it.
        const store::Json& job = detail.at("job");
        if (job.at("image.width") != file.size().width_px ||
            job.at("image.height") != file.size().height_px) {
            refuse_detail(store::pixels_path(folder_, image.id));
        }
        if (!is_of(detail, image) || !is_of(file, detail)) {
            refuse_detail(store::pixels_path(folder_, image.id));
        }
        detail.erase("engine_settings"); // the first screen has those of the headline
        store::Json entry{{"row", image.row}};
        const auto pack_layers = [&](std::vector<NamedLayer> layers) {
            tbb::parallel_for(std::size_t{0}, layers.size(), [&](std::size_t i) {
                const auto known = last_.find(layers[i].name);
                if (known == last_.end() || !are_equal(known->second.values, layers[i].values)) {
                    layers[i].packed = packed(layers[i].values);
                }
            });
            store::Json json = store::Json::object();
            for (NamedLayer& layer : layers) {
                if (layer.packed) {
                    last_[layer.name] = {std::move(layer.values),
                                         blocks_.add(std::move(*layer.packed))};
                }
                json[layer.name] = last_.at(layer.name).block;
            }
            return json;
        };
        entry.update(image_entry(file, detail, step, pack_layers));
        return entry;
    } catch (const store::Json::exception&) {
        refuse_detail(store::detail_path(folder_, image.id));
    }
}

} // namespace gnomon::reports
