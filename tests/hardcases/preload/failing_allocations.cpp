// SPDX-License-Identifier: BSD-2-Clause
// This library, loaded by LD_PRELOAD, makes memory allocations fail. FAIL_ALLOCATION is the number
// of the allocation that fails, counted from the start of main. If FAIL_ALLOCATION_SINCE is set,
// all later ones fail, too. COUNT_ALLOCATIONS names a file for the total number. The library needs
// glibc.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

using Main = int (*)(int, char**, char**);

std::atomic<long> counted{0};
std::atomic<bool> isCounting{false};
long failing = 0;
bool isForGood = false;
Main realMain = nullptr;

bool Fails() {
  if (!isCounting.load(std::memory_order_relaxed)) return false;
  const long number = 1 + counted.fetch_add(1, std::memory_order_relaxed);
  if (failing <= 0 || (isForGood ? number < failing : number != failing)) return false;
  errno = ENOMEM;
  return true;
}

int CountingMain(int argc, char** argv, char** environment) {
  const char* number = std::getenv("FAIL_ALLOCATION");
  failing = number ? std::atol(number) : 0;
  isForGood = std::getenv("FAIL_ALLOCATION_SINCE") != nullptr;
  isCounting = true;
  const int status = realMain(argc, argv, environment);
  isCounting = false;
  if (const char* path = std::getenv("COUNT_ALLOCATIONS")) {
    char text[32];
    const int length = std::snprintf(text, sizeof text, "%ld\n", counted.load());
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || write(file, text, std::size_t(length)) != length) return 99;
    close(file);
  }
  return status;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) { return Fails() ? nullptr : __libc_malloc(size); }

void* calloc(std::size_t count, std::size_t size) {
  return Fails() ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) {
  return Fails() ? nullptr : __libc_realloc(memory, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  return Fails() ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  if (Fails()) return ENOMEM;
  *memory = __libc_memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}

// The C library starts a program here. This version replaces main, so that earlier allocations are
// not counted.
int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*loaderFini)(), void* stack) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  realMain = main;
  const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(CountingMain, argc, argv, init, fini, loaderFini, stack);
}

}  // extern "C"
