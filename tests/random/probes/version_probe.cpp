// SPDX-License-Identifier: BSD-2-Clause
// ProbeVersions compares hits of a scene with hits of other descriptions of it: bodies as instances
// and not, with reversed orientation, and held still at one time of their motion.
#include <algorithm>
#include <cmath>

#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kVersionRays = 80;

double Apart(const Vec3& a, const Vec3& b) { return double(Distance(a, b)); }

// VersionCheck counts the hits that differ. Single ones differ at edges and where surfaces
// coincide.
class VersionCheck {
 public:
  // `side` is -1 where normals are opposite.
  VersionCheck(const char* name, int side, bool comparesShading)
      : name_(name), side_(Real(side)), comparesShading_(comparesShading) {}

  void Compare(const std::optional<Sight>& a, const std::optional<Sight>& b) {
    if (!a && !b) return;
    if (!a || !b || Apart(a->surface.p, b->surface.p) > 2e-3) {
      ++places_;
      return;
    }
    const SurfaceInteraction &s = a->surface, &t = b->surface;
    const bool isTurned = s.objectId == 1;  // the walls are the same in all versions
    const Real side = isTurned ? 1 : side_;
    const bool hasOtherShading = Apart(s.shading.n * side, t.shading.n) > .02;
    normals_ += Apart(s.ng * side, t.ng) > .02 || (comparesShading_ && hasOtherShading);
    const auto isFar = [](const Vec3& x, const Vec3& y) {
      return Apart(x, y) > .03 * double(Length(x) + Length(y)) + 2e-3;
    };
    derivatives_ += isFar(s.dpdu, t.dpdu) || isFar(s.dpdv, t.dpdv) ||
                    isFar(s.dndu * side, t.dndu) || isFar(s.dndv * side, t.dndv);
    if (comparesShading_)
      shading_ += isFar(s.shading.dpdu, t.shading.dpdu) || isFar(s.shading.dpdv, t.shading.dpdv) ||
                  isFar(s.shading.dndu * side, t.shading.dndu) ||
                  isFar(s.shading.dndv * side, t.shading.dndv);
    coordinates_ += std::abs(s.uv.x - t.uv.x) + std::abs(s.uv.y - t.uv.y) > Real(.01);
  }

  void Finish(Findings* findings) const {
    const auto expect = [&](int count, int most, const char* what) {
      const std::string check = std::string(name_) + ": " + what;
      findings->Expect(count <= most, check.c_str(), count, most);
    };
    expect(places_, 8, "places of hits");
    expect(normals_, 5, "normals");
    expect(derivatives_, 5, "derivatives");
    expect(shading_, 5, "shading derivatives");
    expect(coordinates_, 5, "coordinates");
  }

 private:
  const char* name_;
  Real side_;
  bool comparesShading_;
  int places_ = 0, normals_ = 0, derivatives_ = 0, shading_ = 0, coordinates_ = 0;
};

void CompareHits(VersionCheck check, const ProbedScene& scene, const ProbedScene& other,
                 std::optional<Real> time, Findings* findings) {
  RandomStream random = scene.Stream(7);
  for (int i = 0; i < kVersionRays; ++i) {
    Ray ray = RandomRay(&random, scene.World().Exposure());
    if (time) ray.time = *time;
    check.Compare(scene.Look(ray), other.Look(ray));
  }
  check.Finish(findings);
}

// Compares hits with those of the scene times a power of two, which rounds in the same way.
void ProbeScale(const SceneModel& model, const char* accelerator, std::uint64_t seed,
                Findings* findings) {
  const ProbedScene scene(SceneText(model, {}), seed, 0);
  constexpr Real kScale = Real(0x1p61);
  TextOptions options;
  options.accelerator = accelerator;
  options.worldScale = "Scale 2305843009213693952 2305843009213693952 2305843009213693952\n";
  options.objectScale =
      "Scale 4.33680868994201773602981e-19 4.33680868994201773602981e-19 "
      "4.33680868994201773602981e-19\n";
  const ProbedScene large(SceneText(model, options), seed, 0);
  RandomStream random = scene.Stream(13);
  int differences = 0, hits = 0;
  for (int i = 0; i < kVersionRays; ++i) {
    Ray ray = RandomRay(&random, scene.World().Exposure());
    const auto a = scene.World().IntersectPoint(ray);
    ray.o = ray.o * kScale;
    const auto b = large.World().IntersectPoint(ray);
    hits += a.has_value();
    differences += a.has_value() != b.has_value() ||
                   (a && Apart(a->point.p, b->point.p * (1 / kScale)) > 1e-3);
  }
  const std::string check = std::string("times 2^61: hits with ") + accelerator;
  findings->Expect(differences <= 3, check.c_str(), differences, hits);
}

