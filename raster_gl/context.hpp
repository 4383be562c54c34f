#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::raster_gl {

/// The driver's description and limits.
struct GlFacts {
    std::string renderer;
    std::string version;
    std::string vendor;
    std::string platform; ///< "EGL device 0" or "surfaceless"
    int max_texture_texels = 0;
    int max_viewport_px = 0;
    int subpixel_bits = 0;
    float max_anisotropy = 1;  ///< 1 if not supported
    int max_depth_samples = 1; ///< per texel of a depth texture
};

/// A headless OpenGL 4.5 core context, current on the thread that made it.
///
/// `check` throws any error that GL's debug output reported since the last call. Destroy every GL
/// object before the context.
class Context {
public:
    /// @param device  index from `list_devices`; empty tries every device (hardware first), then
    ///                Mesa's surfaceless platform.
    /// @throws scene::EnvironmentError  if there is no driver or too little address space.
    explicit Context(std::optional<int> device = {});
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Makes the context current on the calling thread. It must not be current on another.
    /// @throws scene::EnvironmentError  if EGL refuses.
    void make_current() const;

    [[nodiscard]] const GlFacts& facts() const;
    /// @throws scene::EnvironmentError  if GL reported an error; names `doing` and GL's message.
    void check(std::string_view doing) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Saves the calling thread's current EGL context, whichever library made it, and restores it on
/// destruction.
class PreviousContext {
public:
    PreviousContext();
    ~PreviousContext();
    PreviousContext(const PreviousContext&) = delete;
    PreviousContext& operator=(const PreviousContext&) = delete;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// An EGL device that could render.
struct DeviceInfo {
    int index = 0;
    std::string description; ///< DRM node, "software", or the driver's extension string
};

/// @return The EGL devices, hardware before software; empty if EGL cannot list them.
/// @throws scene::EnvironmentError  if there is no EGL at all.
[[nodiscard]] std::vector<DeviceInfo> list_devices();

} // namespace gnomon::raster_gl
