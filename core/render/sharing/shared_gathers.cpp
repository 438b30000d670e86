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

namespace exphoton {
namespace {

// The fit around one fragment, blended with the samples' own light where the window is small.
class FragmentLight {
 public:
  FragmentLight(const FragmentRows& rows, Point2i pixel, const GatherFragment& fragment,
                const SharingWindows::Window& window, FitNeighbours* scratch)
      : target_(fragment), share_(window.share) {
    if (!(share_ > 0)) return;
    static constexpr FragmentRows::Column kAll[] = {FragmentRows::All};
    LocalFit::Collect(rows, {target_, pixel, window.radius}, kAll, scratch);
    fit_.emplace(*scratch, window.radius, 0);
  }

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

}  // namespace

void SharingTotals::Transfer(ByteArchive* archive) {
  archive->Values(&radii, &fragments);
  checked.resize(archive->Count(checked.size(), 2 * sizeof(int) + 6 * sizeof(double)));
  for (CheckedPixel& pixel : checked) {
    archive->Values(&pixel.pixel.x, &pixel.pixel.y);
    for (auto& product : pixel.products) archive->Values(&product[0], &product[1], &product[2]);
  }
}

int SharingMargin() { return SharingWindows::kReach; }

SharingTotals AddSharedLight(const GatherFragments& gathers, ThreadPool* threads,
                             const SharedLightTarget& target) {
  const FragmentRows rows(gathers);
  SharingWindows windows(gathers, rows, threads);
  windows.Shrink(target.windowArea);
  const SharingChecker checker(gathers, rows, windows, target.samplesPerPixel);
  const PixelBounds& window = target.window;
  std::vector<FitNeighbours> scratch(std::size_t(threads->Count()));
  std::vector<SharingTotals> totals(std::size_t(window.Height()));  // by row
  threads->For(window.Height(), [&](std::int64_t row, int worker) {
    std::vector<FragmentLight> lights;
    SplatBuffer::Pixel splat;
    for (int x = window.x0; x < window.x1; ++x) {
      const Point2i pixel{x, window.y0 + int(row)};
      const GatherFragments::Pixel& gathered = gathers.At(pixel);
      lights.clear();
      for (const GatherFragment& fragment : gathered.fragments) {
        const SharingWindows::Window chosen = windows.At(pixel, fragment);
        lights.emplace_back(rows, pixel, fragment, chosen, &scratch[std::size_t(worker)]);
        totals[std::size_t(row)].radii += double(chosen.radius * chosen.share);
        totals[std::size_t(row)].fragments += 1;
      }
      if (const auto checked = checker.Check(pixel, &scratch[std::size_t(worker)]))
        totals[std::size_t(row)].checked.push_back(*checked);
      if (target.aovs && target.aovs->NeedsSharingBias() &&
          target.aovs->Crop().Contains(pixel.x, pixel.y))
        target.aovs->AddSharingBias(pixel, checker.Bias(pixel, &scratch[std::size_t(worker)]),
                                    target.samplesPerPixel);
      if (target.splats) splat.Begin(target.splats, pixel);
      for (const GatherSample& sample : gathered.samples) {
        const Spectrum L = sample.weight * lights[sample.fragment].At(sample);
        if (target.corrections)
          target.corrections->AddLight(pixel, sample.weight * sample.light - L,
                                       sample.sampleWeight);
        const Aov aov = sample.depth == 0 ? Aov::Indirect : Aov::Specular;
        if (target.splats) {
          splat.AddLight(sample.film - Point2(Real(x), Real(pixel.y)), sample.sampleWeight, L, aov);
          continue;
        }
        target.film->AddLight(pixel, L, sample.sampleWeight);
        if (target.aovs) target.aovs->AddLight(pixel, aov, L, sample.sampleWeight);
      }
      if (target.splats) splat.End();
    }
  });
  SharingTotals total;
  for (const SharingTotals& row : totals) total.Add(row);
  return total;
}

}  // namespace exphoton
