#include "methods/key_table.hpp"
#include "scene/builtin/scenes.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/job/keys/key_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>

namespace gnomon::scene {
namespace {

std::set<std::string> document_rows()
{
    std::ifstream document{GNOMON_ROOT "/docs/job_file.md"};
    std::set<std::string> rows;
    for (std::string line; std::getline(document, line);) {
        if (line.starts_with("| `")) {
            rows.insert(line);
        }
    }
    return rows;
}

/// `gnomon scenes` lists the parameters of built-in scenes.
bool is_builtin_parameter(const Key& key)
{
    const auto scenes = builtin_scenes();
    return std::any_of(scenes.begin(), scenes.end(), [&](const BuiltinScene& scene) {
        return key.name.starts_with("scene." + scene.name + ".");
    });
}

std::set<std::string> expected_rows()
{
    std::set<std::string> rows;
    for (const scene::Key& key : methods::key_table()->rows()) {
        if (!is_builtin_parameter(key)) {
            const std::string default_text =
                key.default_text.empty() ? "–" : "`" + key.default_text + "`";
            rows.insert("| `" + key.name + "` | " + key.description + " | " + default_text + " | " +
                        key.range_text + " |");
        }
    }
    return rows;
}

TEST(JobFileDocument, DescribesEveryKeyAsTheProgramDoes)
{
    const std::set<std::string> rows = document_rows();
    for (const std::string& row : expected_rows()) {
        EXPECT_TRUE(rows.contains(row)) << "docs/job_file.md needs the row\n" << row;
    }
}

TEST(JobFileDocument, DescribesNoOtherKey)
{
    const std::set<std::string> expected = expected_rows();
    for (const std::string& row : document_rows()) {
        EXPECT_TRUE(expected.contains(row)) << "docs/job_file.md has a row of no key\n" << row;
    }
}

} // namespace
} // namespace gnomon::scene
