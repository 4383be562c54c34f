#pragma once

#include <string>

namespace engine {

/// A GL context with the fixed functions, current in the thread that makes it, without a window and
/// without a display.
class EglContext {
public:
    /// @throws std::runtime_error  naming the EGL call that failed.
    EglContext();
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext();

    /// GL_RENDERER.
    [[nodiscard]] std::string device() const;
    /// GL_MAX_TEXTURE_SIZE: the most texels along a side.
    [[nodiscard]] int most_texels() const;

private:
    void* display_ = nullptr;
    void* context_ = nullptr;
};

} // namespace engine
