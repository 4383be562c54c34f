#pragma once

#include "methods/bias_term.hpp"
#include "methods/filter_promises.hpp"
#include "methods/promises.hpp"
#include "scene/job/file.hpp"
#include "scene/job/job.hpp"

#include <cstdint>
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

/// What happens between the light's view of the geometry and a verdict, described.
struct Method {
    std::string_view name;
    std::string_view sentence; ///< what it does
    std::span<const Source> sources;
    std::string_view page;                        ///< of the documentation, in the checkout
    std::span<const std::string_view> key_tables; ///< of a job file, that are its own: "bias"
    std::span<const FilterPromises> filters;      ///< that a job can choose; empty: none
    std::span<const BiasTerm> bias_terms;         ///< that a job can set; empty: none
    /// What it promises of the lookups of a job.
    Promises (*promises)(const scene::Job& job) = nullptr;
    /// Memory that its map takes [bytes]; 0 without a map.
    std::uint64_t (*map_bytes)(const scene::ShadowMapSettings& map) = nullptr;
};

/// The rows of its keys in the key table, in their order.
[[nodiscard]] std::vector<scene::JobKey> keys_of(const Method& method);

/// What it promises of a job of defaults with this filter.
[[nodiscard]] Promises promises_with(const Method& method, scene::Filter filter);

} // namespace gnomon::methods
