#include "store/run_folder/leftovers.hpp"

#include "store/csv/run_csv.hpp"
#include "store/output_file.hpp"
#include "store/run_folder/pixels.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace gnomon::store {

namespace fs = std::filesystem;

namespace {

bool is_csv_name(std::string_view name)
{
    return std::find(run_csv_names.begin(), run_csv_names.end(), name) != run_csv_names.end();
}

/// The folder's regular files.
std::vector<fs::path> files_in(const fs::path& folder)
{
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry{folder, error}; !error && entry != fs::directory_iterator{};
         entry.increment(error)) {
        std::error_code unknown;
        if (entry->symlink_status(unknown).type() == fs::file_type::regular) {
            files.push_back(entry->path());
        }
    }
    return files;
}

/// Removes the temporary files of the folder's own files.
void remove_temporaries(const fs::path& folder, bool (*is_own)(std::string_view name))
{
    for (const fs::path& file : files_in(folder)) {
        const std::string name = file.filename().string();
        if (is_own(temporary_target(name))) {
            std::error_code error;
            fs::remove(file, error);
        }
    }
}

} // namespace

void remove_leftovers(const fs::path& folder)
{
    remove_temporaries(folder, is_csv_name);
    remove_temporaries(folder / "pixels", is_pixels_name);
}

} // namespace gnomon::store
