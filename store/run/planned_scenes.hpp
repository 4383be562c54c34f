#pragma once

#include "analysis/results/results.hpp"
#include "store/sqlite.hpp"

#include <set>
#include <string>
#include <utility>

namespace gnomon::store {

/// The scenes of what a run's last plan has finished, by content and by name. A file that was
/// changed keeps its name, and one that was moved its content: both are still the run's scene.
class PlannedScenes {
public:
    explicit PlannedScenes(const sqlite::Database& database);

    /// True if the configuration is of one of them.
    [[nodiscard]] bool have(const analysis::Configuration& configuration) const;
    [[nodiscard]] bool empty() const { return names_.empty(); }
    /// One of them, for a message: `yard`, model.glb.
    [[nodiscard]] std::string example() const { return names_.begin()->second; }

private:
    std::set<std::string> hashes_;
    std::set<std::pair<std::string, std::string>> names_; ///< key and value
};

} // namespace gnomon::store
