#pragma once

#include "store/run/run_store.hpp"

#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

namespace gnomon::store {

/// A sweep over biases and resolutions whose results follow from the ordinals: its rows are
/// `curves` groups of `biases` each.
struct ExampleRun {
    std::uint64_t curves = 3;
    std::uint64_t biases = 4;
    std::uint32_t shards = 1; ///< curve c belongs to shard c mod shards + 1
    std::uint64_t maps = 1;   ///< of the light: cascades, if there are several

    [[nodiscard]] RunDescription description(std::uint32_t shard = 1) const;
    [[nodiscard]] std::vector<analysis::Configuration> configurations() const;
    /// Those of a curve, by number.
    [[nodiscard]] std::vector<analysis::Configuration> configurations_of(std::uint64_t curve) const;
    /// The result of a whole curve, by number.
    [[nodiscard]] analysis::FinishedCurve curve(std::uint64_t number) const;
    /// Records the curves of that part, but for those left out.
    void record(RunStore& store, std::uint32_t shard = 1,
                const std::set<std::uint64_t>& left_out = {}) const;
    /// Plans and records that part, and writes its CSV files.
    void compute(const std::filesystem::path& folder, std::uint32_t shard = 1) const;
};

/// The contents of a run's three CSV files that it always has, one after the other.
[[nodiscard]] std::string csv_texts(const std::filesystem::path& folder);

} // namespace gnomon::store
