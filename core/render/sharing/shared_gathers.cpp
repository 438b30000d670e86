// SPDX-License-Identifier: BSD-2-Clause
// SharedGathers: one fit for each fragment, evaluated at each of its samples.
#include "core/render/sharing/shared_gathers.h"

#include <algorithm>
#include <optional>

#include "core/files/byte_archive.h"
#include "core/render/certificate/corrections.h"
#include "core/render/sharing/fragment_rows.h"
#include "core/render/sharing/local_fit.h"
#include "core/render/sharing_change.h"

namespace exphoton {
namespace {

// The fit around one fragment, blended with the samples' own light.
class FragmentLight {
 public:
  FragmentLight(const FitTarget& target, const std::optional<LocalFit>& fit, Real share)
      : target_(target), fit_(fit), share_(share) {}

  Spectrum At(const GatherSample& sample) const {
    if (!fit_) return sample.light;
    const Spectrum fitted = fit_->At(target_.FeaturesOf(sample.film, sample.n));
    return sample.light * (1 - share_) + fitted * share_;
  }

 private:
  FitTarget target_;
  const std::optional<LocalFit>& fit_;
  Real share_;
};

// The lights of all fragments of one pixel after the other.
class PixelLights {
 public:
  PixelLights(const SharingChoice& choice, FitNeighbours* scratch)
      : choice_(choice), scratch_(scratch) {}

  // `fits` has the fits of the pixel's fragments. Adds their differences to `check` (null: none).
  void Set(Point2i pixel, const GatherFragments::Pixel& gathered, const FragmentFit* fits,
           PixelCheck* check) {
    lights_.clear();
    for (std::size_t i = 0; i < gathered.fragments.size(); ++i) {
      const SharingWindows::Window& window = fits[i].window;
      const FitTarget target(gathered.fragments[i]);
      const Real share = choice_.ShareOf(pixel, target, window, scratch_);
      lights_.emplace_back(target, fits[i].fit, share);
      if (check && fits[i].checked) check->Add(i, *fits[i].checked * share);
      totals_.radii += double(window.radius * window.share);
      totals_.fragments += 1;
    }
  }
  Spectrum At(const GatherSample& sample) const { return lights_[sample.fragment].At(sample); }
  const SharingTotals& Totals() const { return totals_; }

