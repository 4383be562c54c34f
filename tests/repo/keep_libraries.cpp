// Keeps libraries loaded until the process ends, in every program of a sanitizer build. EGL unloads
// its driver, and LeakSanitizer then reports what the driver's globals still reach as leaks of an
// unknown module.
#include <dlfcn.h>

int dlclose(void* /*handle*/)
{
    return 0;
}
