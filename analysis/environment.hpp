#pragma once

#include <string>
#include <string_view>

namespace gnomon::analysis {

/// What computed a result; part of every result.
struct Environment {
    std::string gl_renderer;
    std::string gl_version;
    std::string embree;
    std::string gnomon;

    /// Stands for GL's version where a case says what drew its mask.
    static constexpr std::string_view other_renderer = "another renderer";
    [[nodiscard]] bool is_of_gl() const { return gl_version != other_renderer; }
};

} // namespace gnomon::analysis
