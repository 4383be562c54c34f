#include "reports/run/error_parts_json.hpp"

#include "scene/error.hpp"
#include "scene/job_toml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

namespace gnomon::reports {

namespace {

using analysis::Cause;
using analysis::ErrorPart;
using analysis::Label;
using analysis::WrongCount;
using analysis::ZetaBand;

/// Every integer up to here is a double.
constexpr std::uint64_t most_pixels = std::uint64_t{1} << 53U;

std::string wrong_text(const WrongCount& wrong)
{
    return fmt::format("{}.{}.{}", wrong.is_false_lit ? "false_lit" : "false_shadow",
                       analysis::cause_names[static_cast<std::size_t>(wrong.cause)],
                       analysis::label_names[static_cast<std::size_t>(wrong.label)]);
}

/// Every kind of wrong pixel by its name.
const std::map<std::string, WrongCount, std::less<>>& wrong_by_name()
{
    static const auto by_name = [] {
        std::map<std::string, WrongCount, std::less<>> all;
        for (const bool is_false_lit : {false, true}) {
            for (std::size_t cause = 1; cause < analysis::cause_names.size(); ++cause) {
                for (std::size_t label = 1; label < analysis::label_names.size(); ++label) {
                    const WrongCount kind{is_false_lit, static_cast<Cause>(cause),
                                          static_cast<Label>(label), 0};
                    all.emplace(wrong_text(kind), kind);
                }
            }
        }
        return all;
    }();
    return by_name;
}

[[noreturn]] void refuse_part(const std::string& place, std::string_view problem)
{
    throw scene::InputError(fmt::format("{}: {}", scene::one_line(place.substr(0, 200)), problem));
}

std::uint64_t pixel_count(const Json& json, const std::string& place)
{
    if (!json.is_number_unsigned() || json.get<std::uint64_t>() > most_pixels) {
        refuse_part(place, "is no count of pixels");
    }
    return json.get<std::uint64_t>();
}

void read_count(ErrorPart& part, const std::string& name, std::uint64_t pixels,
                const std::string& place)
{
    if (name == "lit") {
        part.lit = pixels;
        return;
    }
    if (name == "blocked") {
        part.blocked = pixels;
        return;
    }
    const auto kind = wrong_by_name().find(name);
    if (kind == wrong_by_name().end()) {
        refuse_part(place, "is no kind of pixel");
    }
    WrongCount wrong = kind->second;
    wrong.pixels = pixels;
    part.wrong.push_back(wrong);
}

ErrorPart part_from_json(const Json& json, const std::string& place)
{
    if (!json.is_object() || !json.contains("lit") || !json.contains("blocked")) {
        refuse_part(place, "is no object with \"lit\" and \"blocked\"");
    }
    ErrorPart part;
    for (const auto& [name, value] : json.items()) {
        const std::string there = fmt::format("{}.{}", place, name);
        read_count(part, name, pixel_count(value, there), there);
    }
    std::sort(part.wrong.begin(), part.wrong.end(), [](const WrongCount& a, const WrongCount& b) {
        return std::tie(a.is_false_lit, a.cause, a.label) <
               std::tie(b.is_false_lit, b.cause, b.label);
    });
    return part;
}

} // namespace

std::string band_text(ZetaBand band)
{
    return fmt::format("[{}, {})", band.lower_m(), band.upper_m());
}

std::optional<ZetaBand> band_from_text(std::string_view text)
{
    static const auto bands = [] {
        std::map<std::string, ZetaBand, std::less<>> all;
        for (int place = ZetaBand::lowest; place <= ZetaBand::highest; ++place) {
            all.emplace(band_text({place}), ZetaBand{place});
        }
        return all;
    }();
    const auto found = bands.find(text);
    return found == bands.end() ? std::nullopt : std::optional{found->second};
}

Json parts_json(const std::vector<ErrorPart>& parts)
{
    Json json = Json::object();
    for (const ErrorPart& part : parts) {
        Json counts{{"blocked", part.blocked}, {"lit", part.lit}};
        for (const WrongCount& wrong : part.wrong) {
            counts[wrong_text(wrong)] = wrong.pixels;
        }
        json[part.object][band_text(part.band)] = std::move(counts);
    }
    return json;
}

std::vector<ErrorPart> parts_from_json(const Json& json, const std::string& place)
{
    if (!json.is_object()) {
        refuse_part(place, "is no object");
    }
    std::vector<ErrorPart> parts;
    for (const auto& [object, bands] : json.items()) {
        const std::string of_object = fmt::format("{}.{}", place, object);
        if (!bands.is_object() || bands.empty()) {
            refuse_part(of_object, "is no object with bands of light distance");
        }
        for (const auto& [name, counts] : bands.items()) {
            const std::string there = fmt::format("{}.{}", of_object, name);
            const auto band = band_from_text(name);
            if (!band) {
                refuse_part(there, "is no band of light distance");
            }
            parts.push_back(part_from_json(counts, there));
            parts.back().object = object;
            parts.back().band = *band;
        }
    }
    std::sort(parts.begin(), parts.end(), [](const ErrorPart& a, const ErrorPart& b) {
        return std::tie(a.object, a.band) < std::tie(b.object, b.band);
    });
    return parts;
}

} // namespace gnomon::reports
