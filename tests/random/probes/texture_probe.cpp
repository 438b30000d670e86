// SPDX-License-Identifier: BSD-2-Clause
// ProbeTextures compares texture mappings, filtered checkerboards and bumps with second
// implementations: footprints with differences of the coordinates, the filtered checkerboard with
// the mean over many points, and the bumped normal with the normal of the displaced surface.
#include <cmath>

#include "core/math/sampling/sampling.h"
#include "core/scattering/texture_mapping.h"
#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {
namespace {

using Options2D = TextureMapping2D::Options;
using Kind2D = TextureMapping2D::Kind;

constexpr int kTextureRays = 60;

std::string Real3(const Vector3& v) {
  char text[80];
  std::snprintf(text, sizeof text, "[%.9g %.9g %.9g]", double(v.x), double(v.y), double(v.z));
  return text;
}

Vector3 RandomVector(RandomStream* random) {
  Vector3 v;
  for (int axis = 0; axis < 3; ++axis) v[axis] = 4 * random->Uniform() - 2;
  return v;
}

Options2D RandomOptions(Kind2D kind, RandomStream* random) {
  Options2D options;
  options.kind = kind;
  options.uScale = 2 + 6 * random->Uniform(), options.vScale = 2 + 6 * random->Uniform();
  options.uDelta = random->Uniform(), options.vDelta = random->Uniform();
  options.v1 = RandomVector(random), options.v2 = RandomVector(random);
  return options;
}

// Returns the coordinates that the header of the mappings describes.
Point2 Coordinates(const Options2D& o, const Transform& worldToTexture, const Vector3& p) {
  if (o.kind == Kind2D::Planar) return {o.uDelta + Dot(p, o.v1), o.vDelta + Dot(p, o.v2)};
  const Vector3 q = worldToTexture.ApplyPoint(Point3(p));
  const double r = double(Length(q)), azimuth = std::atan2(double(q.y), double(q.x));
  const double turns = azimuth / (2 * double(kPi));
  if (o.kind == Kind2D::Cylindrical) return {Real(.5 + turns), Real(double(q.z) / r)};
  return {Real(std::acos(double(q.z) / r) / double(kPi)), Real(turns < 0 ? turns + 1 : turns)};
}

// Returns the difference of azimuths that may be on both sides of the seam.
Real Wrapped(Real difference) { return difference - std::round(difference); }

bool AreSteps(Point2 a, Point2 b) {
  const Real size = std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y);
  return std::abs(a.x - b.x) + std::abs(a.y - b.y) < Real(.03) * size + Real(2e-4);
}

void CheckMapping(const SurfaceInteraction& s, Kind2D kind, RandomStream* random,
                  Findings* findings) {
  const Options2D o = RandomOptions(kind, random);
  const Transform toWorld = *Transform::Rotate(360 * double(random->Uniform()), {1, 2, 3});
  const TexturePoint2 at = TextureMapping2D(o, toWorld).Map(s);
  if (kind == Kind2D::Uv) {
    const Point2 st{o.uScale * s.uv.x + o.uDelta, o.vScale * s.uv.y + o.vDelta};
    findings->Expect(AreSteps(at.st, st), "coordinates by uv", double(at.st.x), double(st.x));
    findings->Expect(AreSteps(at.dstdx, {o.uScale * s.dudx, o.vScale * s.dvdx}) &&
                         AreSteps(at.dstdy, {o.uScale * s.dudy, o.vScale * s.dvdy}),
                     "footprint by uv", double(at.dstdy.y), double(o.vScale * s.dvdy));
    return;
  }
  const Transform toTexture = toWorld.Inverted();
  const Vector3 q = toTexture.ApplyPoint(s.p);
  const Real fromAxis = std::sqrt(q.x * q.x + q.y * q.y);
  if (kind != Kind2D::Planar && (fromAxis < Real(.3) || fromAxis < Real(.3) * Length(q))) return;
  const Point2 st = Coordinates(o, toTexture, s.p);
  const auto wrap = [&](Point2 d) {
    return kind == Kind2D::Planar ? d : Point2(Wrapped(d.x), Wrapped(d.y));
  };
  findings->Expect(AreSteps(wrap(at.st - st), {0, 0}), "texture coordinates", double(at.st.x),
                   double(st.x));
  const auto step = [&](const Vector3& dp) {
    const Real h = Real(.01) / std::max(Real(1e-6), Length(dp));
    const Point2 d =
        wrap(Coordinates(o, toTexture, s.p + dp * h) - Coordinates(o, toTexture, s.p - dp * h));
    return d * (1 / (2 * h));
  };
  if (Length(s.dpdx) > 1 || Length(s.dpdy) > 1) return;
  const Point2 dx = step(s.dpdx), dy = step(s.dpdy);
  findings->Expect(AreSteps(at.dstdx, dx), "footprint in x of a texture", double(at.dstdx.x),
                   double(dx.x));
  findings->Expect(AreSteps(at.dstdy, dy), "footprint in y of a texture", double(at.dstdy.x),
                   double(dy.x));
}

