#pragma once

#include "scene/case/space.hpp"
#include "scene/job/source.hpp"
#include "scene/vec.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene {

/// Names of an image's channels: the first that exists counts. Vectors: the part before ".X".
struct ChannelNames {
    std::vector<std::string> shadow{"shadow.V"};
    std::vector<std::string> valid{"valid"};
    std::vector<std::string> position{"P"};
    std::vector<std::string> normal{"Ng"};
    std::vector<std::string> object{"id.geom"};
    std::vector<std::string> z_light{"z.light"};
    std::vector<std::string> z_map{"z.map"};
};

/// How to read an image's values.
struct ImageConventions {
    ChannelNames channels;
    std::optional<double> lit_above;   ///< the mask is light: above this it is lit
    std::optional<Vec3d> background{}; ///< the position of pixels that show nothing
    /// The mask's values for shadowed and lit, if they are not 0 and 1.
    std::optional<std::array<double, 2>> mask_range{};
    bool has_fractions = false; ///< mask values between are fractions, not rounding
    /// The lowest row comes first. Does not apply to .pfm files, whose format fixes the order.
    bool is_bottom_up = false;
};

/// A file of a case's image or map. EXR files name their channels; `channels` names those of a raw
/// file (.npy, .pfm).
struct CaseImageSource {
    std::string key; ///< the key of case.toml that names it: "files.position"
    std::filesystem::path path;
    std::vector<std::string> channels; ///< the contract's names, in the raw file's order
    std::size_t least = 0;             ///< how many of them a raw file must have
    bool is_raw_alone = false;         ///< EXR files are refused
};

/// Another renderer's case, read from its case.toml (docs/evaluate.md).
struct CaseFile {
    std::filesystem::path path; ///< of case.toml
    std::string text;           ///< its content
    std::string name;
    std::string renderer;
    std::vector<CaseImageSource> images; ///< at least one; `image` is the first, where it is given
    std::optional<CaseImageSource> map;  ///< of channel "map.d"
    ImageConventions conventions;
    CaseSpace space;
    std::map<std::string, std::uint32_t> object_numbers; ///< by name; empty: as in the mesh file
    std::optional<Vec3d> eye;                            ///< float32-representable [m]
    /// The settings that are keys of a job: mesh, roles, light, the whole camera, and the
    /// renderer's settings. The image size is not among them.
    JobSource source;

    /// Whether the case sets this key of a job.
    [[nodiscard]] bool says(std::string_view key) const
    {
        return std::ranges::any_of(
            source.file, [&](const Setting& setting) { return setting.spec->name == key; });
    }
    /// Whether the case sets any key of this table of a job: "light".
    [[nodiscard]] bool says_any(std::string_view table) const
    {
        const std::string prefix = std::string{table} + ".";
        return std::ranges::any_of(source.file, [&](const Setting& setting) {
            return setting.spec->name.starts_with(prefix);
        });
    }
};

/// Reads CASE: a folder with case.toml, or that file.
/// @param from  an exporter whose conventions apply where the file gives none; may be empty.
/// @throws InputError  "file:line: …", for unknown keys (naming the nearest), values out of range,
///                     missing and incompatible keys.
[[nodiscard]] CaseFile read_case_file(const std::filesystem::path& path, std::string_view from = {},
                                      Keys keys = own_keys());

/// Rewrites a message about a job's key in terms of the case: "case.toml: mesh.no_cast: …" for
/// "scene.no_cast: …". Returns other messages unchanged.
[[nodiscard]] std::string case_message(const CaseFile& file, std::string_view message);

} // namespace gnomon::scene
