// SPDX-License-Identifier: BSD-2-Clause
// ErrorWatch estimates the error of a picture while its passes are added up: the noise, the bias of
// photon maps (Corrections), and the bias of shared gathers (UnsharedPicture). With an accuracy it
// decides whether the picture has reached it, and whether later passes share gathers.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/render/passes/accuracy/accuracy_rule.h"
#include "core/render/passes/pass_parts.h"
#include "core/render/passes/pass_sum.h"
#include "core/render/passes/render_passes.h"
#include "core/render/passes/unshared/unshared_picture.h"
#include "core/render/sharing/passes/joint_windows.h"

namespace exphoton {

class ErrorWatch {
 public:
  // The picture, whose passes the caller renders and adds up. All members must outlive the watch.
  struct Picture {
    const RenderJob& job;
    PassParts* parts;
    PassSum* sum;
    PassRenderer* renderer;
  };
  // accuracy: nullopt if none is wanted. samples: how groups of passes depend on each other.
  ErrorWatch(const Picture& picture, const std::optional<StoppingRule::Accuracy>& accuracy,
             GroupSamples samples);

  const AccuracyRule* Rule() const { return rule_ ? &*rule_ : nullptr; }  // null: no accuracy
  // Returns the samples per pixel that the accuracy is likely to need, by the last look; 0 before.
  double NeededSamples() const { return neededSamples_; }
  // Returns whether the picture stops because of its bias: more samples would not help, or more
  // photons are likely to need less time. There must be an accuracy.
  bool IsBiasTooLarge() const {
    return rule_->IsOutOfReach() || (stopsForLikelyBias_ && rule_->NeedsMorePhotons());
  }

  // Returns whether the picture stops because another integrator is expected to need far less time.
  // There must be an accuracy.
  bool IsTooDear() const { return isTooDear_; }

  // Must be called before each pass. Returns the receiver of its gathers; null: none.
  GatherFragments* BeginPass(std::int64_t samplesPerPixel);

  // Must be called after the functions of PassSum with the same names. The gathers of a pass are
  // not shared before the next look, because each fit takes the time of all passes so far.
  void JoinGroups();
  void SetPhotonNoise(double relative);
  void Add(const Film& pass, std::int64_t samplesPerPixel, int group);
  // The noise part of relMSE that photons cause.
  struct NoiseOfPhotons {
    double fixed = 0;  // the part that more samples do not reduce
    double soFar = 0;  // of the photons that all groups so far share
  };
  // Looks at the error of an accuracy, which there must be. May turn the picture into the one
  // without shared gathers.
  void Look(const NoiseOfPhotons& noise);

  // Shares the gathers of passes after which there was no look. Must be called before the final
  // picture is read. Pictures that are shown meanwhile may have gathers that are not shared.
  void Complete() { FitJointly(); }
  // Adds what is known about the error to the result of the renderer.
  void Describe(PassesResult* result) const;

  // Save and load everything but the picture and its sum. The sum must be loaded first. Load throws
  // Error(File).
  void Save(StateWriter* writer);
  void Load(const StateFile& file);

 private:
  Corrections* OfMaps() const { return picture_.parts->Options().corrections; }  // null: none
  std::optional<Certificate> LookAt(const PassSum& sum, const NoiseOfPhotons& noise,
                                    const std::optional<SharingBias>& sharing,
                                    AccuracyRule* rule) const;
  std::optional<Certificate> CertifyMaps(const PassSum& sum, const CertificateGoal& goal) const;
  std::optional<SharingBias> BiasOfSharedGathers() const;
  bool MayBeBetterUnshared(const SharingBias& sharing) const;
  void FitJointly();
  void LookWithoutSharing(const NoiseOfPhotons& noise);
  void StopSharing();
  void TransferRule(ByteArchive* archive);

  Picture picture_;
  GroupSamples samples_;
  std::optional<AccuracyRule> rule_;
  bool mayStopSharing_ = false, stopsForLikelyBias_ = false, hasStoppedSharing_ = false;
  double neededSamples_ = 0, leastSamples_ = 0, rivalSamples_ = 0;
  bool isTooDear_ = false;                     // by the last look
  std::unique_ptr<UnsharedPicture> unshared_;  // null: none is needed, or it is the picture
  std::unique_ptr<JointWindows> joint_;        // null: passes share apart, or not at all
  bool isFitMissing_ = false;                  // whether the passes of joint_ may need a fit
};

}  // namespace exphoton
