// SPDX-License-Identifier: BSD-2-Clause
// docs/decisions/0055-accuracy-dial.md compares counted costs with seconds. The seconds for one
// unit differ between scenes by a factor of 3, but less between integrators in one scene.
#include "core/app/dial/counted_cost.h"

namespace exphoton::cli {
namespace {

constexpr double kPhotonRay = 1.35;
constexpr double kSkippedPath = .3;  // a path for caustics that misses all specular surfaces

struct IntegratorCost {
  const char* name;
  double ray, storedPhoton;
};
constexpr IntegratorCost kCosts[] = {
    {"path", 1, 0}, {"guidedpath", 1.6, .25}, {"exphotonmap", 1.15, .6}, {"photonmap", 2.5, .25}};

}  // namespace

CountedCost CostOf(const Statistics& statistics, const std::string& integrator) {
  IntegratorCost cost = kCosts[0];
  for (const IntegratorCost& known : kCosts)
    if (integrator == known.name) cost = known;
  const RayCounters rays = statistics.Rays();
  const double photons = double(rays.counts[std::size_t(RayKind::Photon)]);
  const double skipped = CounterOf(statistics, "photons/skipped");
  return {
      photons * kPhotonRay + skipped * kSkippedPath + StoredPhotons(statistics) * cost.storedPhoton,
      (double(rays.Total()) - photons) * cost.ray};
}

double StoredPhotons(const Statistics& statistics) {
  double stored = 0;
  for (const char* map : {"direct", "caustic", "indirect"})
    stored += CounterOf(statistics, std::string("photons/") + map + " stored");
  return stored;
}

double CounterOf(const Statistics& statistics, const std::string& name) {
  for (const Statistics::Counter& counter : statistics.Counters())
    if (counter.name == name) return counter.value;
  return 0;
}

}  // namespace exphoton::cli
