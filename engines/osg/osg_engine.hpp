#pragma once

#include "cpp/egl_context.hpp"
#include "cpp/serve.hpp"
#include "view.hpp"

#include <osg/Group>

namespace engine::osg_adapter {

/// OpenSceneGraph, as README.md of this folder describes it.
class OsgEngine : public Engine {
public:
    explicit OsgEngine(Mask mask);

    Identity identity() override;
    void open(const Scene& scene) override;
    Drawn draw(const Json& draw) override;

private:
    [[nodiscard]] std::string depth_format() const;
    void check(const Json& draw) const;
    [[nodiscard]] Json tables(const Json& draw, const osg::Camera& map) const;
    /// Four numbers a pixel, top row first; NaN for background.
    /// @param is_lit  by fixed functions; else unshadowed surfaces are white.
    [[nodiscard]] std::vector<float>
    render(const osg::ref_ptr<osgShadow::ShadowTechnique>& technique, bool is_lit);
    /// Mask and `valid` from OpenSceneGraph's own pictures.
    [[nodiscard]] std::vector<Floats> picture(const Json& engine, int resolution);

    Mask mask_;
    EglContext context_;
    int depth_bits_;
    View view_;
    Scene scene_;
    osg::ref_ptr<osg::Group> objects_;
};

} // namespace engine::osg_adapter
