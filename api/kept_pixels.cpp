#include "api/kept_pixels.hpp"

#include "api/compare.hpp"
#include "reports/json/comparison_json.hpp"
#include "store/exr/aov_write.hpp"
#include "store/json_values.hpp"
#include "store/output_file.hpp"
#include "store/run_folder/pixels.hpp"

namespace gnomon::api {

void keep_pixels(const std::filesystem::path& folder, std::string_view id,
                 const analysis::Comparison& comparison)
{
    const auto points = points_of(comparison);
    store::make_pixels_folder(folder);
    // The image last: whoever finds it finds both.
    store::write_file(store::detail_path(folder, id), reports::comparison_json(comparison));
    store::write_aov(store::pixels_path(folder, id), comparison, points);
}

} // namespace gnomon::api
