// Linked into every program of a sanitizer build: libraries stay loaded until the process ends.
// EGL unloads its driver, and what that driver still held is then reported as a leak of an unknown
// module, which no suppression can name. A library that stays keeps its globals, so what they reach
// is no leak, and stack traces have names.
#include <dlfcn.h>

int dlclose(void* /*handle*/)
{
    return 0;
}
