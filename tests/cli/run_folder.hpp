#pragma once

#include "child_process.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace gnomon::testing {

/// The exit status of a sweep with missing or failed configurations.
inline constexpr int incomplete = 5;

/// The bytes of a run's three CSV files.
struct RunCsv {
    std::string results;
    std::string error_vs_z;
    std::string bias_curves;

    explicit RunCsv(const std::filesystem::path& run)
        : results{text_of(run / "results.csv")},
          error_vs_z{text_of(run / "error_vs_z.csv")},
          bias_curves{text_of(run / "bias_curves.csv")}
    {
        EXPECT_FALSE(results.empty()) << run;
    }
};

/// Not with EXPECT_EQ, which would print megabytes.
inline void expect_same(const RunCsv& a, const RunCsv& b)
{
    EXPECT_TRUE(a.results == b.results);
    EXPECT_TRUE(a.error_vs_z == b.error_vs_z);
    EXPECT_TRUE(a.bias_curves == b.bias_curves);
}

/// The cells of a CSV text (RFC 4180), line by line.
inline std::vector<std::vector<std::string>> csv_cells(const std::string& text)
{
    std::vector<std::vector<std::string>> lines;
    std::vector<std::string> line(1);
    bool is_quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (is_quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
            line.back() += text[++i];
        } else if (c == '"') {
            is_quoted = !is_quoted;
        } else if (c == ',' && !is_quoted) {
            line.emplace_back();
        } else if (c == '\n' && !is_quoted) {
            lines.push_back(line);
            line.assign(1, "");
        } else {
            line.back() += c;
        }
    }
    return lines;
}

/// The rows of a CSV file, each by its columns' names.
inline std::vector<std::map<std::string, std::string>> csv_rows(const std::filesystem::path& file)
{
    const auto lines = csv_cells(text_of(file));
    std::vector<std::map<std::string, std::string>> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        auto& row = rows.emplace_back();
        EXPECT_EQ(lines[i].size(), lines[0].size()) << file << ", line " << i;
        for (std::size_t column = 0; column < lines[i].size(); ++column) {
            row[lines[0].at(column)] = lines[i][column];
        }
    }
    return rows;
}

/// Waits up to 30 s for the condition: programs start slowly on a busy machine.
inline void wait_until(const std::function<bool()>& holds)
{
    const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds{30};
    while (!holds()) {
        if (std::chrono::steady_clock::now() > latest) {
            ADD_FAILURE() << "waited in vain";
            return;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
}

/// The number of entries in the folder; 0 if it is missing.
inline std::size_t entry_count(const std::filesystem::path& folder)
{
    std::error_code missing;
    const std::filesystem::directory_iterator entries{folder, missing};
    return missing ? 0 : static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
}

/// The number of configurations whose layers a run keeps; expects a JSON file for each.
inline std::size_t kept_images(const std::filesystem::path& run)
{
    std::size_t count = 0;
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator{run / "pixels", missing}) {
        if (entry.path().extension() == ".exr") {
            ++count;
            EXPECT_TRUE(exists(std::filesystem::path{entry.path()}.replace_extension(".json")))
                << entry.path();
        }
    }
    return count;
}

/// A spot and the sun over the same spheres.
inline const std::string two_lights = R"(
scene.builtin = "sphere-cube"
image.width = 64
image.height = 36
[[case]]
name = "spot"
[[case]]
name = "sun"
light.type = "directional"
light.direction = [-0.4, -1, -0.3]
)";

inline std::vector<std::string> sweep(const std::filesystem::path& job,
                                      const std::filesystem::path& run,
                                      const std::vector<std::string>& more = {})
{
    std::vector<std::string> arguments{"sweep", job, "--out", run};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

inline std::vector<std::string> with(std::vector<std::string> words,
                                     const std::vector<std::string>& more)
{
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Runs a sweep that must succeed.
inline Ending swept(const std::vector<std::string>& arguments, const Start& start = {})
{
    Ending ending = gnomon(arguments, start);
    EXPECT_EQ(ending.exit_code, 0) << ending.command << "\n" << ending.err;
    return ending;
}

} // namespace gnomon::testing
