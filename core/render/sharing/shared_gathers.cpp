// SPDX-License-Identifier: BSD-2-Clause
// SharedGathers: one fit for each fragment, evaluated at each of its samples.
#include "core/render/sharing/shared_gathers.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "core/render/sharing/fragment_rows.h"
#include "core/render/sharing/local_fit.h"
#include "core/render/sharing/sharing_windows.h"

namespace exphoton {
namespace {

// The fit around one fragment, blended with the samples' own light where the window is small.
class FragmentLight {
 public:
  FragmentLight(const FragmentRows& rows, Point2i pixel, const GatherFragment& fragment,
                Real radius, FitNeighbours* scratch)
      : target_(fragment), share_(std::min(radius / SharingWindows::kRadii[1], Real(1))) {
    if (!(share_ > 0)) return;
    radius = std::max(radius, SharingWindows::kRadii[1]);
    LocalFit::Collect(rows, target_, pixel, radius, scratch);
    fit_.emplace(*scratch, radius, 2);
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

int SharingMargin() { return SharingWindows::kReach; }

double AddSharedLight(const GatherFragments& gathers, ThreadPool* threads,
                      const SharedLightTarget& target) {
  const FragmentRows rows(gathers);
  const SharingWindows windows(gathers, rows, threads);
  const PixelBounds window = target.splats ? target.splats->Window() : target.film->Crop();
  std::vector<FitNeighbours> scratch(std::size_t(threads->Count()));
  std::vector<double> radii(std::size_t(window.Height())), fragments(radii.size());
  threads->For(window.Height(), [&](std::int64_t row, int worker) {
    std::vector<FragmentLight> lights;
    SplatBuffer::Pixel splat;
    for (int x = window.x0; x < window.x1; ++x) {
      const Point2i pixel{x, window.y0 + int(row)};
      const GatherFragments::Pixel& gathered = gathers.At(pixel);
      lights.clear();
      for (const GatherFragment& fragment : gathered.fragments) {
        const Real radius = windows.RadiusAt(pixel, fragment);
        lights.emplace_back(rows, pixel, fragment, radius, &scratch[std::size_t(worker)]);
        radii[std::size_t(row)] += double(radius);
        fragments[std::size_t(row)] += 1;
      }
      if (target.splats) splat.Begin(target.splats, pixel);
      for (const GatherSample& sample : gathered.samples) {
        const Spectrum L = sample.weight * lights[sample.fragment].At(sample);
        const Aov aov = sample.depth == 0 ? Aov::Indirect : Aov::Specular;
        if (target.splats) {
          splat.AddLight(sample.film - Point2(Real(x), Real(pixel.y)), L, aov);
          continue;
        }
        target.film->AddLight(pixel, L, sample.filterWeight);
        if (target.aovs) target.aovs->AddLight(pixel, aov, L, sample.filterWeight);
      }
      if (target.splats) splat.End();
    }
  });
  const double count = std::accumulate(fragments.begin(), fragments.end(), 0.);
  return std::accumulate(radii.begin(), radii.end(), 0.) / std::max(count, 1.);
}

}  // namespace exphoton
