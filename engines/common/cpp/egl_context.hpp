#pragma once

#include <string>

namespace engine {

/// A headless GL context with the fixed-function pipeline, current in the thread that creates it.
class EglContext {
public:
    /// @throws std::runtime_error  naming the EGL call that failed.
    EglContext();
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;
    ~EglContext();

    /// GL_RENDERER.
    [[nodiscard]] std::string device() const;
    /// GL_MAX_TEXTURE_SIZE [texels].
    [[nodiscard]] int most_texels() const;

private:
    void* display_ = nullptr;
    void* context_ = nullptr;
};

} // namespace engine
