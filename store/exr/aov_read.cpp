#include "store/exr/aov_read.hpp"

#include "scene/error.hpp"
#include "store/images/layer_file.hpp"

#include <fmt/format.h>

namespace gnomon::store {

Aov read_aov(const std::filesystem::path& path, scene::ImageSize image)
{
    LayerFile file{path, "write it again with `gnomon compare JOB --aov FILE.exr`"};
    const scene::ImageSize size = file.size();
    if (size != image) {
        throw scene::InputError(fmt::format(
            "{}: the image is {}x{} pixels but the job's is {}x{}: give the job that it was made "
            "from",
            path.string(), size.width_px, size.height_px, image.width_px, image.height_px));
    }
    Aov aov;
    aov.texts = file.texts();
    aov.pixel_class = file.classes();
    aov.truth = file.floats("truth");
    aov.prim = file.integers("prim");
    aov.witness = file.integers("witness");
    return aov;
}

} // namespace gnomon::store
