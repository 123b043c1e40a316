// To be preloaded (LD_PRELOAD) into a command, glibc only: makes allocations, the start of threads or writing
// files fail. Environment:
//   FAIL_ALLOCATION=N         the Nth allocation fails, counted from 1
//   FAIL_ALLOCATIONS_FROM=N   so do all that follow
//   MOST_THREADS=N            no more than N threads can live at a time beside the first one, as under ulimit -u
//   FULL_DISK=N               after N bytes the disk is full, and the write that reaches it is short; not for standard
//                             output and error
//   COUNT=FILE                the numbers of allocations and of bytes are written there when the command ends

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

unsigned long fromEnvironment(const char* name)
{
    const char* text = std::getenv(name);
    return text ? std::strtoul(text, nullptr, 10) : 0;
}

struct Plan {
    unsigned long one = fromEnvironment("FAIL_ALLOCATION"), from = fromEnvironment("FAIL_ALLOCATIONS_FROM"),
                  mostThreads = fromEnvironment("MOST_THREADS");
    unsigned long mostBytes = fromEnvironment("FULL_DISK");
    bool limitsThreads = std::getenv("MOST_THREADS") != nullptr, limitsBytes = std::getenv("FULL_DISK") != nullptr;
};

const Plan& plan()
{
    static const Plan known;
    return known;
}

std::atomic<unsigned long> allocations{0}, bytes{0}, threads{0}; // so far; written so far; living

bool fails()
{
    const unsigned long number = ++allocations;
    if (number != plan().one && (plan().from == 0 || number < plan().from)) return false;
    errno = ENOMEM;
    return true;
}

struct Start {
    void* (*run)(void*);
    void* argument;
};

void* runCounted(void* data)
{
    const Start start = *static_cast<Start*>(data);
    delete static_cast<Start*>(data);
    struct Living {
        ~Living() { --threads; }
    } living;
    return start.run(start.argument);
}

__attribute__((destructor)) void writeCount()
{
    const char* path = std::getenv("COUNT");
    if (!path) return;
    const unsigned long allocationCount = allocations, byteCount = bytes;
    if (std::FILE* file = std::fopen(path, "w")) {
        std::fprintf(file, "%lu %lu\n", allocationCount, byteCount);
        std::fclose(file);
    }
}

} // namespace

extern "C" {

void* malloc(std::size_t size)
{
    return fails() ? nullptr : __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size)
{
    return fails() ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size)
{
    return fails() ? nullptr : __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size)
{
    return fails() ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size)
{
    return memalign(alignment, size);
}

int posix_memalign(void** result, std::size_t alignment, std::size_t size)
{
    *result = memalign(alignment, size);
    return *result ? 0 : ENOMEM;
}

ssize_t write(int descriptor, const void* data, std::size_t count)
{
    using Write = ssize_t (*)(int, const void*, std::size_t);
    static const auto real = reinterpret_cast<Write>(::dlsym(RTLD_NEXT, "write"));
    if (descriptor <= STDERR_FILENO) return real(descriptor, data, count);
    const unsigned long before = bytes.fetch_add(count);
    if (plan().limitsBytes && before + count > plan().mostBytes) {
        if (before >= plan().mostBytes) {
            errno = ENOSPC;
            return -1;
        }
        count = plan().mostBytes - before;
    }
    return real(descriptor, data, count);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*), void* argument)
{
    using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
    static const auto create = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
    if (++threads > plan().mostThreads && plan().limitsThreads) {
        --threads;
        return EAGAIN;
    }
    const int error = create(thread, attributes, runCounted, new Start{run, argument});
    if (error != 0) --threads;
    return error;
}
}
