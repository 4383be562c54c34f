#include "child_process.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

/// Arguments, and what the message must contain.
struct Mistake {
    std::vector<std::string> arguments;
    std::string message;
};

TEST(CommandLine, RefusesWrongUsage)
{
    for (const Mistake& mistake : {
             Mistake{{}, "subcommand is required"},
             {{"xyzzyq"}, "unknown command xyzzyq; `gnomon --help` lists them"},
             {{"compare", "-q"}, "unknown option -q; `gnomon compare --help` lists them"},
             {{"help", "xyzzyq"}, "help: unknown command xyzzyq; `gnomon --help` lists them"},
             {{"comprae"},
              "unknown command comprae; did you mean compare? `gnomon --help` lists them"},
             {{"baseline", "sav"},
              "unknown command sav; did you mean save? `gnomon baseline --help`"},
             {{"help", "comprae"}, "help: unknown command comprae; did you mean compare?"},
             {{"help", "compare", "it"}, "help: unknown command it; compare has none below it"},
             {{"compare", "--pictur=a.png"},
              "unknown option --pictur=a.png; did you mean --picture?"},
             {{"--versoin"}, "unknown option --versoin; did you mean --version?"},
             {{"compare", "--nonsense"}, "--nonsense"},
             {{"compare"}, "give a job file, a scene file, or --builtin NAME"},
             {{"compare", "job.toml", "--builtin", "wall"}, "mutually exclusive"},
             {{"compare", "a.toml", "b.toml"}, "b.toml"},
             {{"compare", "--builtin"}, "--builtin"},
             {{"compare", "--builtin", "wall", "--set"}, "--set"},
             {{"compare", "--builtin", "wall", "--set", "bias.constant"}, "write KEY=VALUE"},
             {{"compare", "--builtin", "wall", "--set", "=1"}, "write KEY=VALUE"},
             {{"compare", "--builtin", "wall", "--case", "noon"}, "--case needs a job file"},
             {{"compare", "--builtin", "wal"}, "the nearest is \"wall\""},
             {{"compare", "--builtin", "wall", "--truth", "guess"}, "--truth"},
             {{"compare", "--builtin", "wall", "--threads", "-1"}, "--threads"},
             {{"compare", "--builtin", "wall", "--threads", "many"}, "--threads"},
             {{"compare", "--builtin", "wall", "--device", "first"}, "--device"},
             {{"scenes", "more"}, "more"},
             {{"completion", "tcsh"}, "tcsh not in {bash,zsh,fish}"},
         }) {
        expect_refused(gnomon(mistake.arguments), 2, mistake.message);
    }
}

TEST(CommandLine, RefusesWhatItCannotReadAsAJob)
{
    const TemporaryFolder folder;
    const std::string noise{"\xF0\x01\x02\xFF\x00\x7F", 6};
    const std::string place = folder.path().string();
    for (const Mistake& mistake : {
             Mistake{{"compare", place + "/missing.toml"}, "missing.toml"},
             {{"compare", place + "/missing.glb"}, "missing.glb: there is no such file"},
             {{"compare", place}, "is a folder"},
             {{"compare", place + "/a\nb.toml"}, "b.toml"},
             {{"compare", folder.write("empty.toml", "")}, "empty.toml: no scene"},
             {{"compare", folder.write("empty.glb", "")}, "empty.glb: is empty"},
             {{"compare", folder.write("noise.toml", noise)}, "noise.toml:1:"},
             {{"compare", folder.write("text.toml", "not toml\n")}, "text.toml:1:"},
             {{"compare", "/dev/zero"}, "/dev/zero"},
         }) {
        expect_refused(gnomon(mistake.arguments), 2, mistake.message);
    }
}

/// Settings that are not valid with `builtin`.
void expect_settings_refused(const std::string& builtin, const std::vector<std::string>& settings,
                             const std::string& message)
{
    std::vector<std::string> arguments{"compare", "--builtin", builtin};
    for (const std::string& setting : settings) {
        arguments.insert(arguments.end(), {"--set", setting});
    }
    expect_refused(gnomon(arguments), 2, message);
}

TEST(JobSettings, RefusesBadNumbers)
{
    for (const char* const value : {"0", "-1", "1000000000", "1e99", "nan", "\"a lot\"", "1024.5",
                                    "true", "[1024]", "99999999999999999999"}) {
        expect_settings_refused("wall", {fmt::format("shadow_map.resolution={}", value)},
                                "shadow_map.resolution");
    }
    for (const char* const value : {"1e-40", "-1e-45", "nan", "inf", "2", "false"}) {
        expect_settings_refused("sphere-cube", {fmt::format("bias.constant={}", value)},
                                "bias.constant");
    }
}

