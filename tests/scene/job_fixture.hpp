#pragma once

#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace gnomon::scene::test {

/// A folder of its own for each process, removed at its end.
class JobFolder {
public:
    JobFolder()
        : path_{std::filesystem::temp_directory_path() /
                ("gnomon_job_test." + std::to_string(getpid()))}
    {
        std::filesystem::create_directories(path_);
    }
    ~JobFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    JobFolder(const JobFolder&) = delete;
    JobFolder& operator=(const JobFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline const std::filesystem::path& job_folder()
{
    static const JobFolder folder;
    return folder.path();
}

/// Writes the text to a file and returns its path.
inline std::filesystem::path write_job(const std::string& text,
                                       const std::string& name = "job.toml")
{
    std::filesystem::path path = job_folder() / name;
    // Some file systems flush a file that is truncated and written anew, not a new one.
    std::filesystem::remove(path);
    std::ofstream{path, std::ios::binary} << text;
    return path;
}

inline JobFile job_of(const std::string& text, const std::vector<Override>& overrides = {},
                      std::string_view case_name = {}, const Keys& keys = own_keys())
{
    return read_job(write_job(text), overrides, case_name, keys);
}

/// The message of the InputError that the call throws, or "no error".
template <typename Call>
std::string error_of(Call call)
{
    try {
        (void)call();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

/// The message with which a job file of this text is refused; the folder's name is taken off.
inline std::string refusal(const std::string& text, const std::vector<Override>& overrides = {},
                           std::string_view case_name = {}, const Keys& keys = own_keys())
{
    std::string message = error_of([&] { return job_of(text, overrides, case_name, keys); });
    const std::string prefix = job_folder().string() + "/";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix)) {
        message.erase(at, prefix.size());
    }
    return message;
}

/// The job's keys by name.
inline std::map<std::string, std::string> texts_by_key(const Job& job)
{
    std::map<std::string, std::string> keys;
    for (auto& [key, value] : resolved_keys(job)) {
        keys.emplace(key, value);
    }
    return keys;
}

} // namespace gnomon::scene::test
