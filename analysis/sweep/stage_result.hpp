#pragma once

#include "analysis/results/results.hpp"
#include "scene/error.hpp"

#include <memory>
#include <stdexcept>
#include <string>

namespace gnomon::analysis {

/// What a stage computed, or why it could not.
template <typename Value>
struct StageResult {
    std::shared_ptr<Value> value;
    std::string error; ///< empty: `value` is there
    Retry retry = Retry::may_help;
};

/// Why work that needs a result cannot be done; thrown with the words of whatever failed first.
struct StageFailed : std::runtime_error {
    StageFailed(const std::string& message, Retry again) : std::runtime_error{message}, retry{again}
    {
    }
    Retry retry;
};

/// @return the stage's value, not null.
/// @throws StageFailed  if it has none.
template <typename Value>
std::shared_ptr<Value> require_result(const StageResult<Value>& result)
{
    if (!result.value) {
        throw StageFailed{result.error.empty() ? "an earlier stage did not run" : result.error,
                          result.retry};
    }
    return result.value;
}

/// Runs a stage; what concerns the configuration alone becomes its result.
template <typename Value, typename Stage>
StageResult<Value> run_stage(const Stage& stage)
{
    try {
        return {stage(), {}, {}};
    } catch (const StageFailed& error) {
        return {nullptr, error.what(), error.retry};
    } catch (const scene::InputError& error) {
        return {nullptr, error.what(), Retry::is_useless};
    } catch (const scene::EnvironmentError& error) {
        return {nullptr, error.what(), Retry::may_help};
    }
}

} // namespace gnomon::analysis
