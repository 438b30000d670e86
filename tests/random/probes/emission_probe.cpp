// SPDX-License-Identifier: BSD-2-Clause
// ProbeEmission computes again how spot lights, goniometric lights and skies emit in a direction,
// from the scene's description and the image of the map. The product with the light's colour is
// left out: only the ratios between directions are compared.
#include <cmath>

#include "core/imaging/image.h"
#include "core/math/sampling/sampling.h"
#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kDirections = 48;

// LatLongMap is an image over all directions: phi from the left to the right, theta downwards.
class LatLongMap {
 public:
  explicit LatLongMap(const std::string& file) : image_(ReadImage(file)) {}

  // Interpolates between the centres of texels.
  double At(double theta, double phi) const {
    const double x = phi / (2 * double(kPi)) * image_.Width() - .5;
    const double y = theta / double(kPi) * image_.Height() - .5;
    const int left = int(std::floor(x)), top = int(std::floor(y));
    double sum = 0;
    for (const int i : {0, 1})
      for (const int j : {0, 1}) {
        const double weight = (i ? x - left : 1 - (x - left)) * (j ? y - top : 1 - (y - top));
        sum += weight * Texel(left + i, top + j);
      }
    return sum;
  }
  // Directions whose four texels are not on both sides of a pole.
  bool Covers(double theta) const {
    const double y = theta / double(kPi) * image_.Height() - .5;
    return y >= 0 && y < image_.Height() - 1;
  }

 private:
  double Texel(int x, int y) const {
    return double(image_.At((x + image_.Width()) % image_.Width(), y, 0));
  }

  Image image_;
};

// RatioCheck compares two lists of numbers that are proportional.
class RatioCheck {
 public:
  void Add(double value, double expected) {
    values_.push_back(value), expected_.push_back(expected);
    products_ += value * expected, squares_ += expected * expected;
  }
  void Finish(const char* check, Findings* findings) const {
    if (!(squares_ > 0)) return;
    const double scale = products_ / squares_;
    double largest = 0, off = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      largest = std::max(largest, std::abs(scale * expected_[i]));
      off = std::max(off, std::abs(values_[i] - scale * expected_[i]));
    }
    findings->Expect(off <= 2e-3 * largest, check, off, largest);
  }

 private:
  std::vector<double> values_, expected_;
  double products_ = 0, squares_ = 0;
};

Point3 PlaceOf(const LightModel& light, const SceneModel& scene) {
  const bool isInside = light.isInsideAShape != 0 && !scene.bodies.empty();
  const Place& p = isInside ? scene.bodies.front().place : light.place;
  return {Real(.3 * p.x + .02), Real(.3 * p.y + .03), Real(.3 * p.z + .05)};
}

// Returns the intensity that leaves the light in a direction; negative if it is not known.
double IntensityToward(const Light& light, const Point3& place, const Vector3& w) {
  const Point3 p = place + w * Real(.7);
  const auto direct = light.SampleDirect({p, {}, {}, 0}, {Real(.5), Real(.5)}, Real(.5));
  return direct ? double(direct->Li.r) * .49 : 0;
}

double SpotShare(const LightModel& model, const Vector3& w) {
  constexpr std::array<double, 3> kCones{40, 10, 120};
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const double cone = kCones[std::size_t(model.cone)];
  const double outer = std::cos(cone * kDegree), inner = std::cos((cone - 5) * kDegree);
  const double cosine = double(Dot(w, Normalize(Vector3(Real(.1), -1, Real(.3)))));
  return std::pow(std::clamp((cosine - outer) / (inner - outer), 0., 1.), 4);
}

// Half of the directions are near the rim of a spot light's cone.
Vector3 DirectionOf(const LightModel& model, RandomStream* random) {
  constexpr std::array<Real, 3> kCones{40, 10, 120};
  const Vector3 w = SampleUniformSphere(NextPoint(random));
  if (model.kind != LightKind::Spot || random->Bits() % 2 == 0) return w;
  const Real angle = (kCones[std::size_t(model.cone)] - 5 * random->Uniform()) * kPi / 180;
  const Frame frame = Frame::FromZ(Normalize(Vector3(Real(.1), -1, Real(.3))));
  return frame.ToWorld(
      SphericalDirection(std::sin(angle), std::cos(angle), 2 * kPi * random->Uniform()));
}

void CheckLight(const SceneModel& scene, const LightModel& model, const Light& light,
                RandomStream* random, Findings* findings) {
  static const LatLongMap map(ImageFile());
  const Point3 place = PlaceOf(model, scene);
  const Transform toLight = Transform::Rotate(70, Vector3(1, 0, Real(.3)))->Inverted();
  RatioCheck check;
  for (int i = 0; i < kDirections; ++i) {
    const Vector3 w = DirectionOf(model, random);
    if (model.kind == LightKind::Spot) {
      check.Add(IntensityToward(light, place, w), SpotShare(model, w));
      continue;
    }
    const bool isSky = model.kind == LightKind::InfiniteMap;
    const Vector3 v = isSky ? w : toLight.ApplyVector(w);
    const double up = double(isSky ? v.z : v.y), side = double(isSky ? v.y : v.z);
    const double theta = std::acos(std::clamp(up, -1., 1.));
    const double azimuth = std::atan2(side, double(v.x));
    if (!map.Covers(theta)) continue;
    const double value = isSky ? double(light.Le(w).r) : IntensityToward(light, place, w);
    check.Add(value, map.At(theta, azimuth < 0 ? azimuth + 2 * double(kPi) : azimuth));
  }
  check.Finish(model.kind == LightKind::Spot ? "a spot light by its formula" : "a light by its map",
               findings);
}

}  // namespace

void ProbeEmission(const SceneModel& model, const ProbedScene& scene, Findings* findings) {
  RandomStream random = scene.Stream(16);
  const auto& lights = scene.World().Lights();
  for (std::size_t i = 0; i < std::min(model.lights.size(), lights.size()); ++i) {
    const LightKind kind = model.lights[i].kind;
    const bool isKnown = kind == LightKind::Spot || kind == LightKind::GoniometricMap ||
                         kind == LightKind::InfiniteMap;
    if (isKnown && !lights[i]->IsProvablyBlack())
      CheckLight(model, model.lights[i], *lights[i], &random, findings);
  }
}

}  // namespace exphoton::random_scenes
