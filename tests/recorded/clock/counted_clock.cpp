// SPDX-License-Identifier: BSD-2-Clause
// A library to preload, in which time is a count: each reading of a clock by the main thread adds
// 10 ms, and a child process is reported with 50 ms more than the one before it. So the program
// prints the same times, forecasts and decisions in each run with one thread. Readings of other
// threads do not add to the time; a thread that waits until a time looks every millisecond whether
// it has come. The peak memory is 100 MiB. If COUNTED_INTERRUPT is n, the main thread gets SIGINT
// at its n-th reading.
#include <dlfcn.h>
#include <pthread.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace {

constexpr std::int64_t kReading = 10000000;           // nanoseconds
constexpr std::int64_t kStart = 1000000000000000000;  // nanoseconds: in September 2001
constexpr long kPeakMemory = 100 * 1024;              // KiB
std::atomic<std::int64_t> elapsed{0};                 // nanoseconds
std::atomic<std::int64_t> children{0};

std::int64_t ReadClock() {
  static thread_local const bool isMainThread = syscall(SYS_gettid) == getpid();
  if (!isMainThread) return elapsed;
  static const char* const interrupt = std::getenv("COUNTED_INTERRUPT");
  static long readings = 0;
  if (++readings == (interrupt ? std::atol(interrupt) : 0)) std::raise(SIGINT);
  return elapsed += kReading;
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const std::int64_t now = ReadClock() + (clock == CLOCK_REALTIME ? kStart : 0);
  time->tv_sec = now / 1000000000;
  time->tv_nsec = now % 1000000000;
  return 0;
}

__attribute__((visibility("default"))) std::time_t time(std::time_t* result) noexcept {
  const std::time_t now = kStart / 1000000000;
  if (result) *result = now;
  return now;
}

__attribute__((visibility("default"))) int getrusage(__rusage_who_t, rusage* usage) noexcept {
  *usage = {};
  usage->ru_maxrss = kPeakMemory;
  return 0;
}

// Waits a real millisecond at most. The caller compares counted times afterwards and waits again.
__attribute__((visibility("default"))) int pthread_cond_clockwait(pthread_cond_t* condition,
                                                                  pthread_mutex_t* mutex,
                                                                  clockid_t clock,
                                                                  const timespec*) {
  using Function = int (*)(pthread_cond_t*, pthread_mutex_t*, clockid_t, const timespec*);
  static const auto original = Function(dlsym(RTLD_NEXT, "pthread_cond_clockwait"));
  timespec end;
  syscall(SYS_clock_gettime, clock, &end);
  end.tv_nsec += 1000000;
  if (end.tv_nsec >= 1000000000) {
    end.tv_nsec -= 1000000000;
    ++end.tv_sec;
  }
  return original(condition, mutex, clock, &end);
}

__attribute__((visibility("default"))) pid_t wait4(pid_t process, int* status, int options,
                                                   rusage* usage) {
  using Function = pid_t (*)(pid_t, int*, int, rusage*);
  static const auto original = Function(dlsym(RTLD_NEXT, "wait4"));
  const pid_t ended = original(process, status, options, usage);
  if (ended > 0 && usage) {
    const std::int64_t milliseconds = 50 * ++children;
    elapsed += milliseconds * 1000000;
    *usage = {};
    usage->ru_utime = {milliseconds / 1000, milliseconds % 1000 * 1000};
    usage->ru_maxrss = kPeakMemory;
  }
  return ended;
}

}  // extern "C"
