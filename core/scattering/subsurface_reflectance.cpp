// SPDX-License-Identifier: BSD-2-Clause
// The table of the paper's measured media, and the integral of the dipole's diffuse reflectance
// over the plane.
#include "core/scattering/subsurface_reflectance.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

struct MeasuredMedium {
  const char* name;
  SubsurfaceCoefficients coefficients;
};
constexpr MeasuredMedium kMeasuredMedia[] = {
    {"Apple", {{.0030, .0034, .046}, {2.29, 2.39, 1.97}}},
    {"Chicken1", {{.015, .077, .19}, {.15, .21, .38}}},
    {"Chicken2", {{.018, .088, .20}, {.19, .25, .32}}},
    {"Cream", {{.0002, .0028, .0163}, {7.38, 5.47, 3.15}}},
    {"Ketchup", {{.061, .97, 1.45}, {.18, .07, .03}}},
    {"Marble", {{.0021, .0041, .0071}, {2.19, 2.62, 3.00}}},
    {"Potato", {{.0024, .0090, .12}, {.68, .70, .55}}},
    {"Skimmilk", {{.0014, .0025, .0142}, {.70, 1.22, 1.90}}},
    {"Skin1", {{.032, .17, .48}, {.74, .88, 1.01}}},
    {"Skin2", {{.013, .070, .145}, {1.09, 1.59, 1.79}}},
    {"Spectralon", {{0, 0, 0}, {11.6, 20.4, 14.9}}},
    {"Wholemilk", {{.0011, .0024, .014}, {2.55, 3.21, 3.77}}},
};

}  // namespace

std::optional<SubsurfaceCoefficients> MeasuredCoefficients(const std::string& medium) {
  for (const MeasuredMedium& measured : kMeasuredMedia)
    if (medium == measured.name) return measured.coefficients;
  return std::nullopt;
}

std::vector<std::string> MeasuredMedia() {
  std::vector<std::string> names;
  for (const MeasuredMedium& measured : kMeasuredMedia) names.emplace_back(measured.name);
  return names;
}

double InternalReflectance(double eta) {
  return -1.4399 / (eta * eta) + .7099 / eta + .6681 + .0636 * eta;
}

std::array<double, 3> DipoleReflectance(const SubsurfaceCoefficients& medium, double eta) {
  const double internal = InternalReflectance(std::clamp(eta, 1., 3.));
  const double boundary = (1 + internal) / (1 - internal);  // A in the paper
  std::array<double, 3> reflectance{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double absorption = std::max(medium.absorption[c], 0.);
    const double scattering = std::max(medium.reducedScattering[c], 0.);
    const double extinction = absorption + scattering;
    if (!(extinction > 0)) continue;  // the medium neither scatters nor absorbs
    const double albedo = scattering / extinction;
    const double root = std::sqrt(3 * absorption / extinction);
    reflectance[c] = albedo / 2 * (1 + std::exp(-4. / 3 * boundary * root)) * std::exp(-root);
  }
  return reflectance;
}

}  // namespace exphoton
