// SPDX-License-Identifier: BSD-2-Clause
// The texture "marble" runs through a list of greys and blues along y of texture space, in waves
// that noise disturbs.
#include "materials/textures/noise/noise_texture.h"

namespace exphoton {
namespace {

struct Settings : FractalSettings {
  Real scale = 1;
  Real variation = Real(.2);
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      FractalParameters(),
      Param("scale", &Settings::scale, "factor of texture space").Range(-1e6, 1e6),
      Param("variation", &Settings::variation, "amplitude of the disturbance").Range(-1e6, 1e6)};
  return table;
}

// The colours of pbrt-v1's marble. Four at a time are the control points of a cubic Bezier curve.
const Spectrum kColors[] = {{Real(.58), Real(.58), Real(.6)}, {Real(.58), Real(.58), Real(.6)},
                            {Real(.58), Real(.58), Real(.6)}, {Real(.5), Real(.5), Real(.5)},
                            {Real(.6), Real(.59), Real(.58)}, {Real(.58), Real(.58), Real(.6)},
                            {Real(.58), Real(.58), Real(.6)}, {Real(.2), Real(.2), Real(.33)},
                            {Real(.58), Real(.58), Real(.6)}};
constexpr int kCurves = int(std::size(kColors)) - 3;
constexpr Real kBrightness = Real(1.5);  // the colours are scaled, for contrast

// Returns the colour at t in [0, 1]. NaN, the sine of an infinite phase, counts as 0.
Spectrum ColorAt(double t) {
  if (!(t >= 0)) t = 0;
  const int first = std::min(int(t * kCurves), kCurves - 1);
  const auto x = Real(t * kCurves - first), y = 1 - x;
  const Spectrum* c = kColors + first;
  return (c[0] * (y * y * y) + c[1] * (3 * x * y * y) + c[2] * (3 * x * x * y) +
          c[3] * (x * x * x)) *
         kBrightness;
}

class Marble final : public ColorTexture {
 public:
  Marble(const Settings& settings, const TextureContext& context)
      : settings_(settings), mapping_(context.textureToWorld) {}

  Spectrum Evaluate(const SurfaceInteraction& si) const override {
    const TexturePoint3 at = Scaled(mapping_.Map(si), settings_.scale);
    const double phase =
        double(at.p.y) + double(settings_.variation) * FbmAt(at, settings_.Noise());
    return ColorAt(.5 + .5 * std::sin(phase));
  }
  bool IsFiltered() const override { return true; }

 private:
  Settings settings_;
  TextureMapping3D mapping_;
};

std::unique_ptr<ColorTexture> Create(const Settings& settings, const TextureContext& context) {
  return std::make_unique<Marble>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_COLOR_TEXTURE("marble", "veins of grey and blue")
