#pragma once

#include "analysis/pixels/statistics.hpp"

#include "child_process.hpp"
#include "example_run.hpp"
#include "run_folder.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::testing {

/// A folder with runs and baselines.
class GateFolder {
public:
    [[nodiscard]] std::string at(const std::string& name) const
    {
        return (folder_.path() / name).string();
    }
    void write(const std::string& name, const std::string& text) const
    {
        folder_.write(name, text);
    }
    void compare(const std::string& name, const std::vector<std::string>& more) const
    {
        const Ending ending =
            gnomon(with({"compare", "--builtin", builtin, "--set", "image.width=320", "--set",
                         "image.height=180", "--out", at(name)},
                        more));
        ASSERT_EQ(ending.exit_code, 0) << ending.command << ending.err;
    }
    [[nodiscard]] Ending save(const std::string& run,
                              const std::vector<std::string>& more = {}) const
    {
        return gnomon(with({"baseline", "save", at(run), "--baseline", at("baseline.json")}, more));
    }
    [[nodiscard]] Ending gate(const std::string& run, const std::vector<std::string>& more = {},
                              Start start = {}) const
    {
        start.environment.emplace_back("CI=");
        return gnomon(with({"gate", at(run), "--baseline", at("baseline.json")}, more), start);
    }
    /// The paths of the masks beside the baseline.
    [[nodiscard]] std::vector<std::filesystem::path> masks() const
    {
        std::vector<std::filesystem::path> paths;
        std::error_code none;
        for (const auto& file :
             std::filesystem::directory_iterator{at("baseline.json.masks"), none}) {
            paths.push_back(file.path());
        }
        return paths;
    }

    std::string builtin = "sphere-plane"; ///< the scene that is compared

private:
    TemporaryFolder folder_;
};

/// Adds one false-lit pixel with the cause coverage.
inline void add_leak(analysis::ConfigurationResult& result)
{
    analysis::Metrics& metrics = result.metrics;
    ++metrics.false_lit;
    auto causes = result.causes.value_or(analysis::CauseCounts{});
    ++causes.by_cause[static_cast<std::size_t>(analysis::Cause::coverage)];
    ++causes.by_label[static_cast<std::size_t>(analysis::Label::leak)];
    result.causes = causes;
    const auto lit = metrics.pixels.of(scene::PixelClass::lit);
    const auto blocked = metrics.pixels.of(scene::PixelClass::blocked);
    metrics.false_lit_rate = analysis::ratio(metrics.false_lit, blocked);
    metrics.error_rate = analysis::ratio(metrics.false_shadow + metrics.false_lit, lit + blocked);
}

/// Records the example with changed results or descriptions.
template <typename Change>
void record_example(const std::string& folder, const store::ExampleRun& run, const Change& change)
{
    std::filesystem::create_directories(folder);
    store::RunDescription description = run.description();
    std::vector<analysis::FinishedCurve> curves;
    for (std::uint64_t c = 0; c < run.curves; ++c) {
        curves.push_back(run.curve(c));
    }
    change(description, curves);
    store::RunStore store{folder, store::RunStore::Access::write};
    store.plan(description, run.configurations());
    for (const analysis::FinishedCurve& curve : curves) {
        store.record(curve);
    }
}

} // namespace gnomon::testing
