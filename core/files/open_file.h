// SPDX-License-Identifier: BSD-2-Clause
// Descriptor: an open file or folder, closed at the end.
#pragma once

#include <unistd.h>

namespace exphoton {

class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int Get() const { return value_; }
  bool IsOpen() const { return value_ >= 0; }
  // For the caller to close.
  int Release() {
    const int value = value_;
    value_ = -1;
    return value;
  }

 private:
  int value_;
};

}  // namespace exphoton
