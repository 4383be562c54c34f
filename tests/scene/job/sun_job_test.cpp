#include "job_fixture.hpp"
#include "scene/job/source.hpp"
#include "scene/light/sun.hpp"
#include "scene/view/view.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace gnomon::scene::test {
namespace {

using ::testing::HasSubstr;

const std::string on_wall = "scene.builtin = \"wall\"\n";
const std::string sun = "light.sun = {latitude_deg = 52.52, longitude_deg = 13.4, time = "
                        "\"2026-06-21T12:00:00Z\"}\n";

TEST(SunOfAJob, TakesThePlaceOfADirectionFromBelow)
{
    const Job job = job_of(on_wall + sun).job;
    ASSERT_TRUE(job.light->sun);
    EXPECT_FALSE(job.light->direction);
    const SunPosition noon = sun_position(52.52, 13.4, *utc_time("2026-06-21T12:00:00Z"));
    EXPECT_EQ(resolve_light(job, {}).direction, sun_direction(noon, usual_north));
    const Job with_position = job_of(on_wall + sun, {{"light.position", "[1, 5, 0]", {}},
                                                     {"light.target", "[0, 0, 0]", {}}})
                                  .job;
    EXPECT_FALSE(with_position.light->sun);
    const Job directed = job_of(on_wall + sun, {{"light.direction", "[0, -1, 0]", {}}}).job;
    EXPECT_FALSE(directed.light->sun);
}

TEST(SunOfAJob, IsReadBackAsItIsWritten)
{
    const Job job = job_of(on_wall + sun + "scene.north = [1, 0, 0]\n").job;
    std::string text;
    for (const auto& [key, value] : resolved_keys(job)) {
        text += fmt::format("{} = {}\n", key, value);
    }
    EXPECT_THAT(text, HasSubstr("light.sun.time = \"2026-06-21T12:00:00Z\""));
    EXPECT_EQ(resolve_light(job_of(text).job, {}).direction, resolve_light(job, {}).direction);
}

TEST(SunOfAJob, TakesTomlsOwnTimes)
{
    const auto time_of = [](const std::string& time) {
        return job_of(on_wall +
                      "[light.sun]\nlatitude_deg = 52\nlongitude_deg = 13\ntime = " + time + "\n")
            .job.light->sun->time;
    };
    EXPECT_EQ(time_of("2026-06-21T12:00:00Z"), "2026-06-21T12:00:00Z");
    EXPECT_EQ(utc_time(time_of("2026-06-21T14:00:00.5+02:00")), utc_time("2026-06-21T12:00:00.5Z"));
    const Job overridden =
        job_of(on_wall + sun, {{"light.sun.time", "2026-06-21T08:00:00Z", {}}}).job;
    EXPECT_EQ(overridden.light->sun->time, "2026-06-21T08:00:00Z");
}

TEST(SunOfAJob, StandsByNorth)
{
    const Job job = job_of(on_wall + sun + "scene.north = [1, 3, 0]\n").job;
    const SunPosition noon = sun_position(52.52, 13.4, *utc_time("2026-06-21T12:00:00Z"));
    EXPECT_EQ(resolve_light(job, {}).direction, sun_direction(noon, {1, 0, 0}));
}

TEST(SunOfAJob, OfOneOfSeveralLights)
{
    const std::string lights = on_wall + R"([[lights]]
name = "morning"
sun = {latitude_deg = 52.52, longitude_deg = 13.4, time = "2026-06-21T06:00:00Z"}
[[lights]]
name = "lamp"
type = "point"
position = [0, 3, 2]
)";
    const auto read = [&](const std::vector<Override>& overrides) {
        return light_jobs(job_source_of_text("job.toml", lights, overrides, {}, own_keys()));
    };
    const auto jobs = read({});
    ASSERT_EQ(jobs.size(), 2U);
    EXPECT_EQ(jobs[0].job.light->sun->time, "2026-06-21T06:00:00Z");
    const auto later = read({{"lights.morning.sun.time", "\"2026-06-21T08:00:00Z\"", {}}});
    EXPECT_EQ(later[0].job.light->sun->time, "2026-06-21T08:00:00Z");
}

TEST(SunOfAJob, RefusesWhatIsNone)
{
    const auto refused = [](const std::string& keys) { return refusal(on_wall + keys); };
    EXPECT_THAT(refused("light.sun.time = \"2026-06-21T12:00:00Z\"\n"),
                HasSubstr("a sun needs a place and a time; light.sun.latitude_deg is missing"));
    EXPECT_THAT(refused(sun + "light.direction = [0, -1, 0]\n"), HasSubstr("mutually exclusive"));
    EXPECT_THAT(refused("light.sun = {latitude_deg = 52, longitude_deg = 13, time = \"noon\"}\n"),
                HasSubstr("must be a time from 2010 to 2109"));
    EXPECT_THAT(refused("light.sun = {latitude_deg = 52, longitude_deg = 13, time = "
                        "2026-06-21T23:00:00Z}\n"),
                HasSubstr("degrees below the horizon then; choose another time"));
    EXPECT_THAT(refused("light.sun = {latitude_deg = 91, longitude_deg = 13, time = "
                        "\"2026-06-21T12:00Z\"}\n"),
                HasSubstr("light.sun.latitude_deg = 91"));
    EXPECT_THAT(refused("scene.north = [0, 1, 0]\n"), HasSubstr("a horizontal part"));
    EXPECT_THAT(
        refusal("scene.file = \"model.obj\"\nlight.type = \"spot\"\nlight.position = [0, 1, "
                "0]\nlight.target = [0, 0, 0]\n" +
                sun),
        HasSubstr("is for a directional light"));
}

TEST(SunOfAJob, StandsInTheTemplate)
{
    EXPECT_THAT(commented_job_file({}, own_keys()), HasSubstr("[light.sun]"));
}

} // namespace
} // namespace gnomon::scene::test
