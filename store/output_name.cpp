#include "store/output_name.hpp"

#include "scene/error.hpp"
#include "scene/one_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace gnomon::store {

namespace {

enum class Ending : std::uint8_t {
    is_chosen_from, ///< it must be there, and decides the format
    is_own_or_none,
    is_no_others,
};

struct KindOfOutput {
    OutputKind kind;
    std::string_view noun;
    std::array<std::string_view, 3> endings;
    Ending rule;
};

constexpr auto kinds_of_output = std::to_array<KindOfOutput>({
    {OutputKind::picture, "a picture", {".png"}, Ending::is_own_or_none},
    {OutputKind::layers, "an image of numbers", {".exr"}, Ending::is_own_or_none},
    {OutputKind::plot, "a plot", {".svg", ".png"}, Ending::is_chosen_from},
    {OutputKind::figure, "a figure", {".pdf", ".svg", ".png"}, Ending::is_chosen_from},
    {OutputKind::csv, "a table", {".csv"}, Ending::is_no_others},
    {OutputKind::junit, "a JUnit report", {".xml"}, Ending::is_no_others},
    {OutputKind::baseline, "a baseline", {".json"}, Ending::is_no_others},
    {OutputKind::job, "a job file", {".toml"}, Ending::is_own_or_none},
});

/// Of files that people have beside ours, and would not want to be replaced by a text.
constexpr auto foreign_endings = std::to_array<std::string_view>(
    {".jpg", ".jpeg", ".gif", ".tif", ".tiff", ".gltf", ".glb", ".obj", ".ply", ".sqlite"});

bool has_ending(const KindOfOutput& kind, std::string_view ending)
{
    return !ending.empty() && std::ranges::find(kind.endings, ending) != kind.endings.end();
}

bool is_others(std::string_view ending)
{
    return std::ranges::find(foreign_endings, ending) != foreign_endings.end() ||
           std::ranges::any_of(kinds_of_output,
                               [&](const KindOfOutput& kind) { return has_ending(kind, ending); });
}

bool may_end_so(const KindOfOutput& kind, std::string_view ending)
{
    if (has_ending(kind, ending)) {
        return true;
    }
    switch (kind.rule) {
    case Ending::is_chosen_from:
        return false;
    case Ending::is_own_or_none:
        return ending.empty();
    case Ending::is_no_others:
        return !is_others(ending);
    }
    return false; // unreachable: the switch names every enumerator
}

/// ".pdf, .svg or .png"
std::string endings_text(const KindOfOutput& kind)
{
    std::string text{kind.endings.front()};
    for (std::size_t i = 1; i < kind.endings.size() && !kind.endings[i].empty(); ++i) {
        const bool is_last = i + 1 == kind.endings.size() || kind.endings[i + 1].empty();
        text += fmt::format("{}{}", is_last ? " or " : ", ", kind.endings[i]);
    }
    return text;
}

} // namespace

void require_output_name(const std::filesystem::path& path, OutputKind kind)
{
    const auto* const found = std::ranges::find(kinds_of_output, kind, &KindOfOutput::kind);
    const std::string ending = path.extension().string();
    if (!may_end_so(*found, ending)) {
        throw scene::InputError(fmt::format("{}: {} is written as {}; name it so",
                                            scene::one_line(path.string()), found->noun,
                                            endings_text(*found)));
    }
}

} // namespace gnomon::store
