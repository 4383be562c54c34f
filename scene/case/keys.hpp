#pragma once

#include "scene/case/file.hpp"
#include "scene/job/value.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// The values of a case.toml, before they are resolved to a `CaseFile`.
struct CaseDraft {
    CaseFile file;
    bool has_schema = false;
    std::string up;
    std::string handedness;
    std::vector<std::string> axes;
    bool has_own_axes = false; ///< given by the file, not by an exporter
    double mesh_metres_per_unit = 1;
};

/// A key of case.toml that no job has.
struct CaseKey {
    std::string name; ///< "mesh.file"
    Domain domain;
    std::function<void(CaseDraft&, const JobValue&)> set;
};

[[nodiscard]] const std::vector<CaseKey>& case_keys();

/// Fills in an exporter's conventions where the case gives none.
/// @param exporter  one of `exporter_names`.
void apply_exporter(CaseDraft& draft, std::string_view exporter);

/// Three words like "x" and "-z" as axes; empty unless each of x, y and z occurs once.
[[nodiscard]] std::optional<std::array<CaseSpace::Axis, 3>>
axes_from_words(const std::vector<std::string>& words);

/// The axes of a space with this up axis and handedness, relative to a right-handed mesh with y up,
/// as exporters convert between them.
[[nodiscard]] std::vector<std::string> axes_of(std::string_view up, std::string_view handedness);

/// "blender", "falcor", "mitsuba", "unreal".
[[nodiscard]] const std::vector<std::string>& exporter_names();

} // namespace gnomon::scene
