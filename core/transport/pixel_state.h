// SPDX-License-Identifier: BSD-2-Clause
// PixelState: what an integrator keeps from one camera sample of a pixel for the next ones, whose
// rays mostly see the same. The renderer forgets it with each pixel and pass, so that no pixel
// depends on which were rendered before it. Nothing kept may depend on what a sample found its
// radiance to be: the mean over samples would no longer be unbiased. One a thread.
#pragma once

#include "core/base/arena.h"

namespace exphoton {

class PixelState {
 public:
  void Reset() { note_ = nullptr, arena_.Reset(); }

  // The note of this pixel, a T() when it is first asked for. An integrator keeps one type only; it
  // must hold nothing that needs a destructor.
  template <class T>
  T& Note() {
    static_assert(std::is_trivially_destructible_v<T>);
    if (!note_) {
      note_ = arena_.Make<T>();
      mark_ = arena_.GetMark();
    }
    return *static_cast<T*>(note_);
  }
  // Memory for what the note points to, after that of earlier calls was given back.
  Arena& FreshArena() {
    arena_.Rewind(mark_);
    return arena_;
  }

 private:
  Arena arena_;
  void* note_ = nullptr;
  Arena::Mark mark_ = {};
};

}  // namespace exphoton
