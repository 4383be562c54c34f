#include "scene/job/stage_names.hpp"

namespace gnomon::scene {
namespace {

std::string_view stage_name(Stage stage)
{
    switch (stage) {
    case Stage::scene:
        return "scene";
    case Stage::truth:
        return "truth";
    case Stage::receivers:
        return "receivers";
    case Stage::shadow_map:
        return "shadow_map";
    case Stage::prefilter:
        return "prefilter";
    case Stage::lookup:
        return "lookup";
    case Stage::bias:
        return "bias";
    }
    return {};
}

} // namespace

std::vector<std::string_view> stage_names(Stages stages)
{
    std::vector<std::string_view> names;
    for (unsigned bit = 1; bit <= static_cast<unsigned>(Stage::bias); bit <<= 1U) {
        if ((stages & bit) != 0) {
            names.push_back(stage_name(static_cast<Stage>(bit)));
        }
    }
    return names;
}

} // namespace gnomon::scene
