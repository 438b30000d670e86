// SPDX-License-Identifier: BSD-2-Clause
// fuzz_mis checks MIS weights and cones. For any densities the weights of two techniques lie in [0,
// 1] and add up to 1. Directions drawn from cones have unit length and a positive, finite density.
#include <cmath>

#include "core/math/sampling/mis.h"
#include "integrators/photon/gather/cone_mixture.h"
#include "tests/fuzz/input.h"

using namespace exphoton;

namespace {

void TryWeights(fuzz::Input* input) {
  const int nf = 1 + input->Byte(), ng = 1 + input->Byte();
  const Real pf = Real(input->Float()), pg = Real(input->Float());
  if (!(pf >= 0) || !(pg >= 0)) return;
  const Real w = PowerHeuristic(nf, pf, ng, pg), v = PowerHeuristic(ng, pg, nf, pf);
  fuzz::Require(w >= 0 && w <= 1 && v >= 0 && v <= 1, "weights lie in [0, 1]");
  if (pf > 0 || pg > 0) fuzz::Require(std::abs(w + v - 1) < Real(1e-6), "weights add up to 1");
}

void TryCones(fuzz::Input* input) {
  const Real angle = std::abs(Real(input->Float()));
  if (!(angle >= Real(1e-5)) || !(angle <= kPi / 2)) return;
  const Real uAxis = Real(input->Byte()) / 256;
  const Point2 u{Real(input->Byte()) / 256, Real(input->Byte()) / 256};
  constexpr std::size_t kMaxCones = 64;
  Arena arena;
  ConeDirections axes(kMaxCones, &arena);
  while (!input->IsEmpty() && axes.size() < kMaxCones) {
    const Point3 p = input->AnyPoint();
    const Vector3 axis = NormalizeOr(Vector3{p.x, p.y, p.z}, {0, 0, 1});
    if (IsFinite(axis)) axes.Add(axis);
  }
  axes.Finish();
  if (axes.size() == 0) return;
  const ConeMixture cones(axes, Cone(angle));
  const auto sample = cones.Draw(uAxis, u);
  fuzz::Require(IsFinite(sample.w) && std::abs(Length(sample.w) - 1) < Real(1e-5), "unit");
  fuzz::Require(sample.pdf > 0 && std::isfinite(sample.pdf), "a density");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input(data, size);
  if (input.Byte() % 2) {
    TryWeights(&input);
  } else {
    TryCones(&input);
  }
  return 0;
}
