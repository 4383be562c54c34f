#pragma once

#include "analysis/comparison/comparison.hpp"

#include <filesystem>
#include <string>

namespace gnomon::store {

/// What the example's light and shadow map are.
struct ExampleOptions {
    scene::ImageSize image{96, 64};
    int sphere_segments = 8;
    int resolution_texels = 48;
    double bias_constant = 0.002;
};

/// A sphere and a box on the ground under a directional light, with a shadow map, all by
/// brute-force rays: a small comparison with every kind of error, made without GL and Embree.
struct Example {
    scene::SceneFile file;
    analysis::Comparison comparison;
    scene::Image<scene::Vec3f> points; ///< P of each pixel

    explicit Example(const ExampleOptions& options = {});
    Example(const Example&) = delete; // the comparison points to the file's triangles
    Example& operator=(const Example&) = delete;
};

/// The default example, made once.
[[nodiscard]] const Example& example();

/// A folder for one test's files, removed with everything in it.
class TemporaryFolder {
public:
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const
    {
        return path_ / name;
    }
    [[nodiscard]] std::size_t entry_count() const;

private:
    std::filesystem::path path_;
};

[[nodiscard]] std::string read_text(const std::filesystem::path& path);

} // namespace gnomon::store
