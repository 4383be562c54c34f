#pragma once

#include "cpp/scene.hpp"

#include <osg/Image>
#include <osgShadow/ShadowTechnique>
#include <osgViewer/Viewer>

#include <vector>

namespace engine::osg_adapter {

/// A viewer without a window: its camera draws into an image of 32-bit floats.
class View {
public:
    View();

    /// Takes the camera and the size of the scene.
    void open(const Scene& scene);
    /// Draws one frame, and releases what GL has of it.
    /// @return  Four numbers a pixel, rows from the top; NaN where nothing is seen.
    [[nodiscard]] std::vector<float> draw(const osg::ref_ptr<osg::Node>& root,
                                          const osgShadow::ShadowTechnique& technique);
    [[nodiscard]] const osg::Camera& camera() const { return *viewer_->getCamera(); }

private:
    void attach_image();

    osg::ref_ptr<osgViewer::Viewer> viewer_;
    osg::ref_ptr<osg::GraphicsContext> context_;
    osg::ref_ptr<osg::Image> image_;
    int width_ = 0;
    int height_ = 0;
};

/// Bits of a depth that the driver stores for GL_DEPTH_COMPONENT, which osgShadow asks for.
[[nodiscard]] int depth_bits();

} // namespace engine::osg_adapter
