#include "methods/lookup_traits.hpp"

#include <cmath>

namespace gnomon::methods {

int width_of_radius(double radius_texels)
{
    return 2 * static_cast<int>(std::ceil(radius_texels)) + 1;
}

LookupTraits mixed(LookupTraits promised)
{
    promised.verdict = Verdict::fraction;
    promised.compares = Compares::none;
    promised.mixes_maps = true;
    if (promised.curve == Curve::by_formula) {
        promised.curve = Curve::by_bisection;
    }
    return promised;
}

std::string_view name(Verdict verdict)
{
    switch (verdict) {
    case Verdict::binary:
        return "binary";
    case Verdict::fraction:
        return "fraction";
    }
    return {};
}

std::string_view name(Compares compares)
{
    switch (compares) {
    case Compares::each_tap:
        return "each_tap";
    case Compares::mean_depth:
        return "mean_depth";
    case Compares::primitives:
        return "primitives";
    case Compares::none:
        return "none";
    }
    return {};
}

std::string_view name(Monotone rise)
{
    switch (rise) {
    case Monotone::exactly:
        return "exactly";
    case Monotone::up_to_rounding:
        return "up_to_rounding";
    case Monotone::no:
        return "no";
    }
    return {};
}

std::string_view name(Curve curve)
{
    switch (curve) {
    case Curve::by_formula:
        return "by_formula";
    case Curve::by_bisection:
        return "by_bisection";
    case Curve::none:
        return "none";
    }
    return {};
}

std::string_view name(Reads reads)
{
    switch (reads) {
    case Reads::footprint:
        return "footprint";
    case Reads::whole_map:
        return "whole_map";
    }
    return {};
}

} // namespace gnomon::methods
