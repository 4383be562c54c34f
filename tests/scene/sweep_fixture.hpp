#pragma once

#include "job_fixture.hpp"
#include "scene/job/sweep/sweep.hpp"
#include "scene/job/sweep/sweep_space.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene::test {

inline const std::string wall = "scene.builtin = \"wall\"\n";

inline SweepSpace space_of(const std::string& text, const std::vector<std::string>& axes = {},
                           std::string_view case_name = {},
                           const std::vector<Override>& overrides = {})
{
    return {read_job_source(write_job(text), overrides), axes, case_name};
}

/// The message with which a space is refused; the folder's name is taken off.
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
