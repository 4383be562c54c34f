// Files of another renderer's case with some bytes changed.

#include "case_folder.hpp"
#include "lane.hpp"
#include "raw_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <random>
#include <string>
#include <string_view>

namespace gnomon::testing {
namespace {

/// Replaces, cuts, doubles or removes a few bytes.
std::string with_damage(std::string bytes, std::uint32_t seed)
{
    std::mt19937 random{seed};
    for (std::size_t edits = 1 + random() % 4; edits > 0 && bytes.size() > 16; --edits) {
        // Half of the places are in the image's header, where its structure is.
        const std::size_t range =
            random() % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 900);
        const std::size_t at = random() % range;
        switch (random() % 5) {
        case 0:
            bytes.erase(at, 1 + random() % 8);
            break;
        case 1:
            bytes.insert(at, bytes.substr(random() % bytes.size(), 1 + random() % 8));
            break;
        case 2:
            if (const std::size_t digit = bytes.find_first_of("0123456789", at);
                digit != std::string::npos) {
                bytes[digit] = static_cast<char>('0' + random() % 10);
            }
            break;
        case 3:
            bytes.resize(random() % 8 == 0 ? at : bytes.size());
            break;
        default:
            bytes[at] = static_cast<char>(random() & 0xFFU);
        }
    }
    return bytes;
}

TEST(DamagedCases, AreEvaluatedOrRefusedInOneLine)
{
    const CaseFolder folder{"sphere-plane",
                            {"--set", "image.width=64", "--set", "image.height=36"}};
    const auto& p = folder.channels;
    write_npy(folder.at("p.npy"), {&p.at("P.X"), &p.at("P.Y"), &p.at("P.Z")});
    write_pfm(folder.at("mask.pfm"), {&p.at("shadow.V")});
    const std::uint32_t count = tests::in_lane(4U, 200U);
    for (const char* const name : {"case.toml", "aov.exr", "mesh.glb", "p.npy", "mask.pfm"}) {
        if (std::string_view{name} == "p.npy") {
            std::ofstream{folder.at("case.toml")}
                << folder.toml << "\n[files]\nposition = \"p.npy\"\nshadow = \"mask.pfm\"\n";
        }
        const std::string whole = text_of(folder.at(name));
        int refused = 0;
        for (std::uint32_t seed = 0; seed < count && !HasFailure(); ++seed) {
            std::ofstream{folder.at(name), std::ios::binary} << with_damage(whole, seed);
            const Ending ending = folder.evaluate();
            SCOPED_TRACE(std::string{name} + " with seed " + std::to_string(seed));
            if (ending.exit_code != 0) {
                ++refused;
                expect_refused(ending, 2, "");
            }
        }
        std::ofstream{folder.at(name), std::ios::binary} << whole;
        EXPECT_GT(refused, 0) << name;
    }
    expect_done(folder.evaluate());
}

} // namespace
} // namespace gnomon::testing
