// SPDX-License-Identifier: BSD-2-Clause
// UnsharedPicture is the picture that the passes so far give without shared gathers. It has more
// noise than the shared one, but not its bias. Each pass has both pictures, because its gathers are
// shared after they are known.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/render/passes/pass_parts.h"
#include "core/render/passes/pass_sum.h"
#include "core/render/passes/unshared/bias_of_sharing.h"
#include "core/render/sharing_change.h"

namespace exphoton {

class UnsharedPicture {
 public:
  // Returns the picture without sharing of a render with a certificate, and lets `parts` and `sum`
  // take notice of it. Returns null without a certificate, and where IsKnown does not hold. It
  // takes about 400 bytes a pixel.
  static std::unique_ptr<UnsharedPicture> Follow(const RenderJob& job, PassParts* parts,
                                                 PassSum* sum);

  // Returns whether the picture without sharing can be known and differs: where gathers are shared
  // (PlanSharing) and light is not splatted, in pictures of at most two million pixels.
  static bool IsKnown(const RenderJob& job);

  // aovs: those of all passes; null: none.
  UnsharedPicture(const Film& picture, const AovFilm* aovs);
  UnsharedPicture(const UnsharedPicture&) = delete;
  UnsharedPicture& operator=(const UnsharedPicture&) = delete;

  // Receives the change of the next pass.
  SharingChange* OfPass() { return &pass_; }
  // Adds a complete pass without its shared light, as PassSum::Add does.
  void Add(const Film& pass, std::int64_t samplesPerPixel, int group);
  // Adds AOVs of light that sharing changes in addition; null: none.
  void AddChange(const AovFilm* light);
  // The noise of this picture.
  PassSum& Sum() { return sum_; }
  // Estimates what sharing adds to the error of the picture with this sum.
  std::optional<SharingBias> BiasOf(const PassSum& shared, GroupSamples samples) const;
  // Turns the sum of the shared passes, its picture and their AOVs into those without sharing.
  void Replace(Film* picture, AovFilm* aovs, PassSum* sum) const;

  // Save and load everything, with the part of the next pass. `shared` is the sum of the shared
  // passes. Load throws Error(File).
  void Save(StateWriter* writer);
  void Load(const StateFile& file, const PassSum& shared);

 private:
  void TransferSum(ByteArchive* archive);

  SharingChange pass_;
  Film picture_;                   // of all passes
  std::unique_ptr<AovFilm> aovs_;  // what sharing changed in all passes; null: none
  PassSum sum_;
};

}  // namespace exphoton