// Gives the surface the footprint of a random pixel.
void SetFootprint(const Ray& ray, RandomStream* random, SurfaceInteraction* surface) {
  RayDifferential wide(ray);
  const auto beside = [&] {
    return Normalize(ray.d + SampleUniformSphere(NextPoint(random)) * Real(.05));
  };
  wide.hasDifferentials = true;
  wide.xOrigin = wide.yOrigin = ray.o;
  wide.xDirection = beside(), wide.yDirection = beside();
  surface->ComputeDifferentials(wide);
}

// TexturedWorld has a body with a checkerboard at x < 0 and one with bumps at x > 0.
struct TexturedWorld {
  Options2D checks, bumps;
  std::array<double, 4> heights;  // v00 v01 v10 v11

  explicit TexturedWorld(RandomStream* random)
      : checks(RandomOptions(random->Bits() % 2 ? Kind2D::Uv : Kind2D::Planar, random)),
        bumps(RandomOptions(Kind2D::Planar, random)) {
    for (double& height : heights) height = .1 * double(random->Uniform());
    heights[3] = heights[1] + heights[2] - heights[0];  // a plane, whose steps are exact
  }

  static std::string MappingText(const Options2D& o) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "\"float uscale\" %.9g \"float vscale\" %.9g \"float udelta\" %.9g "
                  "\"float vdelta\" %.9g",
                  double(o.uScale), double(o.vScale), double(o.uDelta), double(o.vDelta));
    return std::string(text) + " \"string mapping\" \"" + (o.kind == Kind2D::Uv ? "uv" : "planar") +
           "\" \"vector v1\" " + Real3(o.v1) + " \"vector v2\" " + Real3(o.v2);
  }

  std::string Text(RandomStream* random) const {
    constexpr std::array<const char*, 4> kShapes{
        "\"sphere\" \"float radius\" .8", "\"cylinder\" \"float radius\" .7", "\"paraboloid\"",
        "\"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-.9 -.9 .2 .9 -.8 0 "
        ".9 .9 -.2 -.9 .9 0] \"normal N\" [-.2 -.3 1 .3 -.2 1 .3 .3 1 -.2 .1 1]"};
    const auto shape = [&](double x) {
      return "AttributeBegin Translate " + std::to_string(x) + " 0 0 Rotate " +
             std::to_string(360 * double(random->Uniform())) + " 3 1 2 Shape " +
             kShapes[std::size_t(random->Bits() % kShapes.size())] + " AttributeEnd\n";
    };
    char corners[160];
    std::snprintf(corners, sizeof corners,
                  "\"float v00\" %.9g \"float v01\" %.9g \"float v10\" %.9g \"float v11\" %.9g",
                  heights[0], heights[1], heights[2], heights[3]);
    return "WorldBegin\nTexture \"c\" \"color\" \"checkerboard\" \"color tex1\" [1 1 1] \"color "
           "tex2\" [0 0 0] " +
           MappingText(checks) + "\nMaterial \"matte\" \"texture Kd\" \"c\"\n" + shape(-1.5) +
           "Texture \"b\" \"float\" \"bilerp\" " + MappingText(bumps) + " " + corners +
           "\nMaterial \"matte\" \"texture bumpmap\" \"b\"\n" + shape(1.5) + "WorldEnd\n";
  }

  Point2 Checks(const SurfaceInteraction& s) const {
    if (checks.kind == Kind2D::Planar) return Coordinates(checks, {}, s.p);
    return {checks.uScale * s.uv.x + checks.uDelta, checks.vScale * s.uv.y + checks.vDelta};
  }
};

// Returns the share of even cells minus the share of odd ones, over an interval.
double EvenMinusOdd(double x, double radius) {
  constexpr int kPoints = 500;
  int sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double at = x + radius * (2 * (i + .5) / kPoints - 1);
    sum += int(std::floor(at)) % 2 == 0 ? 1 : -1;
  }
  return double(sum) / kPoints;
}

