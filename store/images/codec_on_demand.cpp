// For programs that load OpenImageIO with the first image they read or write.
#include "scene/error.hpp"
#include "store/images/codec_module.hpp"

#include <fmt/format.h>

#include <dlfcn.h>

#include <system_error>

namespace gnomon::store {

namespace {

const ImageCodec* loaded_codec()
{
    std::error_code error;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (error) { // no relative path: what lies in the working directory must not be loaded
        throw scene::EnvironmentError(
            fmt::format("images can be neither read nor written: /proc/self/exe: {}; mount /proc",
                        error.message()));
    }
    const auto module = (program.parent_path() / GNOMON_IMAGES_FROM_PROGRAM).lexically_normal();
    // Never closed: OpenImageIO's own threads may outlive whatever asked for it.
    void* const library = ::dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const entry = library == nullptr ? nullptr : ::dlsym(library, "gnomon_image_codec");
    if (entry == nullptr) {
        const char* const reason = ::dlerror();
        throw scene::EnvironmentError(fmt::format(
            "images can be neither read nor written: {}; install Gnomon again, whole, with cmake "
            "--install",
            reason == nullptr ? module.string() : reason));
    }
    return reinterpret_cast<decltype(&gnomon_image_codec)>(entry)();
}

} // namespace

const ImageCodec& image_codec()
{
    static const ImageCodec* const codec = loaded_codec();
    return *codec;
}

} // namespace gnomon::store
