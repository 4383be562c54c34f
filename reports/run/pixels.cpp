#include "reports/run/pixels.hpp"

#include "scene/error.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <system_error>

namespace gnomon::reports {

namespace fs = std::filesystem;

fs::path pixels_path(const fs::path& folder, std::string_view id)
{
    const fs::path pixels = folder / "pixels";
    std::error_code error;
    fs::create_directories(pixels, error);
    if (error) {
        throw scene::EnvironmentError(fmt::format("{}: cannot be made: {}; check the folder",
                                                  pixels.string(), error.message()));
    }
    return pixels / fmt::format("{}.exr", id);
}

bool is_pixels_name(std::string_view name)
{
    constexpr std::size_t id_digits = 16;
    return name.size() > id_digits && name.substr(id_digits) == ".exr" &&
           name.find_first_not_of("0123456789abcdef") == id_digits;
}

void take_pixels(const fs::path& folder, const fs::path& other)
{
    std::error_code none;
    for (const auto& entry : fs::directory_iterator{other / "pixels", none}) {
        const fs::path target = pixels_path(folder, entry.path().stem().string());
        if (entry.path().extension() != ".exr" || fs::exists(target)) {
            continue;
        }
        std::error_code error;
        fs::create_hard_link(entry.path(), target, error);
        if (error) {
            error.clear();
            fs::copy_file(entry.path(), target, error);
        }
        if (error) {
            throw scene::EnvironmentError(
                fmt::format("{}: cannot be written: {}; make room, or check the folder",
                            target.string(), error.message()));
        }
    }
}

} // namespace gnomon::reports
