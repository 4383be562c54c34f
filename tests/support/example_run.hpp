#pragma once

#include "store/run/run_store.hpp"

#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

namespace gnomon::store {

/// A sweep over resolutions and biases with invented results, which follow from the ordinals. Its
/// rows are `curves` groups of `biases` each.
struct ExampleRun {
    std::uint64_t curves = 3;
    std::uint64_t biases = 4;
    std::uint32_t shards = 1; ///< curve c belongs to shard c mod shards + 1
    std::uint64_t maps = 1;   ///< cascades, if more than 1

    [[nodiscard]] RunDescription description(std::uint32_t shard = 1) const;
    [[nodiscard]] std::vector<analysis::Configuration> configurations() const;
    [[nodiscard]] std::vector<analysis::Configuration> configurations_of(std::uint64_t curve) const;
    [[nodiscard]] analysis::FinishedCurve curve(std::uint64_t number) const;
    /// Records the curves of a shard, except those left out.
    void record(RunStore& store, std::uint32_t shard = 1,
                const std::set<std::uint64_t>& left_out = {}) const;
    /// Plans and records a shard, and writes its CSV files.
    void compute(const std::filesystem::path& folder, std::uint32_t shard = 1) const;
};

/// The contents of the three CSV files of every run, joined.
[[nodiscard]] std::string csv_texts(const std::filesystem::path& folder);

} // namespace gnomon::store