#ifdef EXPHOTON_EMBREE
constexpr const char* kLargeAccelerator = "embree";
#else
constexpr const char* kLargeAccelerator = "bvh";
#endif

// A mesh has unit normals at its vertices, where it is placed. Between them, they differ from the
// normals of the same mesh that is stretched as an instance or by motion.
bool HasStretchedNormals(const SceneModel& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const BodyModel& body) {
    const bool hasNormals = body.kind == BodyKind::SmoothMesh ||
                            body.kind == BodyKind::Subdivided || body.kind == BodyKind::Nurbs ||
                            body.kind == BodyKind::HeightField;
    return hasNormals && body.stretch == 1;
  });
}

bool HasMotion(const SceneModel& scene) {
  if (scene.camera.motion == 1) return true;
  for (const BodyModel& body : scene.bodies)
    if (body.motion != 0) return true;
  return false;
}

// Holds the scene still at the middle of its exposure.
void ProbeMotion(const SceneModel& model, std::uint64_t seed, Findings* findings) {
  TextOptions options;
  options.partsMove = seed % 2 == 1;
  const ProbedScene scene(SceneText(model, options), seed, 0);
  constexpr std::array<std::array<double, 2>, 3> kTimes{{{0, 1}, {0, .2}, {.3, .4}}};
  const Interval exposure = scene.World().Exposure();
  RandomStream random = scene.Stream(8);
  const Real u = random.Uniform();
  const Real time = Lerp(u, exposure.min, exposure.max);
  const auto& times = kTimes[std::size_t(model.camera.times)];
  options.stillAt = std::clamp((double(time) - times[0]) / (times[1] - times[0]), 0., 1.);
  const ProbedScene still(SceneText(model, options), seed, 0);
  CompareHits({"still", 1, !HasStretchedNormals(model)}, scene, still, time, findings);
  if (model.camera.motion == 2) return;  // a turn about a point that is not the camera's
  CameraSample sample;
  sample.film = {3, 5};
  sample.time = u;
  const Ray a = scene.Eye().GenerateRay(sample, false), b = still.Eye().GenerateRay(sample, false);
  findings->Expect(Apart(a.o, b.o) + Apart(a.d, b.d) < 2e-3, "still: camera ray", Apart(a.o, b.o),
                   Apart(a.d, b.d));
}

}  // namespace

void ProbeVersions(const SceneModel& model, std::uint64_t seed, Findings* findings) {
  SceneModel dark = model;  // emitters are no instances, and have one side
  for (BodyModel& body : dark.bodies) {
    body.emission = 0;
    if (body.isInstance == 2) body.isInstance = 1;
  }
  const ProbedScene scene(SceneText(dark, {}), seed, 0);
  SceneModel instanced = dark, reversed = dark;
  for (BodyModel& body : instanced.bodies) body.isInstance = 1 - body.isInstance;
  for (BodyModel& body : reversed.bodies) body.reverse = 1 - body.reverse;
  if (!dark.bodies.empty() && dark.room != RoomKind::None) {
    CompareHits({"instance", 1, !HasStretchedNormals(dark)}, scene,
                ProbedScene(SceneText(instanced, {}), seed, 0), {}, findings);
    CompareHits({"reversed", -1, true}, scene, ProbedScene(SceneText(reversed, {}), seed, 0), {},
                findings);
  }
  ProbeScale(dark, kLargeAccelerator, seed, findings);
  if (HasMotion(dark)) ProbeMotion(dark, seed, findings);
}

}  // namespace exphoton::random_scenes
