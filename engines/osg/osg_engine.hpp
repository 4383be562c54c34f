#pragma once

#include "cpp/egl_context.hpp"
#include "cpp/serve.hpp"
#include "view.hpp"

#include <osg/Group>

namespace engine::osg_adapter {

/// OpenSceneGraph, as README.md of this folder describes it.
class OsgEngine : public Engine {
public:
    OsgEngine();

    Identity identity() override;
    void open(const Scene& scene) override;
    Drawn draw(const Json& draw) override;

private:
    [[nodiscard]] std::string depth_format() const;
    void check(const Json& draw) const;
    [[nodiscard]] Json tables(const Json& draw, const osg::Camera& map) const;

    EglContext context_;
    int depth_bits_;
    View view_;
    Scene scene_;
    osg::ref_ptr<osg::Group> objects_;
};

} // namespace engine::osg_adapter
