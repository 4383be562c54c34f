#pragma once

#include "example_run.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::store {

/// The id of a unit of `UnitSweep`.
[[nodiscard]] std::string unit_name(std::uint32_t number);

/// A sweep with a curve of three biases in each unit. Results are functions of the ordinals.
struct UnitSweep {
    std::uint64_t units = 12;
    std::string gnomon = "Gnomon 0.1.0";
    std::string gl_renderer = "llvmpipe";
    std::string scene = "0123456789abcdef";
    std::string plan = "00000000000000aa";
    bool fails = false; ///< its configurations, for want of memory

    [[nodiscard]] ExampleRun run() const;
    /// Writes a unit's file.
    std::filesystem::path compute(const std::filesystem::path& folder, std::uint32_t number) const;
    std::vector<std::filesystem::path> compute_all(const std::filesystem::path& folder) const;
    /// The CSV files of one machine's sweep.
    [[nodiscard]] std::string whole_csv(const std::filesystem::path& folder) const;
};

} // namespace gnomon::store
