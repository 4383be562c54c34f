#pragma once

#include "methods/key_table.hpp"
#include "scene/job/file.hpp"

#include <string_view>
#include <vector>

namespace gnomon::tests {

/// A built-in scene's job. Its keys may be those of any method.
[[nodiscard]] inline scene::JobFile builtin_job(std::string_view name,
                                                const std::vector<scene::Override>& keys = {})
{
    return scene::builtin_job(name, keys, methods::key_table());
}

} // namespace gnomon::tests