TEST(JobSettings, RefusesBadRangesOfDepth)
{
    expect_settings_refused("sphere-cube", {"shadow_map.near=5", "shadow_map.far=5"},
                            "must be less than shadow_map.far");
    expect_settings_refused("yard", {"shadow_map.near=5", "shadow_map.far=2"},
                            "must be less than shadow_map.far");
    expect_settings_refused("sphere-cube", {"shadow_map.near=0"}, "must be above 0");
    expect_settings_refused("sphere-cube", {"shadow_map.near=-1"}, "must be above 0");
}

TEST(JobSettings, RefusesCamerasAndLightsWithoutADirection)
{
    expect_settings_refused("wall", {"camera.eye=[1,2,3]", "camera.target=[1,2,3]"},
                            "camera.eye equals camera.target");
    expect_settings_refused(
        "wall", {"camera.eye=[0,9,0]", "camera.target=[0,0,0]", "camera.up=[0,1,0]"}, "camera.up");
    expect_settings_refused("sphere-cube", {"light.position=[1,2,3]", "light.target=[1,2,3]"},
                            "light.position equals light.target");
    expect_settings_refused("wall", {"light.direction=[0,0,0]"}, "light.direction");
    expect_settings_refused("wall", {"light.type=point"}, "a point light needs light.position");
}

TEST(JobSettings, RefusesUnknownKeysAndWrongTypes)
{
    expect_settings_refused("wall", {"shadow_map.resolutoin=512"},
                            "the nearest is shadow_map.resolution");
    expect_settings_refused("wall", {"scene.wall.thicknes_m=1"},
                            "the nearest is scene.wall.thickness_m");
    expect_settings_refused("wall", {"camera.eye=1"}, "camera.eye");
    expect_settings_refused("wall", {"lookup.filter=3"}, "lookup.filter");
    expect_settings_refused("wall", {"lookup.filter=blurry"}, "lookup.filter");
}

TEST(JobSettings, RefusesMethodsAndKeysThatTheyDoNotHave)
{
    expect_settings_refused("wall", {"method.name=vms"}, "the nearest is \"vsm\"");
    expect_settings_refused("wall", {"method.kernel_width=5"}, "method.kernel_width");
    expect_settings_refused("wall", {"method.name=depth", "method.kernel_width=5"},
                            "method.kernel_width");
    expect_settings_refused("wall", {"method.name=vsm", "method.kernel_widht=5"},
                            "the nearest is method.kernel_width");
    expect_settings_refused("wall", {"method.name=vsm", "lookup.filter=pcf3"},
                            "the method vsm has no filter; remove it");
}

TEST(JobSettings, RefusesTablesThatAMethodDoesNotRead)
{
    expect_settings_refused("wall", {"method.name=primitive_id", "bias.constant=0.001"},
                            "the method primitive_id reads no [bias]; remove all");
    expect_settings_refused("wall", {"method.name=primitive_id", "lookup.filter=pcf3"},
                            "the method primitive_id has no filter; remove it");
    expect_settings_refused(
        "wall", {"method.name=primitive_id", "shadow_map.layout=cascades", "shadow_map.blend=0.2"},
        "remove shadow_map.blend");
    expect_settings_refused("sphere-plane",
                            {"method.name=primitive_id", "shadow_map.content=distance"},
                            "remove shadow_map.content");
    for (const char* const key :
         {"shadow_map.resolution=64", "lookup.outside=clamp", "bias.slope=0.1"}) {
        expect_settings_refused("wall", {"method.name=shadow_volumes", key},
                                "the method shadow_volumes reads no [");
    }
    expect_settings_refused("wall", {"method.name=shadow_volumes", "method.casters=back"},
                            "one of all, facing_light");
    expect_settings_refused("wall", {"method.casters=all"},
                            "is for method.name = \"shadow_volumes\"");
}

TEST(Outputs, OfAMapAreRefusedWhereThereIsNone)
{
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "map").string();
    const auto compare_with = [](const std::string& option, const std::string& value) {
        return gnomon({"compare", "--builtin", "wall", "--set", "method.name=shadow_volumes",
                       "--set", "image.width=64", "--set", "image.height=48", option, value});
    };
    expect_refused(compare_with("--depth-map", file + ".exr"), 2, "has no map: remove the option");
    expect_refused(compare_with("--heat-map", "depth-error=" + file + ".png"), 2,
                   "this lookup has no map");
}

