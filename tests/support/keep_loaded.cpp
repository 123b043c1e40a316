// Linked into programs that sanitizers watch. LeakSanitizer looks for pointers when a program has ended: what OpenGL's
// drivers still point to would be lost with their variables if they were unloaded before.
#include <dlfcn.h>

extern "C" int dlclose(void* /*library*/) noexcept
{
    return 0;
}
