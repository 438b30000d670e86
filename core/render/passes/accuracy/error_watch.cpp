// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/accuracy/error_watch.h"

#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/format.h"
#include "core/render/certificate/corrections.h"
#include "core/render/passes/accuracy/accuracy_look.h"
#include "core/render/render_totals.h"
#include "core/render/sharing/sharing_bands.h"

namespace exphoton {
namespace {

constexpr const char* kRuleSection = "accuracy";
// Fewer samples share badly and say little about the bias of sharing.
constexpr std::int64_t kFewestToStopSharing = 8;

// Returns whether the groups of the corrections have the samples of the groups of the sum. Where
// groups share places, only all samples together are compared.
bool HaveSameGroups(const Corrections& corrections, const PassSum& sum) {
  std::vector<std::int64_t> samples, ofSum;
  for (const Corrections::Group* group : corrections.Groups())
    samples.push_back(group->samplesPerPixel);
  const PassNoise& sums = sum.GroupSums();
  for (int place = 0; place < sums.Places(); ++place)
    if (sums.SamplesOf(place) > 0) ofSum.push_back(sums.SamplesOf(place));
  const auto total = [](const std::vector<std::int64_t>& all) {
    return std::accumulate(all.begin(), all.end(), std::int64_t(0));
  };
  return sum.Groups() > sums.Places() ? total(samples) == total(ofSum) : samples == ofSum;
}

bool HasPassesOf(const JointWindows& joint, const PassSum& sum) {
  return joint.Passes() == std::size_t(sum.Passes()) &&
         joint.SamplesPerPixel() == sum.SamplesPerPixel();
}

static_assert(JointWindows::kMostPasses <= std::size_t(PassSum::kPlaces));  // one place each

}  // namespace

ErrorWatch::ErrorWatch(const Picture& picture,
                       const std::optional<StoppingRule::Accuracy>& accuracy, GroupSamples samples)
    : picture_(picture),
      samples_(samples),
      unshared_(accuracy && accuracy->sharesApart
                    ? nullptr
                    : UnsharedPicture::Follow(picture.job, picture.parts, picture.sum)) {
  if (!accuracy) return;
  rule_.emplace(accuracy->error, accuracy->biasShare, accuracy->omitted);
  rule_->CountLooks(accuracy->earlierLooks);
  mayStopSharing_ = accuracy->mayStopSharing;
  stopsForLikelyBias_ = accuracy->stopsForLikelyBias;
  rivalSamples_ = accuracy->rivalSamples;
  if (unshared_)
    joint_ =
        std::make_unique<JointWindows>(picture.job.film, picture.parts->Aovs(),
                                       kBandsOfPasses * picture.parts->Options().sharingMemory);
}

GatherFragments* ErrorWatch::BeginPass(std::int64_t samplesPerPixel) {
  if (joint_ && !joint_->HasRoomFor(samplesPerPixel)) {
    FitJointly();
    joint_.reset();
    picture_.job.log.Verbose("later passes share their gathers alone, because " +
                             std::to_string(picture_.sum->Passes()) +
                             " passes are the most, or fill the memory");
  }
  return joint_ ? joint_->OfPass() : nullptr;
}

void ErrorWatch::JoinGroups() {
  if (unshared_) unshared_->Sum().JoinGroups();
  if (OfMaps()) OfMaps()->JoinGroups();
}

void ErrorWatch::SetPhotonNoise(double relative) {
  if (unshared_) unshared_->Sum().SetPhotonNoise(relative);
}

void ErrorWatch::Add(const Film& pass, std::int64_t samplesPerPixel, int group) {
  if (joint_) {
    joint_->Add(samplesPerPixel, group);
    isFitMissing_ = true;
  }
  if (unshared_) unshared_->Add(pass, samplesPerPixel, group);
  if (OfMaps()) OfMaps()->EndPass(group, samplesPerPixel);
}

// Replaces the light of the gathers of all passes in the picture, its AOVs and its corrections.
void ErrorWatch::FitJointly() {
  if (!joint_ || !isFitMissing_) return;
  isFitMissing_ = false;
  const RenderJob& job = picture_.job;
  const PhaseTimer timer(job.statistics, "share");
  const double radius = joint_->Fit(&job.threads, [&](int group, const SharingChange& difference) {
    picture_.sum->AddLight(difference.film, group);
    OfMaps()->SubtractSharing(difference.film, group);
    unshared_->AddChange(difference.aovs.get());
    if (difference.aovs) picture_.parts->Aovs()->Add(*difference.aovs);
  });
  SetSharingRadius(radius, &job.statistics);
}

// Looks at the picture with this noise. Returns its certificate.
std::optional<Certificate> ErrorWatch::LookAt(const PassSum& sum, const NoiseOfPhotons& noise,
                                              const std::optional<SharingBias>& sharing,
                                              AccuracyRule* rule) const {
  std::optional<Certificate> ofMaps;
  if (sharing && stopsForLikelyBias_) ofMaps = CertifyMaps(sum, rule->NextGoal());
  return LookAtError(
      {sum, OfMaps(), sharing, noise.fixed, noise.soFar, ofMaps ? &*ofMaps : nullptr}, rule,
      picture_.job.log);
}

// Returns the certificate without the bias of shared gathers, which photons do not change. Where
// this bias is not known apart, the certificate is empty, so that it asks for no photons.
std::optional<Certificate> ErrorWatch::CertifyMaps(const PassSum& sum,
                                                   const CertificateGoal& goal) const {
  if (!OfMaps()) return std::nullopt;
  if (!unshared_) return Certificate{};
  OfMaps()->UseSharing(false);
  const auto certificate = Certify(*OfMaps(), sum.Levels(), *sum.Noise(), goal);
  OfMaps()->UseSharing(true);
  return certificate;
}

void ErrorWatch::Look(const NoiseOfPhotons& noise) {
  if (!picture_.sum->Noise()) return;
  FitJointly();
  const auto certificate = LookAt(*picture_.sum, noise, BiasOfSharedGathers(), &*rule_);
  if (unshared_ && mayStopSharing_ && !rule_->IsReached() && certificate && certificate->sharing &&
      MayBeBetterUnshared(*certificate->sharing))
    LookWithoutSharing(noise);
  const auto samples = double(picture_.sum->SamplesPerPixel());
  neededSamples_ = samples * rule_->Growth();
  leastSamples_ = samples * rule_->LeastGrowth();
  isTooDear_ = rule_->IsDearerThan(rivalSamples_, samples);
}

std::optional<SharingBias> ErrorWatch::BiasOfSharedGathers() const {
  if (!unshared_) return picture_.renderer->MeanSharingBias();
  return unshared_->BiasOf(*picture_.sum, samples_);
}

// Each look costs confidence, so the noise decides whether one at the other picture can pay.
bool ErrorWatch::MayBeBetterUnshared(const SharingBias& sharing) const {
  const PassSum& sum = *picture_.sum;
  return sum.SamplesPerPixel() >= kFewestToStopSharing &&
         *unshared_->Sum().Noise() < *sum.Noise() + rule_->MostBias(sharing);
}

// Takes the picture without shared gathers if it should need fewer samples.
void ErrorWatch::LookWithoutSharing(const NoiseOfPhotons& noise) {
  const RenderJob& job = picture_.job;
  job.log.Verbose("the same samples without shared gathers:");
  OfMaps()->UseSharing(false);
  AccuracyRule unshared = *rule_;
  LookAt(unshared_->Sum(), noise, std::nullopt, &unshared);
  if (unshared.Growth() >= rule_->Growth()) {
    OfMaps()->UseSharing(true);
    rule_->CountLooks(1);
    return;
  }
  rule_ = unshared;
  unshared_->Replace(&job.film, picture_.parts->Aovs(), picture_.sum);
  StopSharing();
  job.log.Notice("gathers shared -> not shared after " +
                 Counted(picture_.sum->SamplesPerPixel(), "sample") +
                 " a pixel, because the bias of sharing is a large part of the error");
}

void ErrorWatch::StopSharing() {
  hasStoppedSharing_ = true;
  OfMaps()->UseSharing(false);
  picture_.sum->UseOwnLevels();
  unshared_.reset();
  joint_.reset();
  picture_.parts->SetSharingChange(nullptr);
  picture_.renderer->StopSharing();
}

void ErrorWatch::Describe(PassesResult* result) const {
  if (unshared_) SetSharingBias(BiasOfSharedGathers(), &picture_.job.statistics, &result->render);
  if (rule_) result->looks = rule_->Looks();
  result->leastSamples = leastSamples_;
  if (rule_ && rule_->HasLooked()) result->upperError = rule_->Upper();
  if (hasStoppedSharing_) result->changes = ", gathers shared -> not shared";
  if (OfMaps() && picture_.sum->Groups() > 1) result->levels = picture_.sum->Levels();
}

void ErrorWatch::TransferRule(ByteArchive* archive) {
  rule_->Transfer(archive);
  char hasStopped = hasStoppedSharing_ ? 1 : 0, isJoint = joint_ ? 1 : 0;
  archive->Values(&hasStopped, &isJoint, &neededSamples_);
  if (isJoint && !joint_) throw ArchiveError("its passes cannot share together");
  if (!isJoint) joint_.reset();
  if (!(neededSamples_ >= 0)) throw ArchiveError("it needs an impossible number of samples");
  if (!hasStopped || hasStoppedSharing_) return;
  if (!unshared_) throw ArchiveError("its gathers were never shared");
  StopSharing();
}

void ErrorWatch::Save(StateWriter* writer) {
  if (rule_)
    writer->AddArchive(kRuleSection, [this](ByteArchive* archive) { TransferRule(archive); });
  if (unshared_) unshared_->Save(writer);
  if (joint_) joint_->Save(writer);
  if (OfMaps()) OfMaps()->Save(writer);
}

void ErrorWatch::Load(const StateFile& file) {
  if (rule_) file.Read(kRuleSection, [this](ByteArchive* archive) { TransferRule(archive); });
  if (unshared_) unshared_->Load(file, *picture_.sum);
  if (joint_) joint_->Load(file, picture_.sum->Groups());
  // Another fit of the same passes changes nothing, so the state need not say whether it is there.
  isFitMissing_ = joint_ && joint_->Passes() > 0;
  if (joint_ && !HasPassesOf(*joint_, *picture_.sum))
    file.FailAsDamaged("its gathers have other passes than the picture");
  if (!OfMaps()) return;
  OfMaps()->Load(file);
  if (!HaveSameGroups(*OfMaps(), *picture_.sum))
    file.FailAsDamaged("its corrections have other passes than the picture");
}

}  // namespace exphoton
