#pragma once

#include "scene/error.hpp"
#include "scene/import/load_scene_file.hpp"
#include "scene/import/scene_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

namespace gnomon::scene::test {

/// A folder that is removed when the test ends.
class TemporaryFolder {
public:
    TemporaryFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "gnomon-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) {
            throw std::runtime_error{"mkdtemp failed"};
        }
        path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, std::string_view contents) const
    {
        std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream{file, std::ios::binary} << contents;
        return file;
    }

private:
    std::filesystem::path path_;
};

/// The message of the InputError when loading; fails the test and returns an empty text if there is
/// none.
inline std::string file_refusal(const std::filesystem::path& file, const ImportLimits& limits = {})
{
    try {
        (void)load_scene_file(file, limits);
    } catch (const InputError& error) {
        EXPECT_EQ(std::string_view{error.what()}.find('\n'), std::string_view::npos);
        return error.what();
    }
    ADD_FAILURE() << file << " was accepted";
    return {};
}

template <typename T, std::size_t count>
std::string bytes_of(const std::array<T, count>& values)
{
    std::string bytes(sizeof(values), '\0');
    std::memcpy(bytes.data(), values.data(), sizeof(values));
    return bytes;
}

inline std::string base64(std::string_view bytes)
{
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            word =
                word << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63U] : '=';
        }
    }
    return text;
}

using QuadCorners = std::array<float, 12>;
inline constexpr QuadCorners unit_quad{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
using QuadIndices = std::array<std::uint16_t, 6>;
inline constexpr QuadIndices quad_indices{0, 1, 2, 0, 2, 3};

/// The 60 bytes of a quad: indices, then corners.
inline std::string quad_buffer(const QuadCorners& corners = unit_quad,
                               const QuadIndices& indices = quad_indices)
{
    return bytes_of(indices) + bytes_of(corners);
}

/// A glTF 2.0 document around one quad mesh (mesh 0) that faces +z.
/// @param nodes   JSON array of nodes, all of them roots unless `roots` says otherwise.
/// @param more    further top-level members, each followed by a comma.
/// @param buffer  members of the buffer besides its length, each followed by a comma.
struct QuadGltf {
    std::string nodes = R"([{"name":"quad","mesh":0}])";
    std::string roots = "[0]";
    std::string more;
    std::string buffer =
        fmt::format(R"("uri":"data:application/octet-stream;base64,{}",)", base64(quad_buffer()));

    [[nodiscard]] std::string text() const
    {
        return fmt::format(
            R"({{"asset":{{"version":"2.0"}},{}"scene":0,"scenes":[{{"nodes":{}}}],"nodes":{},)"
            R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":1}},"indices":0}}]}}],)"
            R"("accessors":[{{"bufferView":0,"componentType":5123,"count":6,"type":"SCALAR"}},)"
            R"({{"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"}}],)"
            R"("bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":12}},)"
            R"({{"buffer":0,"byteOffset":12,"byteLength":48}}],)"
            R"("buffers":[{{{}"byteLength":60}}]}})",
            more, roots, nodes, buffer);
    }
    /// The same document as .glb, its buffer in the binary chunk.
    [[nodiscard]] std::string binary() const
    {
        QuadGltf inner = *this;
        inner.buffer.clear();
        std::string json = inner.text();
        json.append((4 - json.size() % 4) % 4, ' ');
        const auto chunk = [](const std::string& bytes, std::uint32_t type) {
            return bytes_of(std::array{static_cast<std::uint32_t>(bytes.size()), type}) + bytes;
        };
        const std::string body = chunk(json, 0x4E4F534A) + chunk(quad_buffer(), 0x004E4942);
        const auto length = static_cast<std::uint32_t>(12 + body.size());
        return bytes_of(std::array<std::uint32_t, 3>{0x46546C67, 2, length}) + body;
    }
};

inline std::string refusal_of(const std::string& name, const std::string& contents)
{
    const TemporaryFolder folder;
    return file_refusal(folder.write(name, contents));
}

/// The quad, with a mesh of these primitives in place of its own.
inline std::string with_primitives(QuadGltf gltf, const std::string& primitives)
{
    const std::string own = R"([{"attributes":{"POSITION":1},"indices":0}])";
    std::string text = gltf.text();
    return text.replace(text.find(own), own.size(), primitives);
}

} // namespace gnomon::scene::test