 private:
  const SharingChoice& choice_;
  FitNeighbours* scratch_;
  std::vector<FragmentLight> lights_;
  SharingTotals totals_;
};

Aov AovOf(const GatherSample& sample) { return sample.depth == 0 ? Aov::Indirect : Aov::Specular; }

// Returns the groups whose fits must be checked while their neighbours are at hand.
FragmentFits::GroupOf GroupsOf(const GatherFragments& gathers, const SharingRequest& request) {
  if (!request.isChecked) return {};
  return [&gathers, window = request.window](Point2i pixel) {
    return SharingChecker::GroupOf(gathers, pixel, window);
  };
}

bool HasChecked(const FragmentFit* fits, std::size_t count) {
  return std::any_of(fits, fits + count, [](const FragmentFit& fit) { return bool(fit.checked); });
}

// Reports what sharing changes. L is the shared light of a sample.
void AddChange(const SharedLightTarget& target, Point2i pixel, const GatherSample& sample,
               const Spectrum& L) {
  const Spectrum own = sample.weight * sample.light;
  if (target.corrections) target.corrections->AddSharing(pixel, own - L, sample.sampleWeight);
  if (!target.change) return;
  target.change->film.AddLight(pixel, L - own, sample.sampleWeight);
  if (target.change->aovs)
    target.change->aovs->AddLight(pixel, AovOf(sample), L - own, sample.sampleWeight);
}

// Adds the bias to the AOV that shows it, if it is wanted.
void AddBias(const SharedLightTarget& target, Point2i pixel, const SharingChecker& checker,
             FitNeighbours* scratch) {
  AovFilm* const changed = target.change ? target.change->aovs.get() : nullptr;
  const AovFilm* const wanted = target.aovs ? target.aovs : changed;
  if (!wanted || !wanted->NeedsSharingBias() || !wanted->Crop().Contains(pixel.x, pixel.y)) return;
  const Spectrum bias = checker.Bias(pixel, scratch);
  for (AovFilm* aovs : {target.aovs, changed})
    if (aovs) aovs->AddSharingBias(pixel, bias, target.samplesPerPixel);
}

// Adds the light of the samples of a pixel to the picture.
void AddSamples(const SharedLightTarget& target, Point2i pixel,
                const GatherFragments::Pixel& gathered, const PixelLights& lights,
                SplatBuffer::Pixel* splat) {
  if (target.splats) splat->Begin(target.splats, pixel);
  for (const GatherSample& sample : gathered.samples) {
    const Spectrum L = sample.weight * lights.At(sample);
    AddChange(target, pixel, sample, L);
    const Aov aov = AovOf(sample);
    if (target.splats) {
      const Point2 place = sample.film - Point2(Real(pixel.x), Real(pixel.y));
      splat->AddLight(place, sample.sampleWeight, L, aov);
      continue;
    }
    if (target.film) target.film->AddLight(pixel, L, sample.sampleWeight);
    if (target.aovs) target.aovs->AddLight(pixel, aov, L, sample.sampleWeight);
  }
  if (target.splats) splat->End();
}

}  // namespace

void SharingTotals::Transfer(ByteArchive* archive) {
  archive->Values(&radii, &fragments);
  checked.resize(archive->Count(checked.size(), 2 * sizeof(int) + 6 * sizeof(double)));
  for (CheckedPixel& pixel : checked) {
    archive->Values(&pixel.pixel.x, &pixel.pixel.y);
    for (auto& product : pixel.products) archive->Values(&product[0], &product[1], &product[2]);
  }
}

void AddOwnLight(const GatherFragments& gathers, const SharedLightTarget& target,
                 ThreadPool* threads) {
  threads->For(target.window.Height(), [&](std::int64_t row, int) {
    for (int x = target.window.x0; x < target.window.x1; ++x) {
      const Point2i pixel{x, target.window.y0 + int(row)};
      for (const GatherSample& sample : gathers.At(pixel).samples) {
        const Spectrum L = sample.weight * sample.light;
        target.film->AddLight(pixel, L, sample.sampleWeight);
        if (target.aovs) target.aovs->AddLight(pixel, AovOf(sample), L, sample.sampleWeight);
      }
    }
  });
}

int SharingMargin() { return SharingWindows::kReach + SharingShares::kReach; }

SharedGathers::SharedGathers(const GatherFragments& gathers, const SharingRequest& request,
                             ThreadPool* threads)
    : gathers_(gathers),
      threads_(threads),
      rows_(gathers),
      own_(std::in_place, gathers, rows_,
           SharingChoice::Request{request.window, request.windowArea, GroupsOf(gathers, request)},
           threads),
      choice_(*own_),
      fits_(own_->Fits()),
      isChecked_(request.isChecked) {}

SharedGathers::SharedGathers(const GatherFragments& gathers, const SharingChoice& choice,
                             const PixelBounds& window, ThreadPool* threads)
    : gathers_(gathers),
      threads_(threads),
      rows_(gathers),
      choice_(choice),
      others_(std::in_place, FragmentFits::Source{gathers, rows_, choice.Windows()}, window,
              FragmentFits::GroupOf(), threads),
      fits_(*others_) {}

SharingChecker SharedGathers::CheckerOf(double samplesPerPixel) const {
  return {gathers_, rows_, choice_, samplesPerPixel};
}

SharingTotals SharedGathers::AddLight(const SharedLightTarget& target) const {
  const PixelBounds& window = target.window;
  std::vector<FitNeighbours> scratch(std::size_t(threads_->Count()));
  std::vector<SharingTotals> totals(std::size_t(window.Height()));  // by row
  std::optional<PixelDifferences> differences;
  if (isChecked_) differences.emplace(window);
  threads_->For(window.Height(), [&](std::int64_t row, int worker) {
    totals[std::size_t(row)] =
        AddRow(target, window.y0 + int(row), differences ? &*differences : nullptr,
               &scratch[std::size_t(worker)]);
  });
  SharingTotals total;
  for (const SharingTotals& row : totals) total.Add(row);
  if (differences) total.checked = CheckRows(window, target.samplesPerPixel, &*differences);
  return total;
}

SharingTotals SharedGathers::AddRow(const SharedLightTarget& target, int y,
                                    PixelDifferences* differences, FitNeighbours* scratch) const {
  const SharingChecker checker = CheckerOf(target.samplesPerPixel);
  PixelLights lights(choice_, scratch);
  SplatBuffer::Pixel splat;
  for (int x = target.window.x0; x < target.window.x1; ++x) {
    const Point2i pixel{x, y};
    const GatherFragments::Pixel& gathered = gathers_.At(pixel);
    const FragmentFit* const fits = fits_.At(pixel);
    std::optional<PixelCheck> check;
    if (differences && HasChecked(fits, gathered.fragments.size()))
      check.emplace(gathered, target.samplesPerPixel);
    lights.Set(pixel, gathered, fits, check ? &*check : nullptr);
    if (check) differences->At(pixel) = check->Difference();
    AddBias(target, pixel, checker, scratch);
    AddSamples(target, pixel, gathered, lights, &splat);
  }
  return lights.Totals();
}

std::vector<CheckedPixel> SharedGathers::Check(const PixelBounds& window,
                                               double samplesPerPixel) const {
  return CheckRows(window, samplesPerPixel, nullptr);
}

std::vector<CheckedPixel> SharedGathers::CheckRows(const PixelBounds& window,
                                                   double samplesPerPixel,
                                                   const PixelDifferences* known) const {
  const SharingChecker checker = CheckerOf(samplesPerPixel);
  std::vector<FitNeighbours> scratch(std::size_t(threads_->Count()));
  std::vector<std::vector<CheckedPixel>> rows(std::size_t(window.Height()));
  threads_->For(window.Height(), [&](std::int64_t row, int worker) {
    for (int x = window.x0; x < window.x1; ++x)
      if (const auto checked =
              checker.Check({x, window.y0 + int(row)}, known, &scratch[std::size_t(worker)]))
        rows[std::size_t(row)].push_back(*checked);
  });
  std::vector<CheckedPixel> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

}  // namespace exphoton
