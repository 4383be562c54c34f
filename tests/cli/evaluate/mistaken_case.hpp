#pragma once

#include "case_folder.hpp"
#include "lane.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::testing {

/// Scenes with flat ground, with round objects and mirrored places, and without a plane.
inline const std::vector<std::string> mistaken_scenes{"sphere-plane", "yard", "terrain"};

/// A scene's case without changes; created once.
inline CaseFolder& case_of(const std::string& scene)
{
    static std::map<std::string, std::unique_ptr<CaseFolder>> cases;
    auto& folder = cases[scene];
    if (folder == nullptr) {
        std::vector<std::string> settings{"--set", "lookup.filter=nearest"};
        if (!tests::runs_full_tests() && scene == "terrain") {
            settings.insert(settings.end(), {"--set", "scene.terrain.cells=64"}); // of 256
        }
        folder = std::make_unique<CaseFolder>(scene, settings);
    }
    folder->restore();
    return *folder;
}

/// The scenes for the next mistake: all, or in the usual lane one in turn.
inline std::vector<std::string> scenes_of_next_mistake()
{
    static std::size_t mistakes = 0;
    const std::string& next = mistaken_scenes[mistakes++ % mistaken_scenes.size()];
    return tests::in_lane<std::vector<std::string>>({next}, mistaken_scenes);
}

/// Makes the mistake, and expects exit status 1 from --check and 2 from evaluating.
inline void expect_named(const std::function<void(CaseFolder&)>& make_mistake,
                         const std::string& sentence)
{
    for (const std::string& scene : scenes_of_next_mistake()) {
        CaseFolder& folder = case_of(scene);
        folder.keep_level_0();
        make_mistake(folder);
        folder.write();
        const Ending checked = folder.evaluate({"--check"});
        EXPECT_EQ(checked.exit_code, 1) << scene << "\n" << checked.out << checked.err;
        EXPECT_THAT(checked.out, ::testing::HasSubstr(sentence)) << scene;
        if (scene == mistaken_scenes.front()) {
            expect_refused(folder.evaluate(), 2, sentence);
        }
    }
}

inline void change_each(scene::Image<float>& image, const std::function<float(float)>& change)
{
    std::transform(image.begin(), image.end(), image.data(), change);
}

inline void flip_rows(scene::Image<float>& image)
{
    const auto [width, height] = image.size();
    for (int y = 0; y < height / 2; ++y) {
        for (int x = 0; x < width; ++x) {
            std::swap(image(x, y), image(x, height - 1 - y));
        }
    }
}

} // namespace gnomon::testing
