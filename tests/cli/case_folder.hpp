#pragma once

#include "child_process.hpp"

#include "scene/image.hpp"
#include "store/images/exr.hpp"
#include "store/images/layer_file.hpp"
#include "store/output_file.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace gnomon::testing {

/// A case's image in memory: float channels by name.
using CaseChannelImages = std::map<std::string, scene::Image<float>>;

inline CaseChannelImages read_channels(const std::filesystem::path& file)
{
    store::LayerFile layers{file, "a test needs it"};
    CaseChannelImages channels;
    for (const std::string& name : layers.names()) {
        channels[name] = layers.numbers(name);
    }
    return channels;
}

/// Writes all channels as floats.
inline void write_channels(const std::filesystem::path& file, const CaseChannelImages& channels)
{
    std::vector<store::ExrChannel> all;
    for (const auto& [name, image] : channels) {
        all.push_back({name, store::ChannelType::float32, [&image = image](std::size_t i) {
                           return std::bit_cast<std::uint32_t>(image[i]);
                       }});
    }
    store::write_file(file, store::encode_exr(channels.begin()->second.size(), all, {}));
}

/// A case with GL's verdicts on a built-in scene, in a temporary folder.
class CaseFolder {
public:
    /// @param more  arguments of `compare`.
    explicit CaseFolder(const std::string& builtin, const std::vector<std::string>& more = {})
    {
        std::vector<std::string> arguments{"compare", "--builtin",       builtin, "--export-case",
                                           path(),    "--json",          "--set", "image.width=240",
                                           "--set",   "image.height=136"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        compared = gnomon(arguments);
        EXPECT_EQ(compared.exit_code, 0) << compared.command << compared.err;
        channels = read_channels(at("aov.exr"));
        toml = text_of(at("case.toml"));
        own_channels_ = channels;
        own_toml_ = toml;
    }

    /// Undoes every change.
    void restore()
    {
        channels = own_channels_;
        toml = own_toml_;
    }

    [[nodiscard]] std::string path() const { return (folder_.path() / "case").string(); }
    [[nodiscard]] std::filesystem::path at(const std::string& name) const
    {
        return folder_.path() / "case" / name;
    }

    /// Keeps the channels of level 0, so that changes need not be consistent with the others.
    void keep_level_0()
    {
        std::erase_if(channels, [](const auto& channel) {
            return channel.first != "shadow.V" && channel.first != "valid" &&
                   !channel.first.starts_with("P.");
        });
    }
    /// Replaces each position.
    void move(const std::function<void(float& x, float& y, float& z)>& change)
    {
        auto& x = channels["P.X"];
        auto& y = channels["P.Y"];
        auto& z = channels["P.Z"];
        for (std::size_t i = 0; i < x.pixel_count(); ++i) {
            change(x[i], y[i], z[i]);
        }
    }
    /// Replaces the first occurrence in case.toml.
    void replace(const std::string& from, const std::string& to)
    {
        const std::size_t at = toml.find(from);
        ASSERT_NE(at, std::string::npos) << from << " in\n" << toml;
        toml.replace(at, from.size(), to);
    }
    /// Removes a table of case.toml.
    void drop_table(const std::string& name)
    {
        const std::size_t begin = toml.find("[" + name + "]");
        ASSERT_NE(begin, std::string::npos) << name;
        const std::size_t end = toml.find("\n[", begin);
        toml.erase(begin, end == std::string::npos ? end : end + 1 - begin);
    }
    void write() const
    {
        write_channels(at("aov.exr"), channels);
        std::ofstream{at("case.toml")} << toml;
    }
    [[nodiscard]] Ending evaluate(const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> arguments{"evaluate", path()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return gnomon(arguments);
    }

    Ending compared;
    CaseChannelImages channels;
    std::string toml;

private:
    TemporaryFolder folder_;
    CaseChannelImages own_channels_;
    std::string own_toml_;
};

/// The nearest half float.
inline float to_half(float value)
{
    int exponent = 0;
    const float fraction = std::frexp(value, &exponent);
    const int bits = std::max(0, std::min(11, exponent + 24)); // subnormals have fewer
    return std::ldexp(std::nearbyint(std::ldexp(fraction, bits)), exponent - bits);
}

} // namespace gnomon::testing
