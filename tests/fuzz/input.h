// SPDX-License-Identifier: BSD-2-Clause
// Input reads the bytes of a fuzzer as numbers. Beyond the end all bytes are 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/math/vec.h"

namespace exphoton::fuzz {

class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool IsEmpty() const { return size_ == 0; }
  std::uint8_t Byte() { return Take<std::uint8_t>(); }
  float Float() { return Take<float>(); }  // any bits: NaN, infinite, denormal
  Point3 AnyPoint() {
    const float x = Float(), y = Float(), z = Float();
    return {Real(x), Real(y), Real(z)};
  }

 private:
  template <class T>
  T Take() {
    T value{};
    const std::size_t count = size_ < sizeof value ? size_ : sizeof value;
    std::memcpy(&value, data_, count);
    data_ += count;
    size_ -= count;
    return value;
  }

  const std::uint8_t* data_;
  std::size_t size_;
};

// Aborts if a promise is broken, so that the fuzzer reports it like a crash.
inline void Require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

}  // namespace exphoton::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
