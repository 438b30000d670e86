// SPDX-License-Identifier: BSD-2-Clause
// ThreadState keeps data of an integrator that one thread can reuse for other pixels of a pass,
// such as a cache. The data must follow from the scene and the results of Preprocess alone. The
// picture then does not depend on which thread renders which pixel, or in which order. There is one
// object per thread.
#pragma once

#include <memory>
#include <utility>

namespace exphoton {

class ThreadState {
 public:
  void Reset() { data_.reset(); }

  // Returns the integrator's data of this pass. The first call creates a T(args...). An integrator
  // uses a single type T.
  template <class T, class... Args>
  T& Get(Args&&... args) {
    if (!data_) data_ = std::make_shared<T>(std::forward<Args>(args)...);
    return *static_cast<T*>(data_.get());
  }

 private:
  std::shared_ptr<void> data_;
};

}  // namespace exphoton
