// SPDX-License-Identifier: BSD-2-Clause
// ThreadState: what an integrator keeps for all that one thread renders in a pass: things found
// once and of use for other pixels. They must follow from the scene and from what Preprocess made
// alone, so that it makes no difference which thread renders what, and in which order. One a
// thread.
#pragma once

#include <memory>
#include <utility>

namespace exphoton {

class ThreadState {
 public:
  void Reset() { note_.reset(); }

  // The note of this pass, T(args...) when it is first asked for. An integrator keeps one type
  // only.
  template <class T, class... Args>
  T& Note(Args&&... args) {
    if (!note_) note_ = std::make_shared<T>(std::forward<Args>(args)...);
    return *static_cast<T*>(note_.get());
  }

 private:
  std::shared_ptr<void> note_;
};

}  // namespace exphoton
