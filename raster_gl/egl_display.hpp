#pragma once

#include <epoxy/egl.h>

#include <optional>
#include <string>
#include <vector>

namespace gnomon::raster_gl {

/// A display that EGL initialised.
struct EglDisplay {
    EGLDisplay display = EGL_NO_DISPLAY;
    std::string platform; ///< "EGL device 0" or "surfaceless"
};

/// Displays to try, in order: the device asked for; or all devices, hardware first, then Mesa's
/// surfaceless platform. Not initialised yet.
/// @throws scene::EnvironmentError  if libEGL is missing or the device does not exist.
[[nodiscard]] std::vector<EglDisplay> candidate_displays(std::optional<int> device);

/// "eglInitialize failed: EGL_NOT_INITIALIZED (0x3001)".
[[nodiscard]] std::string egl_failure(const char* call);

/// What to do when no driver is found; ends every message about a missing one.
inline constexpr const char* driver_remedy =
    "install a driver (Debian: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri) and see "
    "`gnomon doctor`";

} // namespace gnomon::raster_gl
