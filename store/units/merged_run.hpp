#pragma once

#include "store/run/run_store.hpp"
#include "store/sqlite.hpp"
#include "store/units/unit_file.hpp"
#include "store/units/unit_plan.hpp"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace gnomon::store {

/// Whether configurations that failed, and may pass when they are tried again, count as computed.
enum class Failures : std::uint8_t { kept, tried_again };

/// A run that is put together of units as they come. What `take` returns from is on the disk; who
/// opens the run again goes on with it.
///
/// Every function throws as `RunStore` does.
class MergedRun {
public:
    /// Opens RUN, or makes it; the caller holds its lock.
    /// @param description  of the whole sweep; its environment and notes are the units'.
    /// @throws scene::InputError  if RUN holds another sweep.
    MergedRun(const std::filesystem::path& folder, const RunDescription& description,
              Environments environments, Failures failures = Failures::kept);

    /// Whether all of the unit's configurations have results, or failed and are not tried again.
    [[nodiscard]] bool has(const PlannedUnit& unit) const;

    /// Adds a unit's file.
    /// @param plan  the id of the plan that it is to be of.
    /// @throws sqlite::DamagedDatabase  if the file is not whole.
    /// @throws scene::InputError        if it is of another plan, or of another environment than
    ///                                  the run while that may have but one.
    UnitSummary take(const std::filesystem::path& file, const std::string& plan);

    /// How the sweep's configurations stand.
    [[nodiscard]] PlanOutcome outcome() const;
    [[nodiscard]] std::uint64_t retriable() const;
    [[nodiscard]] RunChecks checks() const;
    /// `RunStore::write_csv`
    void write_csv() const;

private:
    void require_same_sweep(const RunDescription& description) const;
    void read_known(Failures failures);
    void require_environment(const UnitSummary& unit, const std::filesystem::path& file) const;

    std::filesystem::path folder_;
    sqlite::Database database_;
    RunDescription description_;
    Environments environments_;
    std::vector<bool> is_known_; ///< by ordinal
};

} // namespace gnomon::store
