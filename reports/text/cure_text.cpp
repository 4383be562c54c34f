#include "reports/text/error_text.hpp"

#include "analysis/advice/cures.hpp"
#include "analysis/advice/remedies.hpp"
#include "analysis/pixels/statistics.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::reports {

std::string share_of(double part, double whole)
{
    const double percent = 100.0 * part / whole;
    if (part != whole && percent > 99) {
        return "over 99 %";
    }
    return percent < 1 ? "under 1 %" : fmt::format("{:.0f} %", percent);
}

namespace {

using analysis::Cause;
using scene::PixelClass;

} // namespace

std::string_view cause_text(Cause cause, bool has_map)
{
    switch (cause) {
    case Cause::bias:
        return "the bias";
    case Cause::precision:
        return has_map ? "the precision of depths" : "the precision of positions and depths";
    case Cause::resolution:
        return "the map's resolution";
    case Cause::coverage:
        return has_map ? "what the map does not cover"
                       : "triangles that face away from the light, and cast nothing";
    case Cause::filter:
        return "the filter's footprint";
    case Cause::none:
        break;
    }
    return "";
}

std::string_view hint_without_map(Cause cause)
{
    return cause == Cause::coverage ? "For coverage, look at meshes that are open, or hold the "
                                      "light: what faces away from "
                                      "it casts nothing"
                                    : "";
}

std::string label_text(analysis::Label label, double amount, const analysis::ClassCounts& pixels,
                       bool has_map)
{
    const auto of = [&](std::uint64_t whole) { return percent(analysis::ratio(amount, whole)); };
    const std::string lit = of(pixels.of(PixelClass::lit));
    const std::string blocked = of(pixels.of(PixelClass::blocked));
    switch (label) {
    case analysis::Label::acne:
        return fmt::format("{} of the lit surface shadows itself (acne)", lit);
    case analysis::Label::overshadow:
        return fmt::format("{} of the lit surface is shadowed by nothing that is there "
                           "(overshadow)",
                           lit);
    case analysis::Label::peter_panning:
        return fmt::format("{} of the shadowed surface is lit because the bias detaches shadows "
                           "(peter-panning)",
                           blocked);
    case analysis::Label::leak:
        return fmt::format("{} of the shadowed surface is lit because the {} lost what shadows it "
                           "(leaks)",
                           blocked, has_map ? "map" : "method");
    case analysis::Label::bleed:
        return fmt::format("{} of the shadowed surface is lit by the method alone (bleed)",
                           blocked);
    case analysis::Label::edge:
        return fmt::format("{} of the surface is wrong along ragged or displaced shadow edges",
                           of(pixels.scored()));
    case analysis::Label::none:
        break;
    }
    return "";
}

namespace {

using analysis::Cause;
using analysis::Cure;
using analysis::Remedy;

constexpr double half = 0.5; // a cure leaves at most this share of a cause's or label's errors

/// The subject of a sentence, and whether its verb is "cure" or "cures".
struct Actor {
    std::string_view name;
    bool is_plural = false;

