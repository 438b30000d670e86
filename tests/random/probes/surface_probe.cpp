// SPDX-License-Identifier: BSD-2-Clause
// ProbeSurfaces checks hits: the two ways of asking for a hit, occlusion, the frame, and the
// derivatives against neighbouring hits. ProbeCamera checks ray differentials and footprints.
#include <cmath>

#include "integrators/photon/maps/rest_pose.h"
#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {
namespace {

double Off(const Vec3& a, const Vec3& b) { return double(Distance(a, b)); }

void CheckHit(const ProbedScene& scene, const Sight& sight, Findings* findings) {
  const Ray& ray = sight.ray;
  const SurfaceInteraction& s = sight.surface;
  const auto whole = scene.World().Intersect(ray);
  findings->Expect(whole && whole->p == s.p && whole->ng == s.ng, "Intersect and IntersectPoint",
                   whole.has_value(), 1);
  findings->Expect(s.p == sight.hit.point.p && s.ng == sight.hit.point.ng,
                   "point and surface of a hit", double(s.p.x), double(sight.hit.point.p.x));
  findings->Expect(s.time == ray.time && sight.hit.point.time == ray.time, "time of a hit",
                   double(s.time), double(ray.time));
  const Real t = sight.hit.hit.t;
  const double scale = 1 + double(Length(s.p) + t);
  findings->Expect(Off(ray(t), s.p) < 1e-4 * scale, "the hit is on the ray", Off(ray(t), s.p), 0);
  findings->Expect(Off(s.wo, -ray.d) < 1e-5, "wo points back", Off(s.wo, -ray.d), 0);
  Ray beyond = ray, before = ray;
  beyond.tMax = t * Real(1.001), before.tMax = t * Real(.999);
  findings->Expect(scene.World().Occluded(beyond), "occluded beyond the hit", 0, 1);
  findings->Expect(!scene.World().Occluded(before), "not occluded before the hit", 1, 0);
  const auto shorter = scene.World().IntersectPoint(before);
  findings->Expect(!shorter, "no hit before the hit", 1, 0);
  const Ray next = SpawnRay(s, ray.d);
  findings->Expect(next.time == ray.time, "a spawned ray keeps the time", double(next.time),
                   double(ray.time));
}

// A direction that is taken to the pose at rest and back is the same, whatever its length was.
void CheckRestPose(const Sight& sight, Findings* findings) {
  const RestPose rest(sight.surface);
  const Vector3& w = sight.surface.wo;
  const double off = Off(rest.DirectionBack(rest.Direction(w)), w);
  findings->Expect(off < 1e-4, "to the pose at rest and back", off, 0);
}

int Handedness(const Vector3& u, const Vector3& v, const Normal3& n) {
  return Dot(Cross(u, v), n) < 0 ? -1 : 1;
}

void CheckFrame(const SurfaceInteraction& s, Findings* findings) {
  const auto& shading = s.shading;
  const auto isUnit = [](const Vec3& n) { return std::abs(double(Length(n)) - 1) < 1e-4; };
  findings->Expect(isUnit(s.ng) && isUnit(shading.n), "unit normals", double(Length(s.ng)),
                   double(Length(shading.n)));
  findings->Expect(Dot(s.ng, shading.n) >= 0, "the shading normal is on ng's side",
                   double(Dot(s.ng, shading.n)), 0);
  const double lengths = double(Length(s.dpdu) + Length(s.dpdv));
  const double slope = double(AbsDot(s.ng, s.dpdu) + AbsDot(s.ng, s.dpdv));
  findings->Expect(slope < 2e-3 * lengths, "dpdu and dpdv are tangents", slope, lengths);
  const int sides =
      Handedness(s.dpdu, s.dpdv, s.ng) * Handedness(shading.dpdu, shading.dpdv, shading.n);
  findings->Expect(sides > 0, "the shading tangents have the hand of the true ones", sides, 1);
}

// Compares the step to a near hit of the same primitive with the derivatives.
void CheckDerivatives(const ProbedScene& scene, const Sight& sight, const Vector3& tangent,
                      Findings* findings) {
  constexpr Real kStep = Real(.004);
  const SurfaceInteraction& s = sight.surface;
  // About the pole of a sphere, u runs along a circle of the radius |dpdu| / (2 pi). The step
  // leaves its tangent by half its length over this radius: at most a sixteenth of the step.
  const Real least = 50 * kStep;
  if (Length(s.dpdu) < least || Length(s.dpdv) < least) return;
  Ray ray = sight.ray;
  ray.d = Normalize(s.p + Normalize(tangent) * kStep - ray.o);
  const auto other = scene.Look(ray);
  if (!other || other->hit.hit.primitive != sight.hit.hit.primitive ||
      other->hit.hit.instance != sight.hit.hit.instance)
    return;
  const SurfaceInteraction& o = other->surface;
  const Vector3 step = o.p - s.p;
  if (Length(step) > 3 * kStep) return;
  const Real du = o.uv.x - s.uv.x, dv = o.uv.y - s.uv.y;
  if (std::abs(du) > Real(.5) || std::abs(dv) > Real(.5)) return;  // over the seam
  const double size = double(Length(step));
  findings->Expect(Off(s.dpdu * du + s.dpdv * dv, step) < .12 * size + 1e-4,
                   "dpdu and dpdv against a near hit", Off(s.dpdu * du + s.dpdv * dv, step), size);
  const auto compare = [&](const Vec3& change, const Vec3& predicted, const char* check) {
    const double larger = std::max(double(Length(change)), double(Length(predicted)));
    if (larger > .2) return;
    findings->Expect(Off(change, predicted) < .2 * larger + 1e-3, check, double(Length(change)),
                     double(Length(predicted)));
  };
  compare(o.ng - s.ng, s.dndu * du + s.dndv * dv, "dndu and dndv against a near hit");
  compare(o.shading.n - s.shading.n, s.shading.dndu * du + s.shading.dndv * dv,
          "shading dndu and dndv against a near hit");
}

void CheckNeighbour(const Ray& ray, const Point3& origin, const Vector3& direction,
                    const char* check, Findings* findings) {
  const double off = Off(ray.o, origin) + Off(ray.d, direction);
  findings->Expect(off < 2e-3, check, off, 0);
}

// Compares a footprint with the meeting point of the neighbouring ray and the tangent plane.
void CheckFootprint(const SurfaceInteraction& s, const Ray& beside, const Vector3& dp, Point2 duv,
                    Findings* findings) {
  const Real along = Dot(s.ng, beside.d);
  if (std::abs(along) < Real(.1)) return;
  const Point3 meeting = beside.o + beside.d * (Dot(s.ng, s.p - beside.o) / along);
  const Vector3 expected = meeting - s.p;
  const double size = double(Length(expected));
  if (size > 5) return;
  findings->Expect(Off(dp, expected) < .02 * size + 1e-3, "dpdx and dpdy are steps on the plane",
                   Off(dp, expected), size);
  const Vector3 byUv = s.dpdu * duv.x + s.dpdv * duv.y;
  findings->Expect(Off(byUv, dp) < .02 * size + 1e-3, "dudx to dvdy make dpdx and dpdy",
                   Off(byUv, dp), size);
}

void CheckCameraRay(const ProbedScene& scene, const CameraSample& sample, Findings* findings) {
  const Camera& camera = scene.Eye();
  const RayDifferential ray = camera.GenerateRay(sample, true);
  findings->Expect(std::abs(double(Length(ray.d)) - 1) < 1e-4, "camera rays have unit directions",
                   double(Length(ray.d)), 1);
  if (!ray.hasDifferentials) return;
  CameraSample right = sample, below = sample;
  right.film.x += 1, below.film.y += 1;
  CheckNeighbour(camera.GenerateRay(right, false), ray.xOrigin, ray.xDirection,
                 "the differential in x is the ray of the next pixel", findings);
  CheckNeighbour(camera.GenerateRay(below, false), ray.yOrigin, ray.yDirection,
                 "the differential in y is the ray of the pixel below", findings);
  auto surface = scene.World().Intersect(ray);
  if (!surface) return;
  surface->ComputeDifferentials(ray);
  if (!surface->hasDifferentials) return;
  CheckFootprint(*surface, Ray(ray.xOrigin, ray.xDirection), surface->dpdx,
                 {surface->dudx, surface->dvdx}, findings);
  CheckFootprint(*surface, Ray(ray.yOrigin, ray.yDirection), surface->dpdy,
                 {surface->dudy, surface->dvdy}, findings);
}

}  // namespace

void ProbeSurfaces(const ProbedScene& scene, Findings* findings) {
  for (const Sight& sight : scene.Sights()) {
    CheckHit(scene, sight, findings);
    CheckFrame(sight.surface, findings);
    CheckRestPose(sight, findings);
    CheckDerivatives(scene, sight, sight.surface.dpdu, findings);
    CheckDerivatives(scene, sight, sight.surface.dpdv, findings);
  }
}

void ProbeCamera(const ProbedScene& scene, Findings* findings) {
  RandomStream random = scene.Stream(2);
  for (int i = 0; i < 40; ++i) {
    CameraSample sample;
    sample.film = {kFilmWidth * random.Uniform(), kFilmHeight * random.Uniform()};
    sample.lens = NextPoint(&random);
    sample.time = random.Uniform();
    CheckCameraRay(scene, sample, findings);
  }
}

}  // namespace exphoton::random_scenes
