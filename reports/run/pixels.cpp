#include "reports/run/pixels.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <system_error>

namespace gnomon::reports {

std::filesystem::path pixels_path(const std::filesystem::path& folder, std::string_view id)
{
    const std::filesystem::path pixels = folder / "pixels";
    std::error_code error;
    std::filesystem::create_directories(pixels, error);
    if (error) {
        throw scene::EnvironmentError(fmt::format("{}: cannot be made: {}; check the folder",
                                                  pixels.string(), error.message()));
    }
    return pixels / fmt::format("{}.exr", id);
}

} // namespace gnomon::reports
