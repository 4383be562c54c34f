#pragma once

#include "scene/error.hpp"

#include <memory>
#include <stdexcept>
#include <string>

namespace gnomon::analysis {

/// What a stage made, or why it could not.
template <typename Value>
struct Made {
    std::shared_ptr<Value> value;
    std::string error; ///< empty: `value` is there
};

/// Why work that needs a result cannot be done; thrown with the words of whatever failed first.
struct StageFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <typename Value>
std::shared_ptr<Value> need(const Made<Value>& made)
{
    if (!made.value) {
        throw StageFailed{made.error.empty() ? "an earlier stage did not run" : made.error};
    }
    return made.value;
}

/// Runs a stage; what concerns the configuration alone becomes its result.
template <typename Value, typename Stage>
Made<Value> make(const Stage& stage)
{
    try {
        return {stage(), {}};
    } catch (const StageFailed& error) {
        return {nullptr, error.what()};
    } catch (const scene::InputError& error) {
        return {nullptr, error.what()};
    } catch (const scene::EnvironmentError& error) {
        return {nullptr, error.what()};
    }
}

} // namespace gnomon::analysis
