#include "raster_gl/context.hpp"

#include "raster_gl/egl_display.hpp"
#include "scene/error.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon::raster_gl {

struct Context::State {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;
    GlFacts facts;
    std::string first_error; ///< from the debug output since the last check

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

/// Mesa and its LLVM do not look whether they get memory, and crash. With 800 MiB even a comparison
/// of 64×36 pixels did, or Embree found no room for its device; with 1,000 one passed.
constexpr rlim_t least_address_space = rlim_t{1} << 30U;

void require_address_space()
{
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur < least_address_space) {
        throw scene::EnvironmentError(fmt::format(
            "a process may have {} MiB of addresses here, and GL and Embree need {}: raise it with "
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
            return; // no memory for the text: glGetError still tells that there was an error
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
    // Nothing is ever drawn to a surface, so a display without any config serves as well.
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
