// SPDX-License-Identifier: BSD-2-Clause
// PixelState keeps data of an integrator from one camera sample of a pixel to the next; such rays
// mostly hit the same surface. The renderer resets it for each pixel and pass, so that no pixel
// depends on other pixels. The data must not depend on the radiance of a sample, or the mean over
// the samples would be biased. There is one object per thread.
#pragma once

#include "core/base/arena.h"

namespace exphoton {

class PixelState {
 public:
  void Reset() { data_ = nullptr, arena_.Reset(); }

  // Returns the integrator's data of this pixel. The first call creates a T(). An integrator uses a
  // single type T, which must be trivially destructible.
  template <class T>
  T& Get() {
    static_assert(std::is_trivially_destructible_v<T>);
    if (!data_) {
      data_ = arena_.Make<T>();
      mark_ = arena_.GetMark();
    }
    return *static_cast<T*>(data_);
  }
  // Returns memory for data that the state points to. It frees the memory of earlier calls.
  Arena& FreshArena() {
    arena_.Rewind(mark_);
    return arena_;
  }

 private:
  Arena arena_;
  void* data_ = nullptr;
  Arena::Mark mark_ = {};
};

}  // namespace exphoton
