#pragma once

#include "analysis/tune/method_tune.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace gnomon::cli {

/// Over which methods a search goes: --methods, --max-bytes.
struct MethodsOption {
    std::string names; ///< "NAME,NAME" or "all"; empty: over none but the job's own
    std::optional<std::uint64_t> max_bytes;
};

void add_methods_option(CLI::App& command, MethodsOption& options);

/// What the options ask for; empty: no search over methods.
/// @throws scene::InputError  for a name that is none, and for --max-bytes without --methods.
[[nodiscard]] std::optional<analysis::MethodRequest> method_request(const MethodsOption& options);

/// Tells on stderr how large the search is, then each method as it begins, or, where it is verbose,
/// every setting.
/// @param heading  To begin lines with: "gnomon tune: ".
[[nodiscard]] analysis::MethodProgress method_progress(std::string heading, bool is_verbose);

} // namespace gnomon::cli
