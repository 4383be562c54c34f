#pragma once

#include "store/run/run_store.hpp"
#include "store/sqlite.hpp"
#include "store/units/unit_file.hpp"
#include "store/units/unit_plan.hpp"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace gnomon::store {

/// Whether retriable failed configurations count as computed.
enum class Failures : std::uint8_t { kept, tried_again };

/// A run that grows by one unit at a time. Data is on the disk when `take` returns; opening the run
/// again continues it.
///
/// Every function throws as `RunStore` does.
class MergedRun {
public:
    /// Opens or creates RUN; the caller holds its lock.
    /// @param description  of the whole sweep; environment and notes come from the units.
    /// @throws scene::InputError  if RUN holds another sweep.
    MergedRun(const std::filesystem::path& folder, const RunDescription& description,
              Environments environments, Failures failures = Failures::kept);

    /// Whether all of the unit's configurations have results, or failed and are not tried again.
    [[nodiscard]] bool has(const PlannedUnit& unit) const;

    /// Adds a unit file.
    /// @param plan  id of the plan that the unit must belong to.
    /// @throws sqlite::DamagedDatabase  if the file is incomplete.
    /// @throws scene::InputError        if the unit belongs to another plan, or comes from another
    ///                                  environment and that is not allowed.
    UnitSummary take(const std::filesystem::path& file, const std::string& plan);

    /// The sweep's configurations by state.
    [[nodiscard]] PlanOutcome outcome() const;
    [[nodiscard]] std::uint64_t retriable() const;
    [[nodiscard]] RunChecks checks() const;
    /// As `RunStore::write_csv`.
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
