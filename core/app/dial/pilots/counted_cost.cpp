// SPDX-License-Identifier: BSD-2-Clause
// docs/decisions/0055-accuracy-dial.md compares counted costs with seconds. The seconds for one
// unit differ between scenes by a factor of 3, but less between integrators in one scene.
#include "core/app/dial/pilots/counted_cost.h"

#include <algorithm>

namespace exphoton::cli {
namespace {

constexpr double kPhotonRay = 1.35;
constexpr double kEmissionRay = .9;  // a camera ray that only reads emission (StillEmitters)
constexpr double kSkippedPath = .3;  // a path for caustics that misses all specular surfaces

struct IntegratorCost {
  const char* name;
  double ray, storedPhoton;
};
constexpr IntegratorCost kCosts[] = {
    {"path", 1, 0}, {"guidedpath", 1.6, .25}, {"exphotonmap", 1.15, .6}, {"photonmap", 2.5, .25}};

// Returns the share of the traced paths that only the caustic map needs.
double CausticPathShare(const Statistics& statistics) {
  const double skipped = CounterOf(statistics, "photons/skipped");
  const double traced = CounterOf(statistics, "photons/shot") - skipped;
  const double others = std::max(CounterOf(statistics, "photons/direct paths"),
                                 CounterOf(statistics, "photons/indirect paths"));
  return traced > 0 ? std::clamp(1 - others / traced, 0., 1.) : 0;
}

}  // namespace

CountedCost CostOf(const Statistics& statistics, const std::string& integrator) {
  IntegratorCost cost = kCosts[0];
  for (const IntegratorCost& known : kCosts)
    if (integrator == known.name) cost = known;
  const RayCounters rays = statistics.Rays();
  const double photons = double(rays.counts[std::size_t(RayKind::Photon)]);
  const double skipped = CounterOf(statistics, "photons/skipped");
  const double ofCamera = double(rays.counts[std::size_t(RayKind::Camera)]);
  const double ofEmission = std::max(ofCamera - CounterOf(statistics, "render/camera samples"), 0.);
  const double others = double(rays.Total()) - photons - ofEmission;
  const double maps = photons * kPhotonRay + skipped * kSkippedPath;
  const double directRays = std::min(CounterOf(statistics, "photons/direct paths"), photons);
  return {
      maps + StoredPhotons(statistics) * cost.storedPhoton,
      others * cost.ray + ofEmission * kEmissionRay,
      photons * kPhotonRay * CausticPathShare(statistics) + skipped * kSkippedPath +
          CounterOf(statistics, "photons/caustic stored") * cost.storedPhoton,
      directRays * kPhotonRay + CounterOf(statistics, "photons/direct stored") * cost.storedPhoton};
}

double StoredPhotons(const Statistics& statistics) {
  double stored = 0;
  for (const char* map : {"direct", "caustic", "indirect"})
    stored += CounterOf(statistics, std::string("photons/") + map + " stored");
  return stored;
}

void PilotWork::Add(const Statistics& statistics) {
  ++renders;
  rays.Add(statistics.Rays());
  direct += CounterOf(statistics, "photons/direct stored");
  caustic += CounterOf(statistics, "photons/caustic stored");
  indirect += CounterOf(statistics, "photons/indirect stored");
}

void PilotWork::Add(const PilotWork& other) {
  renders += other.renders;
  rays.Add(other.rays);
  direct += other.direct, caustic += other.caustic, indirect += other.indirect;
}

double CounterOf(const Statistics& statistics, const std::string& name) {
  for (const Statistics::Counter& counter : statistics.Counters())
    if (counter.name == name) return counter.value;
  return 0;
}

}  // namespace exphoton::cli
