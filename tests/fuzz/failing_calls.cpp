// failing_calls.cpp -- preloaded into a program, lets the n-th allocation, write or opening of a file fail.
//
// Not counted are writes to the standard streams, and allocations by HDF5, which ends the program by exit(-1) or a
// signal where it gets no memory. INSONIFY_FAIL="allocation 123" in the environment lets the 123rd since the start of
// main() fail, with 0 none; INSONIFY_CALLS=FILE has the number of such calls written at the end of main().

#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

enum Kind { kAllocation, kWrite, kOpen, kNone };

Kind failing = kNone;
long fails_at = 0;
std::atomic<long> calls = 0;

std::uintptr_t hdf5_begin = 0, hdf5_end = 0;  // Its code in memory.

int find_hdf5(dl_phdr_info* library, std::size_t /*size*/, void* /*data*/) {
  for (int i = 0; std::strstr(library->dlpi_name, "libhdf5") != nullptr && i < library->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = library->dlpi_phdr[i];
    if (part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0) {
      hdf5_begin = library->dlpi_addr + part.p_vaddr;
      hdf5_end = hdf5_begin + part.p_memsz;
    }
  }
  return 0;
}

// Whether this call is the one to fail.
bool fails(Kind kind, int reason) {
  if (kind != failing || ++calls != fails_at) {
    return false;
  }
  errno = reason;
  return true;
}

// The same for an allocation that returns to `caller`.
bool fails(const void* caller) {
  const auto place = reinterpret_cast<std::uintptr_t>(caller);
  return (place < hdf5_begin || place >= hdf5_end) && fails(kAllocation, ENOMEM);
}

bool is_output(int file) {
  return file == STDOUT_FILENO || file == STDERR_FILENO;
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int (*program)(int, char**, char**) = nullptr;

int counted_main(int count, char** words, char** environment) {
  const char* const kinds[] = {"allocation", "write", "open"};
  const char* const wanted = std::getenv("INSONIFY_FAIL");
  for (int kind = 0; wanted != nullptr && kind < kNone; ++kind) {
    if (std::strncmp(wanted, kinds[kind], std::strlen(kinds[kind])) == 0) {
      fails_at = std::atol(wanted + std::strlen(kinds[kind]));
      failing = static_cast<Kind>(kind);
    }
  }
  dl_iterate_phdr(find_hdf5, nullptr);
  const int status = program(count, words, environment);
  failing = kNone;
  if (const char* const file = std::getenv("INSONIFY_CALLS");
      file != nullptr && std::strstr(words[0], "read") == nullptr) {
    std::FILE* const out = std::fopen(file, "w");
    std::fprintf(out, "%ld\n", calls.load());
    std::fclose(out);
  }
  return status;
}

int mode_of(int flags, va_list list) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(list, int) : 0;
}

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  return fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  return fails(__builtin_return_address(0)) ? nullptr : __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  return fails(__builtin_return_address(0)) ? nullptr : __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = fails(__builtin_return_address(0)) ? nullptr : __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
char* strdup(const char* text) {  // The C library's own would hide its caller.
  const std::size_t size = std::strlen(text) + 1;
  void* const copy = fails(__builtin_return_address(0)) ? nullptr : __libc_malloc(size);
  return copy == nullptr ? nullptr : static_cast<char*>(std::memcpy(copy, text, size));
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  static auto* const next = real<ssize_t(int, const void*, std::size_t)>("write");
  return !is_output(file) && fails(kWrite, ENOSPC) ? -1 : next(file, bytes, size);
}
ssize_t writev(int file, const iovec* pieces, int count) {
  static auto* const next = real<ssize_t(int, const iovec*, int)>("writev");
  return !is_output(file) && fails(kWrite, ENOSPC) ? -1 : next(file, pieces, count);
}
ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t place) {
  static auto* const next = real<ssize_t(int, const void*, std::size_t, off_t)>("pwrite");
  return fails(kWrite, ENOSPC) ? -1 : next(file, bytes, size, place);
}
ssize_t pwrite64(int file, const void* bytes, std::size_t size, off64_t place) {
  return pwrite(file, bytes, size, place);
}
std::size_t fwrite(const void* bytes, std::size_t size, std::size_t count, std::FILE* file) {
  static auto* const next = real<std::size_t(const void*, std::size_t, std::size_t, std::FILE*)>("fwrite");
  return file != stdout && file != stderr && fails(kWrite, ENOSPC) ? 0 : next(bytes, size, count, file);
}

int open(const char* path, int flags, ...) {
  static auto* const next = real<int(const char*, int, ...)>("open");
  va_list list;
  va_start(list, flags);
  const int mode = mode_of(flags, list);
  va_end(list);
  return fails(kOpen, EIO) ? -1 : next(path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
  static auto* const next = real<int(int, const char*, int, ...)>("openat");
  va_list list;
  va_start(list, flags);
  const int mode = mode_of(flags, list);
  va_end(list);
  return fails(kOpen, EIO) ? -1 : next(folder, path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const int mode = mode_of(flags, list);
  va_end(list);
  return open(path, flags, mode);
}
int openat64(int folder, const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const int mode = mode_of(flags, list);
  va_end(list);
  return openat(folder, path, flags, mode);
}
std::FILE* fopen(const char* path, const char* mode) {
  static auto* const next = real<std::FILE*(const char*, const char*)>("fopen");
  return fails(kOpen, EIO) ? nullptr : next(path, mode);
}
std::FILE* fopen64(const char* path, const char* mode) {
  return fopen(path, mode);
}

int __libc_start_main(int (*given)(int, char**, char**), int count, char** words, void (*begin)(), void (*end)(),
                      void (*loader_end)(), void* stack) {
  program = given;
  return real<int(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*)>(
      "__libc_start_main")(counted_main, count, words, begin, end, loader_end, stack);
}
}
