#include "store/units/unit_plan.hpp"

#include "example_comparison.hpp"
#include "scene/error.hpp"
#include "store/output_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace gnomon::store {
namespace {

using testing::HasSubstr;
using testing::Not;

UnitPlan example_plan()
{
    UnitPlan plan;
    plan.gnomon = "1.2.3";
    plan.directory = "/home/somebody";
    plan.job.path = "jobs/wall.toml";
    plan.job.text = "scene.builtin = \"wall\" # ü\n";
    plan.job.light = "";
    plan.job.settings = {"bias.slope=1"};
    plan.job.axes = {"bias.constant=[0,1]"};
    plan.command = "gnomon sweep jobs/wall.toml";
    plan.compare_command = "gnomon compare jobs/wall.toml";
    plan.size = 12;
    plan.keeps_normals = true;
    plan.scenes = {{"wall", "scene.builtin=\"wall\"\n", "0123456789abcdef", "fedcba9876543210"}};
    plan.units.resize(2);
    plan.units[0].seconds = 1.0 / 3;
    plan.units[0].configurations = 8;
    plan.units[0].scenes = {"0123456789abcdef"};
    plan.units[0].ordinals = {{0, 7, 1}, {9, 1, 1}};
    plan.units[1].configurations = 4;
    plan.units[1].ordinals = {{7, 2, 1}, {10, 2, 1}};
    complete_plan(plan);
    return plan;
}

class UnitPlanFile : public testing::Test {
protected:
    /// The message for a text that is not a plan.
    [[nodiscard]] std::string refusal(const std::string& text) const
    {
        write_file(path_, text);
        try {
            (void)read_unit_plan(path_);
        } catch (const scene::InputError& error) {
            EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
            return error.what();
        }
        return "read";
    }

    TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "plan.jsonl";
};

TEST_F(UnitPlanFile, IsReadAsItWasWritten)
{
    const UnitPlan plan = example_plan();
    const std::string text = plan_text(plan);
    write_file(path_, text);
    const UnitPlan read = read_unit_plan(path_);
    EXPECT_EQ(plan_text(read), text);
    EXPECT_EQ(read.id, plan.id);
    EXPECT_EQ(read.directory, plan.directory);
    EXPECT_EQ(read.job.text, plan.job.text);
    EXPECT_EQ(read.job.light, plan.job.light);
    EXPECT_EQ(read.scenes, plan.scenes);
    EXPECT_EQ(read.units[0].seconds, plan.units[0].seconds);
    EXPECT_EQ(read.units[1].ordinals, plan.units[1].ordinals);
    EXPECT_EQ(read.units[1].number, 2U);
}

TEST_F(UnitPlanFile, HasTheSameIdsWhereverItIsMade)
{
    const UnitPlan plan = example_plan();
    UnitPlan other = plan;
    other.directory = "/elsewhere";
    complete_plan(other);
    EXPECT_EQ(other.id, plan.id);
    EXPECT_EQ(other.units[0].id, plan.units[0].id);
    EXPECT_NE(plan.units[0].id, plan.units[1].id);
}

TEST_F(UnitPlanFile, HasOtherIdsForOtherScenesVersionsAndJobs)
{
    const UnitPlan plan = example_plan();
    const auto changed = [&](auto change) {
        UnitPlan other = plan;
        change(other);
        complete_plan(other);
        EXPECT_NE(other.id, plan.id);
        EXPECT_NE(other.units[0].id, plan.units[0].id);
    };
    changed([](UnitPlan& other) { other.gnomon = "1.2.4"; });
    changed([](UnitPlan& other) { other.scenes[0].hash = "0000000000000000"; });
    changed([](UnitPlan& other) { other.scenes[0].brought = "0000000000000000"; });
    changed([](UnitPlan& other) { other.job.text += "bias.slope = 2\n"; });
    changed([](UnitPlan& other) { other.job.settings.emplace_back("image.width=8"); });
}

TEST_F(UnitPlanFile, NamesUnitsByIdAndByNumber)
{
    const UnitPlan plan = example_plan();
    EXPECT_EQ(find_unit(plan, plan.units[1].id, path_).number, 2U);
    EXPECT_EQ(find_unit(plan, "1", path_).id, plan.units[0].id);
    for (const char* const name : {"0", "3", "-1", "1x", "", "0123456789abcdef", "x"}) {
        EXPECT_THROW((void)find_unit(plan, name, path_), scene::InputError) << name;
    }
}

TEST_F(UnitPlanFile, IsRefusedUnlessItIsWholeAndUnchanged)
{
    const std::string text = plan_text(example_plan());
    EXPECT_THAT(refusal(""), HasSubstr("is not the plan"));
    EXPECT_THAT(refusal("{}\n"), HasSubstr("is not the plan"));
    EXPECT_THAT(refusal(text.substr(0, text.rfind("{\"unit\""))), HasSubstr("1 of its 2 units"));
    EXPECT_THAT(refusal(text.substr(0, text.size() - 9)), HasSubstr("incomplete"));
    const auto replaced = [&](const std::string& word, const std::string& with) {
        std::string other = text;
        const std::size_t place = other.find(word);
        EXPECT_NE(place, std::string::npos) << word;
        return other.replace(place, word.size(), with);
    };
    EXPECT_THAT(refusal(replaced("[7,2,1]", "[7,3,1]")), HasSubstr("was edited"));
    EXPECT_THAT(refusal(replaced("bias.slope=1", "bias.slope=2")), HasSubstr("was edited"));
    EXPECT_THAT(refusal(replaced("\"schema\":1", "\"schema\":9")), HasSubstr("its schema is 9"));
    EXPECT_THAT(refusal(replaced("\"number\":1", "\"number\":[]")), HasSubstr("is not the plan"));
}

TEST_F(UnitPlanFile, IsRefusedBeforeMemoryIsTakenForOrdinalsThatTheSweepHasNot)
{
    UnitPlan plan = example_plan();
    for (const analysis::OrdinalRun run :
         {analysis::OrdinalRun{0, std::uint64_t{1} << 60U, 1}, analysis::OrdinalRun{12, 1, 1},
          analysis::OrdinalRun{0, 2, std::uint64_t{1} << 63U}, analysis::OrdinalRun{0, 0, 1},
          analysis::OrdinalRun{0, 3, 6}, analysis::OrdinalRun{0, 2, 0}}) {
        plan.units[0].ordinals = {run};
        complete_plan(plan);
        EXPECT_THAT(refusal(plan_text(plan)), HasSubstr("ordinals beyond the end of the sweep"));
    }
}

} // namespace
} // namespace gnomon::store
