// SPDX-License-Identifier: BSD-2-Clause
// The memory of the machine and of the process, by sysconf and getrlimit; and the rare work of
// Arena, which takes blocks from the heap.
#include "core/base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/arena.h"

namespace exphoton {
namespace {

// Returns the smallest memory limit of the process, or infinity if there is none.
double ProcessLimit() {
  double least = HUGE_VAL;
  for (const auto resource : {RLIMIT_AS, RLIMIT_DATA}) {
    rlimit limit{};
    if (getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      least = std::min(least, double(limit.rlim_cur));
  }
  return least;
}

double Rounded(double bytes) { return std::ceil(bytes / 1048576); }

int PrintLimit(char* text, std::size_t size, const char* prefix) {
  const double limit = ProcessLimit(), physical = PhysicalMemory();
  if (limit < physical)
    return std::snprintf(text, size, "%sthis process may use %.0f MB", prefix, Rounded(limit));
  return std::snprintf(text, size, "%sthis machine has %.0f MB of memory", prefix,
                       Rounded(physical));
}

}  // namespace

double PhysicalMemory() { return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE)); }

double UsableMemory() { return std::min(ProcessLimit(), PhysicalMemory()); }

std::string Megabytes(double bytes) {
  return std::to_string(static_cast<long long>(Rounded(bytes))) + " MB";
}

std::string MemoryLimit() {
  char text[100];
  PrintLimit(text, sizeof text, "");
  return text;
}

const char* OutOfMemoryText() {
  static char text[120];  // static, because nothing can be allocated here
  PrintLimit(text, sizeof text, "out of memory: ");
  return text;
}

Arena::Arena() = default;
Arena::~Arena() = default;

void* Arena::AllocateInNewBlock(std::size_t bytes) {
  const std::size_t size = bytes > kBlockBytes ? bytes : kBlockBytes;
  blocks_.push_back({std::make_unique<std::byte[]>(size), size});
  used_ = bytes;
  return blocks_.back().data.get();
}

}  // namespace exphoton
