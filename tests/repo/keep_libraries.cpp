// Linked into every program of a sanitizer build: libraries stay loaded until the process ends.
// EGL unloads its driver, and what the driver still held is then reported as a leak of an unknown
// module. A library that stays keeps its globals: what they reach is no leak, so no leak needs to
// be suppressed, and stack traces have names.
#include <dlfcn.h>

int dlclose(void* /*handle*/)
{
    return 0;
}
