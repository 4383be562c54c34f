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

/// Where a method, or a part of it, was published first.
struct Source {
    std::string_view authors;
    int year = 0;
    std::string_view title;
    std::string_view about; ///< the part of the method; empty: all of it
};

/// A value of lookup.filter that a job can choose, and what it computes.
struct FilterChoice {
    scene::Filter filter = scene::Filter::nearest;
    std::string_view sentence;
};

/// What happens between the light's view of the geometry and a verdict, described.
struct Method {
    std::string_view name;
    std::string_view sentence; ///< what it does
    std::span<const Source> sources;
    std::string_view page;                        ///< of the documentation, in the checkout
    std::span<const std::string_view> key_tables; ///< of a job file, that it reads: "bias"
    std::vector<scene::Key> keys;                 ///< its own: "method.…"
    std::span<const FilterChoice> filters;        ///< that a job can choose; empty: none
    std::span<const BiasTerm> bias_terms;         ///< that a job can set; empty: none
    /// What it promises of the lookups of a job.
    LookupTraits (*traits)(const scene::Job& job) = nullptr;
    /// What GL is to do for a job.
    Passes (*passes)(const scene::Job& job) = nullptr;
    /// Refuses a job whose settings do not go together, by `scene::InputError`; nullptr: all do.
    void (*check)(const scene::Job& job) = nullptr;
};

/// The keys that the method has of its own, and those of its bias terms.
[[nodiscard]] std::vector<scene::Key> own_keys(const Method& method);

/// The rows of its keys in the key table, in their order: of its tables, and its own.
[[nodiscard]] std::vector<scene::Key> keys_of(const Method& method);

/// What it promises of a job of defaults with this filter.
[[nodiscard]] LookupTraits traits_with(const Method& method, scene::Filter filter);

} // namespace gnomon::methods
