#include "store/baseline/kept_wrong_pixels.hpp"

#include "scene/error.hpp"
#include "store/baseline/pixel_mask.hpp"
#include "store/images/layer_file.hpp"
#include "store/json_values.hpp"
#include "store/run_folder/pixels.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

namespace gnomon::store {

namespace {

using analysis::PixelMask;

constexpr const char* kept_pixels_advice = "compute the run's pixels again";

/// Converts a channel of codes to enumerators; empty if the file lacks the channel.
template <typename Code, typename Names>
scene::Image<Code> coded_channel(LayerFile& file, const std::filesystem::path& path,
                                 const char* name, const Names& names)
{
    if (!file.has(name)) {
        return {};
    }
    const scene::Image<std::uint32_t> codes = file.integers(name);
    scene::Image<Code> image{codes.size()};
    for (std::size_t i = 0; i < codes.pixel_count(); ++i) {
        if (codes[i] >= names.size()) {
            throw scene::InputError(fmt::format("{}: channel {} has code {}: {}", path.string(),
                                                name, codes[i], kept_pixels_advice));
        }
        image[i] = static_cast<Code>(codes[i]);
    }
    return image;
}

std::vector<std::string> object_names(const std::filesystem::path& run, const std::string& id)
{
    std::vector<std::string> names;
    const Json detail = find_detail(run, id);
    const auto objects = detail.is_object() ? detail.find("by_object") : detail.end();
    if (objects == detail.end() || !objects->is_array()) {
        return names;
    }
    for (const Json& object : *objects) {
        const bool is_named = object.is_object() && object.contains("object");
        names.push_back(is_named && object["object"].is_string()
                            ? object["object"].get<std::string>()
                            : std::string{});
    }
    return names;
}

} // namespace

bool has_kept_pixels(const std::filesystem::path& run, const std::string& id)
{
    std::error_code unknown;
    return std::filesystem::exists(pixels_path(run, id), unknown);
}

analysis::WrongPixels read_wrong_pixels(const std::filesystem::path& run, const std::string& id)
{
    const std::filesystem::path path = pixels_path(run, id);
    LayerFile file{path, kept_pixels_advice};
    const auto classes = file.classes();
    const auto verdict = file.floats("verdict");
    analysis::WrongPixels wrong;
    wrong.mask = PixelMask{classes.size()};
    wrong.is_false_lit = PixelMask{classes.size()};
    for (std::size_t i = 0; i < classes.pixel_count(); ++i) {
        const bool is_false_lit = scene::is_false_lit(classes[i], verdict[i]);
        wrong.mask[i] = is_false_lit || scene::is_false_shadow(classes[i], verdict[i]) ? 1 : 0;
        wrong.is_false_lit[i] = is_false_lit ? 1 : 0;
    }
    wrong.cause = coded_channel<analysis::Cause>(file, path, "cause", analysis::cause_names);
    wrong.label = coded_channel<analysis::Label>(file, path, "label", analysis::label_names);
    wrong.objects = object_names(run, id);
    if (file.has("object") && !wrong.objects.empty()) {
        wrong.object = file.integers("object");
    }
    if (file.has("light_distance_m")) {
        wrong.light_distance_m = file.floats("light_distance_m");
    }
    return wrong;
}

analysis::NewPixelAnswer NewPixelFinder::operator()(const analysis::GateEntry& before,
                                                    const analysis::GateEntry& now,
                                                    const analysis::PixelFilter& filter) const
{
    const PixelMask mask = read_mask(baseline_, before.pixels, image_size_of(before));
    const analysis::WrongPixels wrong = read_wrong_pixels(run_, now.pixels);
    if (mask.size() != wrong.mask.size()) {
        return {std::nullopt, fmt::format("the image is {}x{} pixels, the baseline's {}x{}",
                                          wrong.mask.size().width_px, wrong.mask.size().height_px,
                                          mask.size().width_px, mask.size().height_px)};
    }
    if (!wrong.knows(filter)) {
        return {std::nullopt, "the run did not keep the layers that the filter needs"};
    }
    return {analysis::find_new_pixels(mask, wrong, filter), {}};
}

} // namespace gnomon::store
