#pragma once

#include "methods/bias_term.hpp"
#include "methods/lookup_traits.hpp"
#include "methods/passes.hpp"
#include "scene/job/file.hpp"
#include "scene/job/keys/key.hpp"
#include "scene/settings/filter.hpp"
#include "scene/settings/job.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace gnomon::methods {

/// The first publication of a method or a part of it.
struct Source {
    std::string_view authors;
    int year = 0;
    std::string_view title;
    std::string_view about; ///< the part of the method; empty: the whole method
};

/// A value of lookup.filter, with a description.
struct FilterChoice {
    scene::Filter filter = scene::Filter::nearest;
    std::string_view sentence;
};

/// The description of a shadow method: everything between the light's view and a verdict.
struct Method {
    std::string_view name;
    std::string_view sentence; ///< description
    std::span<const Source> sources;
    std::string_view page;                        ///< path of its documentation
    std::span<const std::string_view> key_tables; ///< tables of a job file that it reads: "bias"
    std::vector<scene::Key> keys;                 ///< its own keys: "method.…"
    std::span<const FilterChoice> filters;        ///< supported filters; may be empty
    std::span<const BiasTerm> bias_terms;         ///< supported bias terms; may be empty
    /// The traits of a job's lookups.
    LookupTraits (*traits)(const scene::Job& job) = nullptr;
    /// The GL passes of a job.
    Passes (*passes)(const scene::Job& job) = nullptr;
    /// Throws `scene::InputError` for incompatible settings; nullptr if all are compatible.
    void (*check)(const scene::Job& job) = nullptr;
};

/// The method's own keys and those of its bias terms.
[[nodiscard]] std::vector<scene::Key> own_keys(const Method& method);

/// The method's keys in the key table, in order: those of its tables, and its own.
[[nodiscard]] std::vector<scene::Key> keys_of(const Method& method);

/// The traits of a default job with this filter.
[[nodiscard]] LookupTraits traits_with(const Method& method, scene::Filter filter);

} // namespace gnomon::methods
