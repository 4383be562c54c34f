#include "reports/text/cause_text.hpp"

#include "analysis/pixels/ratio.hpp"
#include "reports/text/text.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace gnomon::reports {

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

std::string_view to_try_without_map(Cause cause)
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

} // namespace gnomon::reports