    [[nodiscard]] std::string with(std::string_view verb) const
    {
        return fmt::format("{} {}{}", name, verb, is_plural ? "" : "s");
    }
};

std::string_view label_noun(analysis::Label label)
{
    switch (label) {
    case analysis::Label::acne:
        return "acne";
    case analysis::Label::peter_panning:
        return "peter-panning";
    case analysis::Label::leak:
        return "leaks";
    case analysis::Label::edge:
        return "ragged edges";
    case analysis::Label::overshadow:
        return "overshadow";
    case analysis::Label::bleed:
        return "light bleeding";
    case analysis::Label::none:
        break;
    }
    return "";
}

Actor actor_of(const Cure& cure)
{
    switch (cure.cause) {
    case Cause::bias:
        return {cure.keys.size() == 1 ? std::string_view{cure.keys.front()} : "other biases",
                cure.keys.size() > 1};
    case Cause::precision:
        return cure.keys.front().starts_with(analysis::origin_comment) ? Actor{"an origin nearby"}
                                                                       : Actor{"the format d32f"};
    case Cause::resolution:
        return {"finer texels", true};
    case Cause::filter:
        return {"a single tap"};
    case Cause::coverage:
        return {"a map of the whole scene without culling"};
    case Cause::none:
        break;
    }
    return {""};
}

/// The cause that changes of a key cure, by the key's prefix.
struct KeysOfCause {
    std::string_view begin;
    Cause cause;
};
constexpr auto keys_of_causes = std::to_array<KeysOfCause>({
    {"bias.", Cause::bias},
    {analysis::origin_comment, Cause::precision},
    {"shadow_map.depth_format", Cause::precision},
    {"shadow_map.near", Cause::precision},
    {"shadow_map.far", Cause::precision},
    {"shadow_map.resolution", Cause::resolution},
    {"shadow_map.half_extent", Cause::resolution},
    {"shadow_map.layout", Cause::resolution},
    {"shadow_map.cascades", Cause::resolution},
    {"shadow_map.cascade_near", Cause::resolution},
    {"shadow_map.cascade_far", Cause::resolution},
    {"shadow_map.split", Cause::resolution},
    {"shadow_map.cascade_fit", Cause::resolution},
    {"shadow_map.fit = \"camera\"", Cause::resolution},
    {"shadow_map.fit = \"scene\"", Cause::coverage},
    {"shadow_map.cull", Cause::coverage},
    {"lookup.filter", Cause::filter},
});

bool acts_on(const Remedy& remedy, Cause cause)
{
    return std::ranges::any_of(remedy.keys, [&](const std::string& key) {
        return std::ranges::any_of(keys_of_causes, [&](const KeysOfCause& known) {
            return known.cause == cause && key.starts_with(known.begin);
        });
    });
}

/// "this bias", "these biases", "this change"
Actor actor_of(const Remedy& remedy)
{
    const bool has_biases_alone = std::ranges::all_of(
        remedy.keys, [](const std::string& key) { return key.starts_with("bias."); });
    if (!has_biases_alone) {
        return {"this change"};
    }
    return remedy.keys.size() == 1 ? Actor{"this bias"} : Actor{"these biases", true};
}

/// The cures that remove most errors of their cause.
std::vector<Cure> working_cures(const analysis::Comparison& comparison)
{
    std::vector<Cure> cures = analysis::known_cures(comparison);
    const double now = analysis::error_amount(comparison);
    std::erase_if(cures, [&](const Cure& cure) { return !cure.cures(now); });
    return cures;
}

/// "the format d32f or finer texels"
std::string any_of(const std::vector<Actor>& actors)
{
    std::vector<std::string_view> names;
    for (const Actor& actor : actors) {
        names.push_back(actor.name);
    }
    return fmt::format("{}", fmt::join(names, " or "));
}

/// The cure of one label's errors, to follow "which"; empty if unknown.
/// @param first_leaves  Share of these errors that the first remedy leaves; empty if unknown.
std::string cured_by(bool is_measured, const Remedy* first, std::optional<double> first_leaves,
                     const std::vector<Actor>& others)
{
    if (first_leaves && *first_leaves <= half) {
        constexpr double few = 0.1; // if more stay, the cure is not called whole
        const std::string cured =
            actor_of(*first).with("cure") + (*first_leaves > few ? " for the most part" : "");
        return others.empty() ? cured : fmt::format("{}, as {} would", cured, any_of(others));
    }
    if (others.size() == 1 && is_measured) {
        return fmt::format("only {}", others.front().with("cure"));
    }
    if (!others.empty()) {
        return fmt::format("{} would cure", any_of(others));
    }
    if (first != nullptr) {
        constexpr double nearly_all = 0.9;
        return !first_leaves                 ? ""
               : *first_leaves >= nearly_all ? actor_of(*first).with("leave")
                                             : actor_of(*first).with("cure") + " in part";
    }
    return is_measured ? "no single change cures" : "";
}

/// The changes other than the first remedy that cure most errors of a label.
std::vector<Actor> others_that_cure(const std::vector<Cure>& cures, analysis::Label label,
                                    double errors, const Remedy* first)
{
    std::vector<Actor> actors;
    for (const Cure& cure : cures) {
        const bool is_of_first = first != nullptr && acts_on(*first, cure.cause);
        const Actor actor = actor_of(cure);
        const bool is_new = std::ranges::none_of(
            actors, [&](const Actor& known) { return known.name == actor.name; });
        if (!is_of_first && is_new && cure.left && cure.left->of(label) <= half * errors) {
            actors.push_back(actor);
        }
    }
    return actors;
}

/// One label's share of the error, and its cure from `cured_by`.
struct NamedPart {
    std::string share;
    std::string_view noun;
    std::string by;
};

/// Empty if it would only repeat `error_summary`.
std::string sentence_of(const std::vector<NamedPart>& parts)
{
    if (parts.empty() || (parts.size() == 1 && parts.front().by.empty())) {
        return "";
    }
    const auto is_cured_alike = [&](const NamedPart& part) { return part.by == parts.front().by; };
    const bool says_once =
        parts.size() > 1 && !parts.front().by.empty() && std::ranges::all_of(parts, is_cured_alike);
    std::string text;
    for (const NamedPart& part : parts) {
        const bool is_first = text.empty();
        const bool is_last = &part == &parts.back();
        text += is_first ? "" : says_once ? (is_last ? " and " : ", ") : "; ";
        text +=
            fmt::format("{}{}{}", part.share, is_first ? " of the error is " : " is ", part.noun);
        if (!says_once && !part.by.empty()) {
            text += ", which " + part.by;
        }
    }
    if (says_once) {
        text +=
            fmt::format(", {} of which {}", parts.size() == 2 ? "both" : "all", parts.front().by);
    }
    return capitalised(std::move(text)) + ".";
}

} // namespace

std::string cure_sentence(const analysis::Comparison& comparison, const Remedy* first)
{
    const auto errors = analysis::named_errors(comparison).by_label;
    const double all = sum_of(errors);
    const std::vector<Cure> cures = working_cures(comparison);
    const bool has_reruns = !comparison.advice.empty() || !comparison.cures.empty();
    std::vector<NamedPart> parts;
    for (const std::size_t i : largest_errors(errors)) {
        const auto label = static_cast<analysis::Label>(i);
        const auto first_leaves = first != nullptr && first->left
                                      ? std::optional{first->left->of(label) / errors.at(i)}
                                      : std::nullopt;
        const std::string by = cured_by(has_reruns, first, first_leaves,
                                        others_that_cure(cures, label, errors.at(i), first));
        parts.push_back({share_of(errors.at(i), all), label_noun(label), by});
    }
    return sentence_of(parts);
}

bool is_actionable(const analysis::Comparison& comparison, Cause cause, const Remedy* first)
{
    const auto cures = working_cures(comparison);
    const bool has_cure =
        std::ranges::any_of(cures, [&](const Cure& cure) { return cure.cause == cause; });
    return has_cure && (first == nullptr || acts_on(*first, cause));
}

} // namespace gnomon::reports
