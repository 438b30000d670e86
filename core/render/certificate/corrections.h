// SPDX-License-Identifier: BSD-2-Clause
// Corrections accumulates the corrections (core/transport/correction_sample.h) of the passes of a
// picture, by pixel and by group of passes. Groups have samples of their own, so their corrections
// are independent for given photons. The expected value of a pixel is the true radiance minus the
// picture's. If groups share their photons, this is the error of these photons, noise included.
#pragma once

#include <vector>

#include "core/imaging/image.h"
#include "core/math/spectrum.h"
#include "core/math/vec.h"
#include "core/transport/correction_sample.h"

namespace exphoton {

class ByteArchive;
class Film;
class StateFile;
class StateWriter;

class Corrections {
 public:
  // share: of the gather rays that are corrected. mostGroups: see EndPass, at least 2.
  Corrections(const PixelBounds& crop, double share, int mostGroups = kMostGroups);

  double Share() const { return share_; }
  const PixelBounds& Crop() const { return crop_; }

  // Adds the correction of one camera sample of the current pass. Pixels outside the crop window
  // are ignored. One thread at a time may add to a pixel.
  void Add(Point2i pixel, const CorrectionSample& sample, Real weight);
  // Adds a correction to a sample that was added before with this weight.
  void AddLight(Point2i pixel, const Spectrum& correction, Real weight);
  // Adds own light minus shared light of such a sample (core/render/sharing/shared_gathers.h).
  void AddSharing(Point2i pixel, const Spectrum& correction, Real weight);
  void ClearPixel(Point2i pixel);  // removes corrections of the current pass
  void ClearPass();                // the same for all pixels
  // Keeps these parts apart, so that SumsOf can leave them out. Must be called before all passes.
  void KeepSharingApart();
  // States whether the picture shares gathers. Without sharing, SumsOf leaves these parts out.
  void UseSharing(bool isShared) { isShared_ = isShared; }
  // Moves the current pass to a group. At most mostGroups groups are kept, which limits the memory
  // of many passes. Further passes are added to these groups by turns, so that the groups stay
  // independent.
  void EndPass(int group, std::int64_t samplesPerPixel);
  static constexpr int kMostGroups = 32;

  // Subtracts light that the shared picture gets in addition, from parts that are kept apart. The
  // group must have a pass.
  void SubtractSharing(const Film& light, int group);

  // Makes one group of all groups so far, because they have the same photons and later ones do not.
  void JoinGroups();

  struct Group {
    std::int64_t samplesPerPixel = 0;
    std::vector<double> sums;     // three channels per pixel, over all samples of the group
    std::vector<double> sharing;  // parts that are kept apart, which `sums` lacks; empty: none
  };
  // Returns the groups that have samples.
  std::vector<const Group*> Groups() const;
  // Returns the sums of a group for the picture.
  std::vector<double> SumsOf(const Group& group) const;
  std::int64_t Count() const { return count_; }  // corrected rays of all passes
  // Returns the number of rays that would be corrected if each gather had rays that meet a surface.
  double ExpectedCount() const { return expected_; }

  // Save and load the groups and the current pass, but not UseSharing. Load throws Error(File) if
  // the state has corrections of another picture.
  void Save(StateWriter* writer);
  void Load(const StateFile& file);
  // Saves or loads the current pass at a pixel inside of the crop window, without parts that are
  // kept apart.
  void TransferPixel(ByteArchive* archive, Point2i pixel);

 private:
  std::size_t IndexOf(Point2i pixel) const {
    return std::size_t(pixel.y - crop_.y0) * std::size_t(crop_.Width()) +
           std::size_t(pixel.x - crop_.x0);
  }

  void AddTo(std::vector<double>* sums, Point2i pixel, const Spectrum& correction, Real weight);
  void TransferCounts(ByteArchive* archive);
  void TransferPass(ByteArchive* archive);
  void TransferGroup(ByteArchive* archive, Group* group);

  PixelBounds crop_;
  double share_;
  int mostGroups_;
  std::vector<double> current_;         // three channels per pixel
  std::vector<double> currentSharing_;  // parts that are kept apart; empty: none
  // Of the current pass, by pixel: the corrected rays, and all gather rays.
  std::vector<std::int64_t> rayCount_, gatherRays_;
  std::vector<Group> groups_;
  bool isFirstJoined_ = false;  // whether the first group holds joined ones
  std::int64_t count_ = 0;
  double expected_ = 0;
  bool isShared_ = true;
};

}  // namespace exphoton
