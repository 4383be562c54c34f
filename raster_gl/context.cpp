#include "raster_gl/context.hpp"

#include "scene/error.hpp"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace gnomon::raster_gl {

struct Context::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    GlFacts facts;
    std::string first_error; ///< from the debug output, since the last check

    ~State()
    {
        if (display != EGL_NO_DISPLAY) {
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            if (context != EGL_NO_CONTEXT) {
                eglDestroyContext(display, context);
            }
            eglTerminate(display);
        }
    }
};

namespace {

/// The remedy that ends each message about a missing driver.
constexpr const char* driver_remedy =
    "install a driver (Debian: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri) and see "
    "`gnomon doctor`";

/// Checks first because epoxy aborts the process if it cannot load libEGL.
void require_libegl()
{
    static void* const library = dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL);
    if (library == nullptr || dlsym(library, "eglQueryString") == nullptr) {
        throw scene::EnvironmentError(
            fmt::format("EGL: libEGL.so.1 cannot be loaded: {}", driver_remedy));
    }
    // Mesa's warnings would mix with our one-line errors. Set the variable to see them.
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

/// A display that EGL initialised.
struct EglDisplay {
    EGLDisplay display = EGL_NO_DISPLAY;
    std::string platform; ///< "EGL device 0" or "surfaceless"
};

EglDisplay display_of(const Device& device, std::size_t index)
{
    return {eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device.handle, nullptr),
            fmt::format("EGL device {}", index)};
}

/// "eglInitialize failed: EGL_NOT_INITIALIZED (0x3001)".
std::string egl_failure(const char* call)
{
    return fmt::format("{} failed (EGL error 0x{:04x})", call, eglGetError());
}

/// Uninitialised displays to try, in order: the requested device; or all devices, hardware first,
/// then Mesa's surfaceless platform.
/// @throws scene::EnvironmentError  if libEGL is missing or the device does not exist.
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

/// Mesa and its LLVM crash when an allocation fails. A comparison of 64×36 pixels crashed with 800
/// MiB, or Embree could not create its device; with 1,000 MiB it passed.
constexpr rlim_t least_address_space = rlim_t{1} << 30U;

void require_address_space()
{
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur < least_address_space) {
        throw scene::EnvironmentError(fmt::format(
            "the address space is limited to {} MiB; GL and Embree need {}: raise the limit with "
            "`ulimit -v`",
            limit.rlim_cur >> 20U, least_address_space >> 20U));
    }
}

void on_debug_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum /*severity*/,
                      GLsizei length, const GLchar* message, const void* user)
{
    // GL declares the user pointer const; it is the string that we registered.
    auto* first_error = static_cast<std::string*>(const_cast<void*>(user));
    const bool is_error = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
    if (is_error && first_error->empty()) {
        try {
            first_error->assign(message, static_cast<std::size_t>(length));
            std::replace(first_error->begin(), first_error->end(), '\n', ' ');
        } catch (...) {
            return; // out of memory for the text; glGetError still reports the error
        }
    }
}

EGLContext create_context(EGLDisplay display)
{
    constexpr std::array<EGLint, 3> any_gl{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
        eglChooseConfig(display, any_gl.data(), &config, 1, &count) == EGL_FALSE) {
        return EGL_NO_CONTEXT;
    }
    constexpr std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               4,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               5,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_CONTEXT_OPENGL_DEBUG,
                                               EGL_TRUE,
                                               EGL_NONE};
    // Nothing is drawn to a surface, so a display without a config will do.
    return eglCreateContext(display, count > 0 ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT,
                            attributes.data());
}

std::string gl_string(GLenum name)
{
    const auto* text = glGetString(name);
    // GL returns UTF-8 bytes as unsigned char.
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

GlFacts query_facts(std::string platform)
{
    GlFacts facts{gl_string(GL_RENDERER), gl_string(GL_VERSION), gl_string(GL_VENDOR),
                  std::move(platform)};
    std::array<GLint, 2> viewport{};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &facts.max_texture_texels);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    facts.max_viewport_px = std::min(viewport[0], viewport[1]);
    glGetIntegerv(GL_SUBPIXEL_BITS, &facts.subpixel_bits);
    glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &facts.max_depth_samples);
    if (epoxy_gl_version() >= 46 || epoxy_has_gl_extension("GL_ARB_texture_filter_anisotropic") ||
        epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) {
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &facts.max_anisotropy);
    }
    return facts;
}

/// Tries one display; on failure returns why.
std::string try_display(const EglDisplay& candidate, EGLDisplay& display, EGLContext& context)
{
    if (candidate.display == EGL_NO_DISPLAY ||
        eglInitialize(candidate.display, nullptr, nullptr) == EGL_FALSE) {
        return egl_failure("eglInitialize");
    }
    display = candidate.display;
    context = create_context(display);
    if (context == EGL_NO_CONTEXT) {
        return egl_failure("eglCreateContext (OpenGL 4.5 core)");
    }
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
        return egl_failure("eglMakeCurrent without a surface");
    }
    return {};
}

} // namespace

Context::Context(std::optional<int> device)
{
    require_address_space();
    std::string failures;
    for (const EglDisplay& candidate : candidate_displays(device)) {
        auto state = std::make_unique<State>();
        const std::string failure = try_display(candidate, state->display, state->context);
        if (failure.empty()) {
            state->facts = query_facts(candidate.platform);
            glEnable(GL_DEBUG_OUTPUT);
            glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
            glDebugMessageCallback(on_debug_message, &state->first_error);
            glPixelStorei(GL_PACK_ALIGNMENT, 1);
            state_ = std::move(state);
            return;
        }
        failures +=
            fmt::format("{}{}: {}", failures.empty() ? "" : "; ", candidate.platform, failure);
    }
    throw scene::EnvironmentError(fmt::format("no OpenGL 4.5 context: {}: {}",
                                              failures.empty() ? "EGL offers no display" : failures,
                                              driver_remedy));
}

Context::~Context() = default;

void Context::make_current() const
{
    if (eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context) ==
        EGL_FALSE) {
        throw scene::EnvironmentError(fmt::format("{}: {}", egl_failure("eglMakeCurrent"),
                                                  "is the context current on another thread?"));
    }
}

const GlFacts& Context::facts() const
{
    return state_->facts;
}

void Context::check(std::string_view doing) const
{
    const GLenum code = glGetError();
    if (code == GL_NO_ERROR && state_->first_error.empty()) {
        return;
    }
    while (glGetError() != GL_NO_ERROR) {
    }
    const std::string message = std::exchange(state_->first_error, {});
    throw scene::EnvironmentError(fmt::format(
        "{}: GL error 0x{:04x}{}{}: {}", doing, code, message.empty() ? "" : ": ", message,
        code == GL_OUT_OF_MEMORY ? "use a smaller image or map, or free memory"
                                 : "report it with the output of `gnomon doctor`"));
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

struct PreviousContext::State {
    EGLDisplay display = eglGetCurrentDisplay();
    EGLSurface drawn = eglGetCurrentSurface(EGL_DRAW);
    EGLSurface read = eglGetCurrentSurface(EGL_READ);
    EGLContext context = eglGetCurrentContext();
};

PreviousContext::PreviousContext() : state_{std::make_unique<State>()} {}

PreviousContext::~PreviousContext()
{
    if (state_->context != EGL_NO_CONTEXT) {
        eglMakeCurrent(state_->display, state_->drawn, state_->read, state_->context);
    } else if (const EGLDisplay display = eglGetCurrentDisplay(); display != EGL_NO_DISPLAY) {
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    }
}

} // namespace gnomon::raster_gl
