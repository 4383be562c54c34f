#include "view.hpp"

#include "graph.hpp"

#include <GL/gl.h>
#include <GL/glext.h>
#include <osg/GLObjects>

#include <cstddef>
#include <limits>
#include <stdexcept>

namespace engine::osg_adapter {
namespace {

/// Reverses the order of rows, with four floats a pixel.
std::vector<float> flipped(const osg::Image& image)
{
    const std::ptrdiff_t row = 4 * static_cast<std::ptrdiff_t>(image.s());
    const auto* const values = reinterpret_cast<const float*>(image.data());
    std::vector<float> rows;
    for (std::ptrdiff_t y = image.t() - 1; y >= 0; --y) {
        rows.insert(rows.end(), values + row * y, values + row * (y + 1));
    }
    return rows;
}

} // namespace

View::View() : viewer_{new osgViewer::Viewer}
{
    viewer_->setThreadingModel(osgViewer::Viewer::SingleThreaded);
    viewer_->setUpViewerAsEmbeddedInWindow(0, 0, 1, 1);
    viewer_->setLightingMode(osg::View::NO_LIGHT);
    viewer_->setReleaseContextAtEndOfFrameHint(false);
    osg::Camera& camera = *viewer_->getCamera();
    context_ = camera.getGraphicsContext();
    camera.setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
    camera.setClearColor({nothing, nothing, nothing, nothing});
}

void View::attach_image()
{
    osg::Camera& camera = *viewer_->getCamera();
    image_ = new osg::Image;
    image_->allocateImage(width_, height_, 1, GL_RGBA, GL_FLOAT);
    image_->setInternalTextureFormat(GL_RGBA32F);
    camera.attach(osg::Camera::COLOR_BUFFER, image_.get());
    camera.attach(osg::Camera::DEPTH_BUFFER, GL_DEPTH_COMPONENT32F);
    camera.dirtyAttachmentMap();
}

void View::open(const Scene& scene)
{
    width_ = scene.width;
    height_ = scene.height;
    osg::Camera& camera = *viewer_->getCamera();
    const Planes planes = camera_planes(scene);
    const double aspect = static_cast<double>(width_) / height_;
    if (scene.camera.orthographic_height) {
        const double half = *scene.camera.orthographic_height / 2;
        camera.setProjectionMatrixAsOrtho(-half * aspect, half * aspect, -half, half, planes.near,
                                          planes.far);
    } else {
        camera.setProjectionMatrixAsPerspective(*scene.camera.vertical_fov_deg, aspect, planes.near,
                                                planes.far);
    }
    camera.setViewMatrixAsLookAt(osg_vector(scene.camera.eye), osg_vector(scene.camera.target),
                                 osg_vector(scene.camera.up));
    context_->resized(0, 0, width_, height_);
    camera.setViewport(0, 0, width_, height_);
    attach_image();
}

std::vector<float> View::draw(const osg::ref_ptr<osg::Node>& root,
                              const osgShadow::ShadowTechnique& technique)
{
    viewer_->setSceneData(root);
    viewer_->frame();
    viewer_->setSceneData(nullptr);
    osg::State& state = *context_->getState();
    root->releaseGLObjects(&state);
    technique.releaseGLObjects(&state);
    osg::flushAllDeletedGLObjects(state.getContextID());
    if (state.checkGLErrors("the end of a frame")) {
        throw std::runtime_error{"OpenGL has refused something, see standard error"};
    }
    return flipped(*image_);
}

int depth_bits()
{
    GLuint texture = 0;
    GLint bits = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 1, 1, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                 nullptr);
    glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_DEPTH_SIZE, &bits);
    glBindTexture(GL_TEXTURE_2D, 0);
    glDeleteTextures(1, &texture);
    return bits;
}

} // namespace engine::osg_adapter
