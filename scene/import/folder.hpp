#pragma once

#include <assimp/IOSystem.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace gnomon::scene {

/// Replaces a file's first bytes for an importer.
struct FileHead {
    std::string text;
    std::uint64_t replaced_bytes = 0;
};

/// The files that an importer may open: the scene file, and regular files in its folder or below.
///
/// Links and `..` are resolved first. If a percent-encoded name (`my%20mesh.bin`, as in glTF) does
/// not exist, the decoded name is tried.
class ImportFolder final : public Assimp::IOSystem {
public:
    /// @param scene_file  absolute path; may be a link that leads elsewhere.
    /// @param on_open     called with the size of every file that is opened [bytes].
    ImportFolder(std::filesystem::path scene_file, std::function<void(std::uint64_t)> on_open);

    bool Exists(const char* name) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* name, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

    /// Makes the scene file begin with `head`.
    void replace_head(FileHead head) { head_ = std::move(head); }

    /// The first name that pointed outside the folder; empty if none did.
    [[nodiscard]] const std::string& refused_name() const { return refused_name_; }

private:
    [[nodiscard]] std::optional<std::filesystem::path> find(const char* name) const;
    [[nodiscard]] bool is_beneath(const std::filesystem::path& canonical) const;

    std::filesystem::path scene_file_;
    std::filesystem::path folder_;
    std::function<void(std::uint64_t)> on_open_;
    FileHead head_; ///< of the scene file
    mutable std::string refused_name_;
};

} // namespace gnomon::scene
