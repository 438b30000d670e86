// SPDX-License-Identifier: BSD-2-Clause
// PassState saves and loads a pass that is not finished: the sums of its pixels, and which pixels
// have all their samples. Pixels that were begun are rendered again.
#pragma once

#include "core/base/parallel.h"
#include "core/render/done_pixels.h"
#include "core/render/render.h"
#include "core/render/sharing/sharing_bands.h"
#include "core/render/splat_buffer.h"
#include "core/render/state/checkpoints.h"

namespace exphoton {

class PassState {
 public:
  struct Parts {
    RenderPass pass;
    Film* film;
    AovFilm* aovs;         // null: no AOVs
    SplatBuffer* splats;   // null: samples are not splatted
    SharingBands* shared;  // null: gathers are not shared
    // Null: no certificate. They are saved and loaded by the caller, which must load them first.
    Corrections* corrections = nullptr;
  };
  // `window` holds the pixels to render. The parts must outlive this object.
  PassState(const Parts& parts, const PixelBounds& window) : parts_(parts), done_(window) {}

  DonePixels& Done() { return done_; }

  static bool IsIn(const StateFile& file) { return file.Has("pass"); }
  void Save(StateWriter* writer);
  // Throws Error(File) if the file is of another pass.
  void Load(const StateFile& file);
  // Returns the picture with the samples so far, as it would be if the pass ended now.
  PictureSoFar Picture(ThreadPool* threads) const;

 private:
  void TransferPass(ByteArchive* archive);
  void TransferGathers(ByteArchive* archive);
  void ClearOpenPixels();

  Parts parts_;
  DonePixels done_;
};

}  // namespace exphoton
