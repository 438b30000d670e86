// SPDX-License-Identifier: BSD-2-Clause
// SharedGathers: one fit for each fragment, evaluated at each of its samples.
#include "core/render/sharing/shared_gathers.h"

#include <algorithm>
#include <optional>

#include "core/files/byte_archive.h"
#include "core/render/certificate/corrections.h"
#include "core/render/sharing/fragment_rows.h"
#include "core/render/sharing/local_fit.h"
#include "core/render/sharing/sharing_windows.h"
#include "core/render/sharing_change.h"

namespace exphoton {
namespace {

// The fit around one fragment, blended with the samples' own light where the window is small.
class FragmentLight {
 public:
  explicit FragmentLight(const WindowFit& window)
      : target_(window.Target()),
        share_(window.Window().share),
        fit_(window.To(FragmentRows::All)) {}

  Spectrum At(const GatherSample& sample) const {
    if (!fit_) return sample.light;
    const Spectrum fitted = fit_->At(target_.FeaturesOf(sample.film, sample.n));
    return sample.light * (1 - share_) + fitted * share_;
  }

 private:
  FitTarget target_;
  Real share_;
  std::optional<LocalFit> fit_;
};

// The fits of all fragments of one pixel after the other.
class PixelLights {
 public:
  PixelLights(const FragmentRows& rows, const SharingWindows& windows, FitNeighbours* scratch)
      : rows_(rows), windows_(windows), scratch_(scratch) {}

  // Fits the light of a pixel, and checks its fits if `check` is not empty.
  void Fit(Point2i pixel, const GatherFragments::Pixel& gathered,
           std::optional<PixelCheck>* check) {
    lights_.clear();
    for (std::size_t i = 0; i < gathered.fragments.size(); ++i) {
      const WindowFit fit(rows_, windows_, {pixel, gathered.fragments[i]}, scratch_);
      lights_.emplace_back(fit);
      if (*check && (*check)->HasGroup(i)) (*check)->Add(i, fit);
      totals_.radii += double(fit.Window().radius * fit.Window().share);
      totals_.fragments += 1;
    }
  }
  Spectrum At(const GatherSample& sample) const { return lights_[sample.fragment].At(sample); }
  const SharingTotals& Totals() const { return totals_; }

 private:
  const FragmentRows& rows_;
  const SharingWindows& windows_;
  FitNeighbours* scratch_;
  std::vector<FragmentLight> lights_;
  SharingTotals totals_;
};

Aov AovOf(const GatherSample& sample) { return sample.depth == 0 ? Aov::Indirect : Aov::Specular; }

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

int SharingMargin() { return SharingWindows::kReach; }

SharedGathers::SharedGathers(const GatherFragments& gathers, ThreadPool* threads, double windowArea)
    : gathers_(gathers),
      threads_(threads),
      rows_(gathers),
      own_(std::in_place, gathers, rows_, threads),
      windows_(*own_) {
  own_->Shrink(windowArea);
}

SharedGathers::SharedGathers(const GatherFragments& gathers, const SharingWindows& windows,
                             ThreadPool* threads)
    : gathers_(gathers), threads_(threads), rows_(gathers), windows_(windows) {}

SharingTotals SharedGathers::AddLight(const SharedLightTarget& target) const {
  const PixelBounds& window = target.window;
  std::vector<FitNeighbours> scratch(std::size_t(threads_->Count()));
  std::vector<SharingTotals> totals(std::size_t(window.Height()));  // by row
  std::optional<PixelDifferences> differences;
  if (target.isChecked) differences.emplace(window);
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
  const SharingChecker checker(gathers_, rows_, windows_, target.samplesPerPixel);
  PixelLights lights(rows_, windows_, scratch);
  SplatBuffer::Pixel splat;
  for (int x = target.window.x0; x < target.window.x1; ++x) {
    const Point2i pixel{x, y};
    const GatherFragments::Pixel& gathered = gathers_.At(pixel);
    std::optional<PixelCheck> check =
        differences ? checker.Begin(pixel, target.window) : std::nullopt;
    lights.Fit(pixel, gathered, &check);
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
  const SharingChecker checker(gathers_, rows_, windows_, samplesPerPixel);
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
