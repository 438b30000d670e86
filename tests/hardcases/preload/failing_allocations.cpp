// SPDX-License-Identifier: BSD-2-Clause
// A library to preload (LD_PRELOAD) that lets an allocation fail: the one with the number
// FAIL_ALLOCATION, counted from the start of main, and with FAIL_ALLOCATION_SINCE=1 every one after
// it. COUNT_ALLOCATIONS names a file that gets how many there were. glibc only.
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

// The C library's start of a program: main is replaced, so that what comes before does not count.
int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*loaderFini)(), void* stack) {
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  realMain = main;
  const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(CountingMain, argc, argv, init, fini, loaderFini, stack);
}

}  // extern "C"
