// Cases whose images are raw floats, or a colour target's four.

#include "case_folder.hpp"
#include "lane.hpp"
#include "raw_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace gnomon::testing {
namespace {

using ::testing::HasSubstr;
using RawJson = nlohmann::json;

/// The result of `evaluate`, without the sources of the numbers.
RawJson found_in(const CaseFolder& folder)
{
    const Ending ending = folder.evaluate({"--json"});
    EXPECT_EQ(ending.exit_code, 0) << ending.command << ending.err << folder.toml;
    RawJson found = RawJson::parse(ending.out, nullptr, false);
    found.erase("timings_ms");
    return found;
}

/// Removes the EXR file, and returns the tables of case.toml for the raw files.
void say_files(CaseFolder& folder, const std::string& head, const std::string& tables = {})
{
    std::filesystem::remove(folder.at("aov.exr"));
    std::ofstream{folder.at("case.toml")} << head << folder.toml << tables;
}

RawChannels position_of(const CaseFolder& folder)
{
    return {&folder.channels.at("P.X"), &folder.channels.at("P.Y"), &folder.channels.at("P.Z")};
}

/// Drops pixels that need the channel `valid` to be ignored.
void put_validity_into_positions(CaseFolder& folder)
{
    const auto& valid = folder.channels.at("valid");
    std::size_t i = 0;
    folder.move([&](float& x, float&, float&) {
        if (valid[i++] == 0) {
            x = std::numeric_limits<float>::quiet_NaN();
        }
    });
}

TEST(EvaluateRawFiles, GivesWhatTheSameNumbersInAnExrFileGive)
{
    // Every optional channel that a raw file may hold; filters of more than a texel need the map.
    const std::vector<std::vector<std::string>> cases{
        {"--builtin", "yard", "--set", "lookup.filter=nearest", "--set", "bias.normal_texels=0",
         "--set", tests::in_lane("shadow_map.resolution=256", "shadow_map.resolution=1024")},
        {"--builtin", "lamp-room", "--set", "lookup.filter=pcf3", "--set",
         "shadow_map.resolution=128"}};
    for (const auto& arguments : cases) {
        for (const bool is_bottom_up : {false, true}) {
            if (!tests::runs_full_tests() && is_bottom_up != (arguments[1] == "lamp-room")) {
                continue; // the usual lane tries each case and each order once
            }
            CaseFolder folder{arguments[1], {arguments.begin() + 2, arguments.end()}};
            std::erase_if(folder.channels,
                          [](const auto& one) { return one.first.starts_with("unmoved."); });
            folder.write();
            const RawJson from_exr = found_in(folder);
            std::string tables = "\n[files]\n";
            const auto add = [&](const std::string& key, const RawChannels& channels) {
                const bool is_pfm = key == "shadow" || key == "normal";
                const std::string name = fmt::format("{}.{}", key, is_pfm ? "pfm" : "NPY");
                tables += fmt::format("{} = \"{}\"\n", key, name);
                is_pfm ? write_pfm(folder.at(name), channels)
                       : write_npy(folder.at(name), channels, is_bottom_up);
            };
            const auto& channels = folder.channels;
            add("position", position_of(folder));
            add("normal", {&channels.at("Ng.X"), &channels.at("Ng.Y"), &channels.at("Ng.Z")});
            add("texel", {&channels.at("texel.X"), &channels.at("texel.Y")});
            for (const auto& [key, name] :
                 std::vector<std::pair<std::string, std::string>>{{"shadow", "shadow.V"},
                                                                  {"valid", "valid"},
                                                                  {"object", "id.geom"},
                                                                  {"z_light", "z.light"},
                                                                  {"z_map", "z.map"},
                                                                  {"map_index", "map_index"},
                                                                  {"tan_theta", "tan_theta"}}) {
                if (channels.contains(name)) {
                    add(key, {&channels.at(name)});
                }
            }
            if (is_bottom_up) {
                tables += "[conventions]\nrows = \"bottom_up\"\n";
            }
            if (std::filesystem::exists(folder.at("map.exr"))) {
                // GL's faces one below the other, each as glGetTexImage returns it.
                const auto map = read_channels(folder.at("map.exr")).at("map.d");
                const int side = map.size().width_px;
                scene::Image<float> faces{map.size()};
                for (int y = 0; y < map.size().height_px; ++y) {
                    const int row =
                        y / side * side + (is_bottom_up ? side - 1 - y % side : y % side);
                    for (int x = 0; x < side; ++x) {
                        faces(x, y) = map(x, row);
                    }
                }
                write_npy(folder.at("map.npy"), {&faces});
                folder.replace("map.exr", "map.npy");
            }
            say_files(folder, "", tables);
            EXPECT_EQ(found_in(folder), from_exr) << tables;
            EXPECT_FALSE(from_exr.at("causes").is_null()) << folder.compared.command;
        }
    }
}

TEST(EvaluateRawFiles, TakesPositionAndMaskOfOneTarget)
{
    CaseFolder folder{"sphere-plane"};
    folder.keep_level_0();
    put_validity_into_positions(folder);
    folder.channels.erase("valid");
    folder.write();
    const RawJson from_names = found_in(folder);

    RawChannels four = position_of(folder);
    four.push_back(&folder.channels.at("shadow.V"));
    write_npy(folder.at("frame.npy"), four);
    say_files(folder, "image = \"frame.npy\"\n");
    EXPECT_EQ(found_in(folder), from_names) << "a .npy file of four numbers";

    write_npy(folder.at("frame.npy"), position_of(folder));
    write_pfm(folder.at("mask.pfm"), {&folder.channels.at("shadow.V")});
    say_files(folder, "image = \"frame.npy\"\n", "\n[files]\nshadow = \"mask.pfm\"\n");
    EXPECT_EQ(found_in(folder), from_names) << "positions in one file, the mask in another";

    write_channels(folder.at("frame.exr"), {{"R", folder.channels.at("P.X")},
                                            {"G", folder.channels.at("P.Y")},
                                            {"B", folder.channels.at("P.Z")},
                                            {"A", folder.channels.at("shadow.V")}});
    say_files(folder, "image = \"frame.exr\"\n");
    EXPECT_EQ(found_in(folder), from_names) << "an EXR file of R, G, B and A";
}

/// A file that is not valid in a case, and its message.
struct BadRawFile {
    std::string name;
    std::string bytes;
    std::string message;
};

TEST(EvaluateRawFiles, RefusesOthersInOneLine)
{
    CaseFolder folder{"sphere-plane", {"--set", "image.width=4", "--set", "image.height=2"}};
    folder.keep_level_0();
    folder.write();
    const std::string pixels(std::size_t{4} * 2 * 4, '\0');
    const std::string huge = "(1048576, 1048576, 3)";
    const std::vector<BadRawFile> files{
        {"m.npy", npy_header("<f8", "False", "(2, 4)") + pixels + pixels, "'<f4'"},
        {"m.npy", npy_header("<f4", "True", "(2, 4)") + pixels, "fortran_order"},
        {"m.npy", npy_header("<f4", "False", "(8,)") + pixels, "shape must be"},
        {"m.npy", npy_header("<f4", "False", "(2, 4, 1, 1)") + pixels, "shape must be"},
        {"m.npy", npy_header("<f4", "False", "(2, -4)") + pixels, "sizes are not from 1 to"},
        {"m.npy", npy_header("<f4", "False", "(2, 2, 2)") + pixels,
         "2 numbers each; it must have 1"},
        {"m.npy", npy_header("<f4", "False", huge) + pixels, "bytes, but 1048576x1048576"},
        {"m.npy", npy_header("<f4", "False", "(2, 4)") + pixels.substr(1), "bytes, but 4x2"},
        {"m.npy", npy_header("<f4", "False", "(2, 4)").substr(0, 40), "ends too early"},
        {"m.npy", npy_header("<f4", "False", "(4, 2)") + pixels, "must show the same frame"},
        {"m.npy", "", "neither a .npy nor a .pfm file"},
        {"m.pfm", "Pf\n4 2\n1.0\n" + pixels, "scale is not -1"},
        {"m.pfm", "Pf\n4 2\n-2\n" + pixels, "scale is not -1"},
        {"m.pfm", "Pf\n4\n-1.0\n" + pixels, "sizes are not from 1 to"},
        {"m.pfm", "Pf\n4 2\n-1.0", "ends too early"},
        {"m.pfm", "PF\n4 2\n-1.0\n" + pixels, "bytes, but 4x2 pixels of 3 floats"},
        {"m.exr", pixels, "takes a .npy or a .pfm file"},
    };
    folder.channels.erase("shadow.V");
    folder.write();
    for (const BadRawFile& file : files) {
        SCOPED_TRACE(file.message);
        std::ofstream{folder.at(file.name), std::ios::binary} << file.bytes;
        std::ofstream{folder.at("case.toml")} << "image = \"aov.exr\"\n"
                                              << folder.toml << "\n[files]\nshadow = \""
                                              << file.name << "\"\n";
        expect_refused(folder.evaluate(), 2, file.message);
    }
    std::ofstream{folder.at("case.toml")} << folder.toml << "\n[files]\nshadow = \"none.npy\"\n";
    expect_refused(folder.evaluate(), 2, "no such file");
}

TEST(EvaluateRawFiles, RefusesAChannelThatTwoFilesHold)
{
    CaseFolder folder{"sphere-plane"};
    folder.write();
    write_npy(folder.at("m.npy"), {&folder.channels.at("shadow.V")});
    std::ofstream{folder.at("case.toml")} << "image = \"aov.exr\"\n"
                                          << folder.toml << "\n[files]\nshadow = \"m.npy\"\n";
    expect_refused(folder.evaluate(), 2, "channel shadow.V is in");
}

} // namespace
} // namespace gnomon::testing