void CheckCheckerboard(const TexturedWorld& world, const SurfaceInteraction& s, const Bsdf& bsdf,
                       Findings* findings) {
  const Point2 st = world.Checks(s);
  const Options2D& o = world.checks;
  const auto step = [&](const Vector3& dp, Point2 duv) {
    return o.kind == Kind2D::Planar ? Point2(Dot(dp, o.v1), Dot(dp, o.v2))
                                    : Point2(o.uScale * duv.x, o.vScale * duv.y);
  };
  const Point2 dx = step(s.dpdx, {s.dudx, s.dvdx}), dy = step(s.dpdy, {s.dudy, s.dvdy});
  const double rx = double(std::max(std::abs(dx.x), std::abs(dy.x)));
  const double ry = double(std::max(std::abs(dx.y), std::abs(dy.y)));
  if (rx > 50 || ry > 50) return;
  const double even = EvenMinusOdd(double(st.x), rx) * EvenMinusOdd(double(st.y), ry);
  const double value = double(bsdf.Rho(LobeSet::DiffuseReflection).r);
  findings->Expect(std::abs(value - (1 + even) / 2) < .03, "a filtered checkerboard", value,
                   (1 + even) / 2);
}

// The displaced surface is q = p + d n. Its normal is along dq/du x dq/dv, with
// dq/du = dp/du + dd/du n + d dn/du.
void CheckBump(const TexturedWorld& world, const SurfaceInteraction& flat,
               const SurfaceInteraction& bumped, Findings* findings) {
  // Differences over a very short step lose their digits.
  constexpr Real kShort = Real(2e-3);
  if (std::abs(flat.dudx) + std::abs(flat.dudy) < kShort ||
      std::abs(flat.dvdx) + std::abs(flat.dvdy) < kShort || Length(flat.dpdu) < Real(.05) ||
      Length(flat.dpdv) < Real(.05))
    return;
  const auto height = [&](const Vector3& p) {
    const Point2 st = Coordinates(world.bumps, {}, p);
    const double s = double(st.x), t = double(st.y);
    const auto& h = world.heights;
    return (1 - s) * ((1 - t) * h[0] + t * h[1]) + s * ((1 - t) * h[2] + t * h[3]);
  };
  const auto& shading = flat.shading;
  const double here = height(flat.p);
  const auto displaced = [&](const Vector3& dp, const Vector3& dn) {
    constexpr Real kStep = Real(1e-3);
    const double slope =
        (height(flat.p + dp * kStep) - height(flat.p - dp * kStep)) / (2 * double(kStep));
    return dp + Vector3(shading.n) * Real(slope) + dn * Real(here);
  };
  const Vector3 n = NormalizeOr(
      Cross(displaced(shading.dpdu, shading.dndu), displaced(shading.dpdv, shading.dndv)),
      Vector3());
  const double cosine = std::abs(double(Dot(n, bumped.shading.n)));
  findings->Expect(cosine > .99, "the normal of bumps", cosine, 1);
}

void CheckTexturedSight(const TexturedWorld& world, const Sight& sight, RandomStream* random,
                        Findings* findings) {
  SurfaceInteraction surface = sight.surface;
  SetFootprint(sight.ray, random, &surface);
  if (!surface.hasDifferentials || AbsDot(surface.ng, sight.ray.d) < Real(.3)) return;
  for (const Kind2D kind : {Kind2D::Uv, Kind2D::Spherical, Kind2D::Cylindrical, Kind2D::Planar})
    CheckMapping(surface, kind, random, findings);
  const SurfaceInteraction flat = surface;
  Arena arena;
  const Bsdf bsdf = surface.material->Evaluate(&surface, TransportMode::Radiance, &arena);
  if (surface.p.x < 0)
    CheckCheckerboard(world, flat, bsdf, findings);
  else
    CheckBump(world, flat, surface, findings);
}

}  // namespace

void ProbeTextures(std::uint64_t seed, Findings* findings) {
  RandomStream random(HashKey({seed, 17}));
  const TexturedWorld world(&random);
  const ProbedScene scene(world.Text(&random), seed, 0);
  for (int i = 0; i < kTextureRays; ++i)
    if (const auto sight = scene.Look(RandomRay(&random, {0, 0})))
      CheckTexturedSight(world, *sight, &random, findings);
}

}  // namespace exphoton::random_scenes
