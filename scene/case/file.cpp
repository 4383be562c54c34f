#include "scene/case/file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::scene {

bool CaseFile::says(std::string_view key) const
{
    return std::ranges::any_of(source.file,
                               [&](const Setting& setting) { return setting.spec->name == key; });
}

bool CaseFile::says_any(std::string_view table) const
{
    const std::string prefix = fmt::format("{}.", table);
    return std::ranges::any_of(source.file, [&](const Setting& setting) {
        return setting.spec->name.starts_with(prefix);
    });
}

} // namespace gnomon::scene
