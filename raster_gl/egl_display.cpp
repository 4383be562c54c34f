#include "raster_gl/egl_display.hpp"

#include "raster_gl/device_list.hpp"
#include "scene/error.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace gnomon::raster_gl {
namespace {

/// epoxy aborts the process when it cannot load libEGL or finds nothing in it: look first.
void require_libegl()
{
    static void* const library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr || dlsym(library, "eglQueryString") == nullptr) {
        throw scene::EnvironmentError(
            fmt::format("EGL: libEGL.so.1 cannot be loaded: {}", driver_remedy));
    }
    // Mesa's own warnings would mix with our one-line errors; whoever wants them sets the variable.
    setenv("EGL_LOG_LEVEL", "fatal", 0);
}

bool has_client_extension(const char* name)
{
    return epoxy_has_egl_extension(EGL_NO_DISPLAY, name);
}

bool has_word(const char* list, std::string_view word)
{
    return list != nullptr && std::string_view{list}.find(word) != std::string_view::npos;
}

struct Device {
    EGLDeviceEXT handle = EGL_NO_DEVICE_EXT;
    bool software = false;
    std::string description;
};

Device describe(EGLDeviceEXT handle)
{
    const char* extensions = eglQueryDeviceStringEXT(handle, EGL_EXTENSIONS);
    Device device{handle, has_word(extensions, "EGL_MESA_device_software"), {}};
    if (device.software) {
        device.description = "software";
    } else if (has_word(extensions, "EGL_EXT_device_drm")) {
        const char* node = eglQueryDeviceStringEXT(handle, EGL_DRM_DEVICE_FILE_EXT);
        device.description = node != nullptr ? node : "DRM device";
    } else {
        device.description = extensions != nullptr ? extensions : "unnamed";
    }
    return device;
}

/// All devices, hardware before software, else in EGL's order.
std::vector<Device> query_devices()
{
    const bool can_list = has_client_extension("EGL_EXT_device_base") ||
                          has_client_extension("EGL_EXT_device_enumeration");
    EGLint count = 0;
    if (!can_list || eglQueryDevicesEXT(0, nullptr, &count) == EGL_FALSE || count <= 0) {
        return {};
    }
    std::vector<EGLDeviceEXT> handles(static_cast<std::size_t>(count));
    if (eglQueryDevicesEXT(count, handles.data(), &count) == EGL_FALSE) {
        return {};
    }
    handles.resize(static_cast<std::size_t>(count));
    std::vector<Device> devices;
    std::transform(handles.begin(), handles.end(), std::back_inserter(devices), describe);
    std::stable_partition(devices.begin(), devices.end(),
                          [](const Device& device) { return !device.software; });
    return devices;
}

EglDisplay display_of(const Device& device, std::size_t index)
{
    return {eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device.handle, nullptr),
            fmt::format("EGL device {}", index)};
}

} // namespace

std::string egl_failure(const char* call)
{
    return fmt::format("{} failed (EGL error 0x{:04x})", call, eglGetError());
}

std::vector<EglDisplay> candidate_displays(std::optional<int> device)
{
    require_libegl();
    const bool has_device_platform = has_client_extension("EGL_EXT_platform_device");
    const std::vector<Device> devices = query_devices();
    if (device) {
        if (!has_device_platform || devices.empty()) {
            throw scene::EnvironmentError(
                fmt::format("--device {}: EGL lists no devices: {}", *device, driver_remedy));
        }
        if (*device < 0 || static_cast<std::size_t>(*device) >= devices.size()) {
            const std::string others =
                devices.size() == 1 ? "0" : fmt::format("0 to {}", devices.size() - 1);
            throw scene::InputError(
                fmt::format("--device {}: EGL lists only {}; `gnomon doctor` names what they are",
                            *device, others));
        }
        const auto index = static_cast<std::size_t>(*device);
        return {display_of(devices[index], index)};
    }
    std::vector<EglDisplay> candidates;
    for (std::size_t i = 0; has_device_platform && i < devices.size(); ++i) {
        candidates.push_back(display_of(devices[i], i));
    }
    if (has_client_extension("EGL_MESA_platform_surfaceless")) {
        candidates.push_back(
            {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
             "surfaceless"});
    }
    return candidates;
}

std::vector<DeviceInfo> list_devices()
{
    require_libegl();
    std::vector<DeviceInfo> result;
    for (const Device& device : query_devices()) {
        result.push_back({static_cast<int>(result.size()), device.description});
    }
    return result;
}

} // namespace gnomon::raster_gl
