#include "scene/import/ply.hpp"

#include "scene/import/gltf_facts.hpp"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::scene {

namespace {

/// Longer lines are not part of a header.
constexpr std::size_t longest_header_line = 4096;

struct PlyProperty {
    std::size_t bytes = 0;       ///< of one value; 0: unknown type
    std::size_t count_bytes = 0; ///< of a list's count; 0: not a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyFormat : std::uint8_t { unknown, ascii, little_endian, big_endian };

struct PlyHeader {
    PlyFormat format = PlyFormat::unknown;
    std::vector<PlyElement> elements;
    /// The lines of format, elements and properties, with single spaces.
    std::vector<std::string> lines;
    std::uint64_t bytes = 0; ///< up to the data
};

std::size_t value_bytes(std::string_view type)
{
    constexpr std::array<std::pair<std::string_view, std::size_t>, 16> types{{
        {"char", 1},
        {"int8", 1},
        {"uchar", 1},
        {"uint8", 1},
        {"short", 2},
        {"int16", 2},
        {"ushort", 2},
        {"uint16", 2},
        {"int", 4},
        {"int32", 4},
        {"uint", 4},
        {"uint32", 4},
        {"float", 4},
        {"float32", 4},
        {"double", 8},
        {"float64", 8},
    }};
    const auto* found =
        std::ranges::find(types, type, &std::pair<std::string_view, std::size_t>::first);
    return found == types.end() ? 0 : found->second;
}

PlyFormat named_format(std::string_view name)
{
    return name == "ascii"                  ? PlyFormat::ascii
           : name == "binary_little_endian" ? PlyFormat::little_endian
           : name == "binary_big_endian"    ? PlyFormat::big_endian
                                            : PlyFormat::unknown;
}

PlyProperty read_property(std::istream& words)
{
    std::string type;
    words >> type;
    if (type != "list") {
        return {.bytes = value_bytes(type)};
    }
    std::string count_type;
    words >> count_type >> type;
    const std::size_t count_bytes = value_bytes(count_type);
    return {.bytes = count_bytes == 0 ? 0 : value_bytes(type), .count_bytes = count_bytes};
}

/// A header line with single spaces between words.
std::string text_of(const char* line)
{
    std::istringstream words{line};
    std::string text;
    for (std::string word; words >> word;) {
        text += (text.empty() ? "" : " ") + word;
    }
    return text;
}

/// Reads up to and including the line `end_header`. Without that line the format is unknown.
PlyHeader read_header(std::istream& file)
{
    PlyHeader header;
    std::string line(longest_header_line, '\0');
    while (file.getline(line.data(), static_cast<std::streamsize>(line.size()))) {
        std::istringstream words{line.c_str()};
        std::string word;
        std::string name;
        words >> word;
        if (word == "end_header") {
            header.bytes = static_cast<std::uint64_t>(file.tellg());
            return header;
        }
        if (word == "format" || word == "element" || word == "property") {
            header.lines.push_back(text_of(line.c_str()));
        }
        if (word == "format" && words >> name) {
            header.format = named_format(name);
        } else if (word == "element") {
            PlyElement element;
            words >> element.name >> element.count;
            header.elements.push_back(std::move(element));
        } else if (word == "property" && !header.elements.empty()) {
            header.elements.back().properties.push_back(read_property(words));
        }
    }
    header.format = PlyFormat::unknown;
    return header;
}

/// The number of elements of this name in the header.
std::uint64_t announced(const PlyHeader& header, std::string_view element)
{
    const auto found = std::ranges::find(header.elements, element, &PlyElement::name);
    return found == header.elements.end() ? 0 : found->count;
}

/// Assimp reads one line per element and ignores the rest of the line.
void require_lines(std::istream& file, const PlyHeader& header)
{
    std::uint64_t lines = 0;
    std::string line;
    while (std::getline(file, line)) {
        const std::size_t first = line.find_first_not_of(" \t\r");
        lines += first != std::string::npos && !line.substr(first).starts_with("comment") ? 1U : 0U;
    }
    std::uint64_t left = lines;
    for (const PlyElement& element : header.elements) {
        if (element.count > left) {
            throw std::runtime_error{fmt::format(
                "{} of {} \"{}\" lines are there: it is cut off, or several elements share a line",
                left, element.count, element.name)};
        }
        left -= element.count;
    }
}

/// The next value as an unsigned number, so that a negative count becomes huge.
std::uint64_t read_count(std::istream& file, std::size_t bytes, PlyFormat format)
{
    std::array<char, 8> read{};
    file.read(read.data(), static_cast<std::streamsize>(bytes));
    if (format == PlyFormat::big_endian) {
        std::reverse(read.begin(), read.begin() + static_cast<std::ptrdiff_t>(bytes));
    }
    static_assert(std::endian::native == std::endian::little);
    return std::bit_cast<std::uint64_t>(read);
}

/// Skips `count` values.
/// @return  whether the file had them.
bool skip_values(std::istream& file, std::uint64_t count, std::size_t bytes)
{
    constexpr auto longest =
        static_cast<std::uint64_t>(std::numeric_limits<std::streamsize>::max());
    if (count > longest / bytes) {
        return false;
    }
    const auto length = static_cast<std::streamsize>(count * bytes);
    file.ignore(length);
    return file.gcount() == length;
}

/// Skips one element. @return  whether the file had it.
bool skip_element(std::istream& file, const PlyElement& element, PlyFormat format)
{
    return std::ranges::all_of(element.properties, [&](const PlyProperty& property) {
        std::uint64_t count = 1;
        if (property.count_bytes > 0) {
            count = read_count(file, property.count_bytes, format);
        }
        return file.good() && skip_values(file, count, property.bytes);
    });
}

void require_bytes(std::istream& file, const PlyHeader& header)
{
    for (const PlyElement& element : header.elements) {
        if (element.properties.empty()) {
            continue;
        }
        for (std::uint64_t i = 0; i < element.count; ++i) {
            if (!skip_element(file, element, header.format)) {
                throw std::runtime_error{
                    fmt::format("it is cut off: {} of {} \"{}\" elements are there", i,
                                element.count, element.name)};
            }
        }
    }
}

bool has_known_types(const PlyHeader& header)
{
    return std::ranges::all_of(header.elements, [](const PlyElement& element) {
        return std::ranges::all_of(element.properties,
                                   [](const PlyProperty& property) { return property.bytes > 0; });
    });
}

/// An element's line, renamed to an element that Assimp knows.
std::string known_element(const std::string& line)
{
    constexpr std::array<std::string_view, 4> known{"vertex", "face", "edge", "material"};
    std::istringstream words{line};
    std::string name;
    std::string count;
    words >> name >> name >> count;
    return fmt::format("element {} {}",
                       std::ranges::find(known, name) != known.end() ? name : "edge", count);
}

} // namespace

FileHead head_for_assimp(const std::filesystem::path& ply_file)
{
    std::ifstream file{ply_file, std::ios::binary};
    const PlyHeader header = read_header(file);
    if (header.format == PlyFormat::unknown || header.format == PlyFormat::ascii ||
        !has_known_types(header)) {
        return {};
    }
    FileHead head{"ply\n", header.bytes};
    bool has_begun = false;
    for (const std::string& line : header.lines) {
        const bool is_element = line.starts_with("element ");
        if (is_element && !has_begun) {
            head.text += "element edge 1\nproperty uchar begin\n";
            has_begun = true;
        }
        head.text += (is_element ? known_element(line) : line) + '\n';
    }
    head.text += "end_header\n";
    if (has_begun) {
        head.text += '\1'; // the edge's one byte: no line end
    }
    return head;
}

void require_whole_ply(const std::filesystem::path& ply_file)
{
    std::ifstream file{ply_file, std::ios::binary};
    const PlyHeader header = read_header(file);
    if (announced(header, "tristrips") > 0) {
        throw UnsupportedContent{"it has triangle strips (element tristrips), which are not "
                                 "supported; export faces instead"};
    }
    if (header.format == PlyFormat::ascii) {
        require_lines(file, header);
    } else if (header.format != PlyFormat::unknown && has_known_types(header)) {
        require_bytes(file, header);
    }
}

void require_ply_faces(const std::filesystem::path& ply_file, const aiScene& scene)
{
    std::ifstream file{ply_file, std::ios::binary};
    const std::uint64_t faces = announced(read_header(file), "face");
    std::uint64_t read = 0;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        read += scene.mMeshes[m]->mNumFaces;
    }
    if (read < faces) {
        throw std::runtime_error{
            fmt::format("{} of its {} faces could not be read", faces - read, faces)};
    }
}

} // namespace gnomon::scene