TEST(Advice, IsRefusedWhereThereIsNoBiasCurve)
{
    for (const char* const method : {"method.name=primitive_id", "method.name=shadow_volumes"}) {
        expect_refused(gnomon({"tune", "--builtin", "wall", "--set", method}), 2,
                       "has no bias curve, which tuning needs");
    }
    expect_refused(
        gnomon({"compare", "--advise", "--builtin", "wall", "--set", "method.name=shadow_volumes"}),
        2, "has no map and no bias to change");
}

TEST(JobSettings, RefusesKernelsThatAMethodCannotHave)
{
    for (const char* const width : {"4", "0", "11", "-3", "2.5", "\"wide\""}) {
        expect_settings_refused("wall",
                                {"method.name=vsm", fmt::format("method.kernel_width={}", width)},
                                "method.kernel_width");
    }
    expect_settings_refused("wall",
                            {"method.name=vsm", "method.kernel_width=7", "shadow_map.resolution=4"},
                            "method.kernel_width = 7: wider than the map of 4 texels");
    expect_settings_refused("wall", {"method.name=vsm", "shadow_map.depth_format=r16f"},
                            "reads a depth texture");
    expect_settings_refused("wall", {"method.name=vsm", "method.kernel=disc"}, "method.kernel");
    expect_settings_refused("wall", {"method.name=vsm", "method.min_variance=1e-40"},
                            "method.min_variance");
    expect_settings_refused("wall", {"method.name=vsm", "method.bleeding_reduction=1"},
                            "method.bleeding_reduction");
}

TEST(JobSettings, RefusesWhatBlurredMapsCannotHave)
{
    for (const std::string method : {"esm", "evsm", "msm"}) {
        const std::string name = "method.name=" + method;
        for (const char* const width : {"0", "1000"}) {
            expect_settings_refused("wall", {name, fmt::format("method.kernel_width={}", width)},
                                    "method.kernel_width");
        }
        expect_settings_refused("wall", {name, "shadow_map.depth_format=r32f"},
                                "reads a depth texture");
        expect_settings_refused("wall", {name, "method.bits=24"}, "method.bits");
        expect_settings_refused("wall", {name, "light.type=point", "light.position=[0,5,0]"},
                                "its kernels do not cross the seams of a cube");
    }
    expect_settings_refused("wall", {"method.name=evsm", "method.positive_exponent=44"},
                            "use 43.32 or less");
    expect_settings_refused("wall",
                            {"method.name=evsm", "method.bits=16", "method.negative_exponent=5.6"},
                            "use 5.54 or less, or method.bits = 32");
    expect_settings_refused("wall", {"method.name=esm", "method.exponent=0"}, "method.exponent");
    expect_settings_refused("wall", {"method.name=msm", "method.moment_bias=-1"},
                            "method.moment_bias");
}

TEST(JobSettings, NamesFileAndLineOfAMistake)
{
    const TemporaryFolder folder;
    const auto job =
        folder.write("job.toml", "[scene]\nbuiltin = \"wall\"\n[shadow_map]\nresolution = 0\n");
    expect_refused(gnomon({"compare", job}), 2, "job.toml:4");
}

TEST(JobSettings, RefusesHugeImagesBeforeMemoryIsTaken)
{
    const Ending ending = gnomon({"compare", "--builtin", "wall", "--set", "image.width=20000",
                                  "--set", "image.height=20000"});
    expect_refused(ending, 2, "image.width");
    // 20000² verdicts alone would be 1.6 GB; the program with its libraries takes 140 MB.
    EXPECT_LT(ending.peak_memory_bytes, 200U << 20U);
}

TEST(JobSettings, RefusesWhatTheMachineHasNoMemoryFor)
{
    Start start;
    start.address_space_bytes = 4ULL << 30U;
    const Ending ending = gnomon({"compare", "--builtin", "wall", "--set", "image.width=16000",
                                  "--set", "image.height=8000"},
                                 start);
    expect_refused(ending, 2, "are available: make them smaller");
    EXPECT_LT(ending.peak_memory_bytes, 200U << 20U);
}

/// With so little memory the driver's shader compiler crashes, or Embree fails.
TEST(JobSettings, SaysThatAProcessMayHaveTooFewAddressesForGl)
{
    Start start;
    start.address_space_bytes = 600ULL << 20U;
    expect_refused(gnomon({"compare", "--builtin", "wall"}, start), 4,
                   "the address space is limited to 600 MiB; GL and Embree need 1024");
}

} // namespace
} // namespace gnomon::testing
