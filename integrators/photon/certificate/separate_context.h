// SPDX-License-Identifier: BSD-2-Clause
// SeparateContext is the context of corrections at a camera sample. Its random numbers, its state
// of the pixel and its count of rays are not those of the picture, so the picture has the same bits
// with and without corrections.
#pragma once

#include "core/transport/integrator.h"

namespace exphoton {

class SeparateContext {
 public:
  static constexpr std::uint64_t kStream = 0x63657274ull;  // "cert" in ASCII

  // `context` must outlive this object. Its counters receive the rays when this object ends.
  explicit SeparateContext(LiContext& context)
      : outer_(context),
        own_{context.scene, context.samples, context.arena, rays_,
             HashKey({context.key, kStream})} {
    own_.threadState = context.threadState;
    own_.volume = context.volume;
  }
  SeparateContext(const SeparateContext&) = delete;
  SeparateContext& operator=(const SeparateContext&) = delete;
  ~SeparateContext() {
    for (std::size_t i = 0; i < rays_.counts.size(); ++i) outer_.rays.counts[i] += rays_.counts[i];
  }

  LiContext& Get() { return own_; }

 private:
  LiContext& outer_;
  RayCounters rays_;
  LiContext own_;
};

}  // namespace exphoton
