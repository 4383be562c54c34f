// Three plates over ground: how much light each blurred map lets through at equal memory.

#include "compared.hpp"
#include "method_case.hpp"
#include "methods/job_method.hpp"
#include "plates.hpp"
#include "scene/job/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::tests {
namespace {

/// The ground below a plate that hides it whole, and two above that one of which each hides a part.
scene::SceneFile three_plates()
{
    return plates_over_ground({{-4, 4, -4, 4, 1}, {-2, 1, -1, 2, 4}, {-1, 2, -2, 1, 7}});
}

struct Bled {
    double amount = 0;
    std::uint64_t bytes = 0;
};

/// What counts as light bleeding, in pixels.
Bled bled(const Compared& scene, const std::vector<scene::Override>& keys)
{
    const auto result =
        scene(looking_down(job_of_builtin("wall", with(keys, {{"shadow_map.depth_format", "d32f"},
                                                              {"lookup.outside", "clamp"},
                                                              {"bias.constant", "0"},
                                                              {"bias.slope", "0"},
                                                              {"bias.normal_texels", "0"}}))));
    return {result.diagnosis->causes.amounts.of(analysis::Label::bleed),
            methods::traits(result.job).map_bytes};
}

/// Of 8 bytes a texel: the order that Peters and Klein published in 2015.
TEST(PrefilteredMaps, BleedInThePublishedOrderAtEqualBytes)
{
    GNOMON_REQUIRE_GL();
    const Compared scene{three_plates()};
    const Bled vsm = bled(scene, {{"method.name", "vsm"}});
    const Bled evsm = bled(scene, {{"method.name", "evsm"}, {"method.bits", "16"}});
    const Bled msm = bled(scene, {{"method.name", "msm"}, {"method.bits", "16"}});
    EXPECT_EQ(vsm.bytes, evsm.bytes);
    EXPECT_EQ(vsm.bytes, msm.bytes);
    EXPECT_GT(vsm.amount, evsm.amount);
    EXPECT_GT(evsm.amount, msm.amount);
    EXPECT_GT(msm.amount, 0);
}

} // namespace
} // namespace gnomon::tests
