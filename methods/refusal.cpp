#include "methods/refusal.hpp"

#include "methods/key_table.hpp"
#include "scene/error.hpp"
#include "scene/settings/job.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <variant>

namespace gnomon::methods {
namespace {

/// A value that differs from every key's default and lies in every number's domain.
scene::JobValue acting_value(const scene::Key& key)
{
    if (std::holds_alternative<scene::RealDomain>(key.domain)) {
        return 0.5;
    }
    if (const auto* domain = std::get_if<scene::WordDomain>(&key.domain)) {
        return std::string{domain->words.back()};
    }
    throw std::invalid_argument(
        fmt::format("refuses: {} takes neither numbers nor words", key.name));
}

/// The error with which term or method refuse a job; may be empty.
std::string refusal(const Method& method, const BiasTerm& term, const scene::Job& job)
{
    try {
        if (term.check != nullptr) {
            term.check(job, method.traits(job));
        }
        if (method.check != nullptr) {
            method.check(job);
        }
    } catch (const scene::InputError& error) {
        return error.what();
    }
    return {};
}

} // namespace

bool refuses(const Method& method, const BiasTerm& term)
{
    scene::Job job;
    job.keys = key_table();
    job.method.name = method.name;
    const std::string without = refusal(method, term, job); // e.g. a format that it cannot use
    if (term.own_keys != nullptr) {
        for (const scene::Key& key : term.own_keys()) {
            job.method.values[key.name] = acting_value(key);
        }
    }
    const std::string with = refusal(method, term, job);
    return !with.empty() && with != without;
}

} // namespace gnomon::methods
