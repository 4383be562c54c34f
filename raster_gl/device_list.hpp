#pragma once

#include <string>
#include <vector>

namespace gnomon::raster_gl {

/// An EGL device that could render.
struct DeviceInfo {
    int index = 0;
    std::string description; ///< DRM node, "software", or the driver's extension string
};

/// @return the EGL devices, hardware before software; empty where EGL cannot list them.
/// @throws scene::EnvironmentError  if there is no EGL at all.
[[nodiscard]] std::vector<DeviceInfo> list_devices();

} // namespace gnomon::raster_gl
