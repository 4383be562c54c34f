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

    /// Sets the camera and the size of the image from the scene.
    void open(const Scene& scene);
    /// Draws one frame, and releases its GL objects.
    /// @return  Four numbers a pixel, top row first; NaN for background.
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

/// The depth bits that the driver stores for GL_DEPTH_COMPONENT, the format of osgShadow.
[[nodiscard]] int depth_bits();

} // namespace engine::osg_adapter
