#pragma once

#include "job_fixture.hpp"
#include "scene/error.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key_table.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene::test {

/// A separate folder for each process, removed at its end.
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
    // Some file systems flush a rewritten file to disk, but not a new one.
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

/// The error message for a job file with this text, without the folder's name.
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

inline const std::string wall = "scene.builtin = \"wall\"\n";

inline SweepSpace space_of(const std::string& text, const std::vector<std::string>& axes = {},
                           std::string_view case_name = {},
                           const std::vector<Override>& overrides = {})
{
    return {read_job_source(write_job(text), overrides), axes, case_name};
}

/// The error message for a sweep space, without the folder's name.
inline std::string space_refusal(const std::string& text, const std::vector<std::string>& axes = {},
                                 std::string_view case_name = {},
                                 const std::vector<Override>& overrides = {})
{
    std::string message = error_of([&] { return space_of(text, axes, case_name, overrides); });
    const std::string prefix = job_folder().string() + "/";
    for (auto at = message.find(prefix); at != std::string::npos; at = message.find(prefix)) {
        message.erase(at, prefix.size());
    }
    return message;
}

} // namespace gnomon::scene::test
