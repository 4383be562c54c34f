#include "store/run_folder/pixels.hpp"

#include "scene/error.hpp"
#include "store/json_values.hpp"
#include "store/output_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <system_error>

namespace gnomon::store {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 2> kept_extensions{".exr", ".json"};

fs::path kept_path(const fs::path& folder, std::string_view name)
{
    return folder / "pixels" / name;
}

bool is_kept_extension(std::string_view text)
{
    return std::find(kept_extensions.begin(), kept_extensions.end(), text) != kept_extensions.end();
}

} // namespace

fs::path pixels_path(const fs::path& folder, std::string_view id)
{
    return kept_path(folder, fmt::format("{}.exr", id));
}

fs::path detail_path(const fs::path& folder, std::string_view id)
{
    return kept_path(folder, fmt::format("{}.json", id));
}

void make_pixels_folder(const fs::path& folder)
{
    make_folder(folder / "pixels");
}

bool has_image(const std::filesystem::path& folder, std::string_view id)
{
    std::error_code error;
    return std::filesystem::exists(pixels_path(folder, id), error) &&
           std::filesystem::exists(detail_path(folder, id), error);
}

Json find_detail(const std::filesystem::path& folder, std::string_view id)
{
    if (!has_image(folder, id)) {
        return nullptr;
    }
    std::ifstream file{detail_path(folder, id)};
    Json detail = Json::parse(file, nullptr, false);
    return detail.is_object() ? detail : Json(nullptr);
}

bool is_pixels_name(std::string_view name)
{
    constexpr std::size_t id_digits = 16;
    return name.size() > id_digits && is_kept_extension(name.substr(id_digits)) &&
           name.find_first_not_of("0123456789abcdef") == id_digits;
}

void take_pixels(const fs::path& folder, const fs::path& other)
{
    std::error_code none;
    for (const auto& entry : fs::directory_iterator{other / "pixels", none}) {
        const std::string name = entry.path().filename().string();
        const fs::path target = kept_path(folder, name);
        if (!is_pixels_name(name) || fs::exists(target)) {
            continue;
        }
        make_pixels_folder(folder);
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

} // namespace gnomon::store
