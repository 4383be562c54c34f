// Whether configurations of a sweep may be the same.

#include "analysis/sweep/sweep_curves.hpp"

#include "scene/job/source.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::analysis {
namespace {

scene::SweepSpace wall_space(const std::vector<std::string>& axes)
{
    return {scene::builtin_job_source("wall", {}), axes};
}

bool may_repeat(const scene::SweepSpace& space)
{
    const SweepCurves sweep_curves{space, false, "1.0"};
    return sweep_curves.may_repeat(
        std::vector<SceneIdentity>(sweep_curves.requests().size(), {"0123456789abcdef", ""}));
}

TEST(SweepRepeats, MayOccurWhereScenesOrCasesMayBeEqual)
{
    EXPECT_FALSE(may_repeat(wall_space({"bias.constant=0,0.5", "bias.slope=0,1"})));
    EXPECT_FALSE(may_repeat(wall_space({"bias.constant=0,0.5", "lookup.filter=pcf3,hardware"})));
    // Two scenes of the same content.
    EXPECT_TRUE(may_repeat({scene::JobSource{}, {"scene.file=a.obj,b.obj"}}));

    scene::JobSource cases = scene::builtin_job_source("wall", {});
    cases.cases = {{"one", {}}, {"same", {}}};
    EXPECT_TRUE(may_repeat({cases, {}}));
    EXPECT_TRUE(may_repeat({cases, {"bias.constant=0,0.5"}}));

    scene::JobSource zipped = scene::builtin_job_source("wall", {});
    zipped.sweep.mode = "zip";
    EXPECT_FALSE(may_repeat({zipped, {"bias.constant=0.5,0,0.5", "bias.slope=1,1,2"}}));
}

} // namespace
} // namespace gnomon::analysis
