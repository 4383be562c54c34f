#include "methods/taps/tap_keys.hpp"

#include "scene/error.hpp"
#include "scene/job/keys/key.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <variant>

namespace gnomon::methods {

using scene::Key;
using scene::Stage;

const Key& pattern_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.pattern",
                        "how taps lie: in rows and columns, anywhere far from each other, or on a "
                        "spiral, from its middle on or in the middle of equal areas",
                        "", scene::only(Stage::lookup)),
        scene::WordDomain{.words = {"grid", "poisson", "vogel", "vogel_areas"}},
        std::string{"grid"}, {.values = {std::string{"poisson"}, std::string{"vogel"}}});
    return key;
}

const Key& taps_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.taps", "{unit} of a kernel; of a grid 9, 25, 49 or 81", "",
                        scene::only(Stage::lookup), "taps"),
        scene::IntegerDomain{.lower = least_kernel_taps, .upper = most_kernel_taps},
        std::int64_t{25}, {.values = {std::int64_t{9}, std::int64_t{49}}});
    return key;
}

const Key& turned_key()
{
    static const Key key = scene::added_key(
        scene::make_key("method.turned",
                        "turns each pixel's kernel by an angle that a hash of the pixel gives", "",
                        scene::only(Stage::lookup)),
        scene::FlagDomain{}, false, {.values = {true}});
    return key;
}

TapPattern tap_pattern(const scene::Job& job)
{
    const auto& word = std::get<std::string>(pattern_key().value_of(job.method));
    return word == "grid"      ? TapPattern::grid
           : word == "poisson" ? TapPattern::poisson
           : word == "vogel"   ? TapPattern::vogel
                               : TapPattern::vogel_areas;
}

int tap_count(const scene::Job& job)
{
    return static_cast<int>(std::get<std::int64_t>(taps_key().value_of(job.method)));
}

bool is_turned(const scene::Job& job)
{
    return std::get<bool>(turned_key().value_of(job.method));
}

const TapKernel& tap_kernel(const scene::Job& job, TapWeights weights)
{
    constexpr int smallest_grid = 9;
    const TapPattern pattern = tap_pattern(job);
    const int taps = tap_count(job);
    const bool is_none = pattern == TapPattern::grid && !is_grid(taps);
    return tap_kernel(pattern, is_none ? smallest_grid : taps, weights);
}

void check_taps(const scene::Job& job)
{
    const int taps = tap_count(job);
    if (tap_pattern(job) == TapPattern::grid && !is_grid(taps)) {
        throw scene::InputError(fmt::format(
            "method.taps = {}: a grid has an odd number of taps along each side; use 9, 25, 49 or "
            "81, or another method.pattern",
            taps));
    }
}

} // namespace gnomon::methods
