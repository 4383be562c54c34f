#include "store/exr/aov_read.hpp"

#include "scene/error.hpp"
#include "store/images/layer_file.hpp"

#include <fmt/format.h>

namespace gnomon::store {

namespace {

/// The texts of one light, by their names without its own, and those of all.
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
