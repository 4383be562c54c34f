#pragma once

#include "scene/geometry/triangles.hpp"
#include "scene/vec.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gnomon::scene {

/// The outcome of an import, as the child process reports it.
enum class ImportOutcome : std::uint64_t {
    scene = 1,       ///< a header, the names of extensions, `light_count` lights, the objects
    refusal = 2,     ///< a header, then a text up to the end
    unsupported = 3, ///< likewise; the text includes a remedy
};

/// A camera in world space, looking along `forward`.
struct ImportedCamera {
    Vec3d eye;                   ///< [m]
    Vec3d forward;               ///< any length
    Vec3d up;                    ///< any length
    double vertical_fov_rad = 0; ///< 0: orthographic
    double orthographic_height_m = 0;
};

/// A light in world space, shining along `direction`; precedes its name, padded to 8 bytes.
struct ImportedLight {
    Vec3d position;            ///< [m]; spot, point
    Vec3d direction;           ///< any length
    double outer_cone_rad = 0; ///< half the opening angle; 0: directional, or a point light
    std::uint64_t is_point = 0;
    std::uint64_t name_bytes = 0;
};

inline constexpr std::uint64_t import_magic = 0x31'6e'6f'6d'6f'6e'67ULL;

/// The first bytes of the import stream. Plain data that the reader must not trust.
struct ImportHeader {
    std::uint64_t magic = import_magic;
    ImportOutcome outcome = ImportOutcome::scene;
    std::uint64_t object_count = 0;
    std::uint64_t ignored_primitives = 0;
    std::uint64_t has_camera = 0;
    std::uint64_t light_count = 0;
    ContentCounts contents;
    std::uint64_t extension_bytes = 0; ///< names of unsupported ones, each with a line feed
    ImportedCamera camera;
};

/// Precedes the name, the vertices, the triangles and their corners' normals of one object, each
/// padded to 8 bytes.
struct ImportedObject {
    std::uint64_t name_bytes = 0;
    std::uint64_t vertex_count = 0;
    std::uint64_t triangle_count = 0;
    std::uint64_t normal_count = 0; ///< 0, or three for each triangle
};

using TriangleIndices = std::array<std::uint32_t, 3>;

static_assert(std::is_trivially_copyable_v<ImportHeader> && sizeof(ImportHeader) % 8 == 0);
static_assert(std::is_trivially_copyable_v<ImportedObject> && sizeof(ImportedObject) % 8 == 0);
static_assert(std::is_trivially_copyable_v<ImportedLight> && sizeof(ImportedLight) % 8 == 0);
static_assert(sizeof(Vec3d) == 24 && sizeof(TriangleIndices) == 12);

/// Writes the stream to a file descriptor, in blocks.
class ImportWriter {
public:
    explicit ImportWriter(int fd) : fd_{fd} {}

    template <typename T>
    void put(const T& value)
    {
        put_bytes(std::as_bytes(std::span{&value, 1}));
    }
    template <typename T>
    void put_array(std::span<const T> values)
    {
        put_bytes(std::as_bytes(values));
    }
    /// @throws std::runtime_error  if the descriptor does not take the bytes.
    void flush();

private:
    void put_bytes(std::span<const std::byte> bytes);

    int fd_;
    std::vector<std::byte> block_;
};

/// The stream is inconsistent, so it cannot be used.
class CorruptStream : public std::runtime_error {
public:
    CorruptStream() : std::runtime_error{"the importer returned contradictory data"} {}
};

/// Reads the stream in place; every length is checked against what is left.
class ImportReader {
public:
    /// @param bytes  aligned to 8, and unchanging.
    explicit ImportReader(std::span<const std::byte> bytes) : rest_{bytes} {}

    template <typename T>
    [[nodiscard]] const T& take()
    {
        return take_array<T>(1).front();
    }
    /// @throws CorruptStream  if fewer than `count` values are left.
    template <typename T>
    [[nodiscard]] std::span<const T> take_array(std::uint64_t count)
    {
        static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 8);
        if (count > rest_.size() / sizeof(T)) {
            throw CorruptStream{};
        }
        const auto* first = reinterpret_cast<const T*>(rest_.data());
        skip(count * sizeof(T));
        return {first, static_cast<std::size_t>(count)};
    }
    [[nodiscard]] std::string_view take_text(std::uint64_t byte_count)
    {
        const auto text = take_array<char>(byte_count);
        return {text.data(), text.size()};
    }
    [[nodiscard]] std::uint64_t bytes_left() const { return rest_.size(); }

private:
    void skip(std::uint64_t byte_count);

    std::span<const std::byte> rest_;
};

} // namespace gnomon::scene
