#pragma once

#include "scene/case/space.hpp"
#include "scene/job/source.hpp"
#include "scene/vec.hpp"

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

/// Names of an image's channels: the first that exists counts; of a vector the part before ".X".
struct ChannelNames {
    std::vector<std::string> shadow{"shadow.V"};
    std::vector<std::string> valid{"valid"};
    std::vector<std::string> position{"P"};
    std::vector<std::string> normal{"Ng"};
    std::vector<std::string> object{"id.geom"};
    std::vector<std::string> z_light{"z.light"};
    std::vector<std::string> z_map{"z.map"};
};

/// How an image's values are to be read, beside the channels' names.
struct ImageConventions {
    ChannelNames channels;
    std::optional<double> lit_above;   ///< the mask is light: above this it is lit
    std::optional<Vec3d> background{}; ///< the position of pixels that show nothing
    /// What the mask's values for shadowed and for lit are, where they are not 0 and 1.
    std::optional<std::array<double, 2>> mask_range{};
    bool has_fractions = false; ///< fractions of the mask are meant
    /// The lowest row comes first, but in .pfm files, which have an order of their own.
    bool is_bottom_up = false;
};

/// A file of a case's image, or of its map. An EXR file names its channels itself; what those of a
/// raw file (.npy, .pfm) are called is said here.
struct CaseImageSource {
    std::string key; ///< of case.toml, that names it: "files.position"
    std::filesystem::path path;
    std::vector<std::string> channels; ///< the contract's names, in the raw file's order
    std::size_t least = 0;             ///< A raw file must have so many of them.
    bool is_raw_alone = false;         ///< EXR files are refused
};

/// Another renderer's case, as its case.toml says it (docs/evaluate.md).
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
    /// What goes by a job's keys: mesh, roles, light, the whole camera, and the renderer's
    /// settings. The image's size is not among them.
    JobSource source;

    /// True if that key of a job is given.
    [[nodiscard]] bool says(std::string_view key) const;
    /// True if a key of that table of a job is given.
    [[nodiscard]] bool says_any(std::string_view table) const;
};

} // namespace gnomon::scene
