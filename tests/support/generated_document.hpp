#pragma once

#include "temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace gnomon::tests {

/// Expects a document of this text. Writes it first if GNOMON_UPDATE_DOCUMENTS is set.
/// @param entry  The CTest entry that writes it.
inline void expect_document(const std::filesystem::path& path, const std::string& expected,
                            const char* entry)
{
    if (std::getenv("GNOMON_UPDATE_DOCUMENTS") != nullptr) {
        std::ofstream{path} << expected;
    }
    EXPECT_EQ(read_text(path), expected)
        << "to update it: GNOMON_UPDATE_DOCUMENTS=1 ./dev test -- -R " << entry;
}

} // namespace gnomon::tests
