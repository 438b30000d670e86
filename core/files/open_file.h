// SPDX-License-Identifier: BSD-2-Clause
// Descriptor owns the descriptor of an open file or folder and closes it on destruction.
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
  // Gives up ownership. The caller must close the returned descriptor.
  int Release() {
    const int value = value_;
    value_ = -1;
    return value;
  }

 private:
  int value_;
};

}  // namespace exphoton
