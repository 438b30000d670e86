// SPDX-License-Identifier: BSD-2-Clause
// ProbeScattering checks the BSDFs at hits: samples against values and densities, reciprocity, the
// laws of reflection and refraction, and the factor of refracted radiance.
#include <cmath>

#include "core/math/sampling/sampling.h"
#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {
namespace {

bool AreNear(const Spectrum& a, const Spectrum& b, double share) {
  const double size = std::max({1e-4, double(a.MaxComponent()), double(b.MaxComponent())});
  for (int c = 0; c < Spectrum::kChannels; ++c)
    if (std::abs(double(a[c] - b[c])) > share * size) return false;
  return true;
}

bool AreOnOneSide(const Bsdf& bsdf, const Vector3& w) {
  return Dot(w, bsdf.Ns()) * Dot(w, bsdf.Ng()) > 0;
}

void CheckSmoothSample(const Bsdf& bsdf, const Vector3& wo, const BsdfSample& sample, LobeSet mask,
                       Findings* findings) {
  const BsdfValue value = bsdf.Evaluate(wo, sample.wi, mask);
  const double pdf = double(sample.pdf);
  findings->Expect(std::abs(double(value.pdf) - pdf) < .01 * pdf, "density of a BSDF sample", pdf,
                   double(value.pdf));
  const Spectrum expected = value.f * (AbsDot(sample.wi, bsdf.Ns()) / value.pdf);
  findings->Expect(AreNear(expected, sample.throughput, .01), "throughput of a BSDF sample",
                   double(sample.throughput.Y()), double(expected.Y()));
}

// A mirror that is seen from between its normals reflects about the geometric one.
void CheckSpecularSample(const Bsdf& bsdf, const Vector3& wo, const BsdfSample& sample,
                         Findings* findings) {
  const bool usesNs = sample.IsTransmission() || AreOnOneSide(bsdf, wo);
  const Normal3& n = usesNs ? bsdf.Ns() : bsdf.Ng();
  const Vector3 in = sample.wi - n * Dot(n, sample.wi), out = wo - n * Dot(n, wo);
  const Real ratio = sample.IsTransmission() ? sample.eta : 1;
  const double off = double(Length(in + out * ratio));
  findings->Expect(off < 2e-3, "law of reflection and refraction", off, 0);
  const bool crosses = Dot(n, wo) * Dot(n, sample.wi) < 0;
  findings->Expect(crosses == sample.IsTransmission(), "side of a specular sample", crosses,
                   sample.IsTransmission());
}

// Only refracted radiance has a factor. The probabilities of the lobes may differ between the
// modes.
struct LobePoint {
  Point2 u;
  Real lobe;
};
void CheckModes(const SurfaceInteraction& surface, const Bsdf& radiance, Arena* arena,
                const LobePoint& at, Findings* findings) {
  SurfaceInteraction copy = surface;
  const Bsdf importance = surface.material->Evaluate(&copy, TransportMode::Importance, arena);
  const Vector3 wo = surface.wo;
  const auto a = radiance.Sample(wo, at.u, at.lobe, LobeSet::Specular);
  const auto b = importance.Sample(wo, at.u, at.lobe, LobeSet::Specular, TransportMode::Importance);
  if (!a || !b || a->IsTransmission() != b->IsTransmission()) return;
  const Real factor = a->IsTransmission() ? a->eta * a->eta : 1;
  const Spectrum seen = a->throughput * a->pdf, carried = b->throughput * (b->pdf * factor);
  findings->Expect(AreNear(carried, seen, .01), "radiance over power at a refraction",
                   double(seen.Y()), double(carried.Y()));
}

void CheckReciprocity(const Bsdf& bsdf, const Vector3& wo, const Vector3& wi, Findings* findings) {
  if (!AreOnOneSide(bsdf, wo) || !AreOnOneSide(bsdf, wi)) return;
  const Spectrum there = bsdf.f(wo, wi), back = bsdf.f(wi, wo);
  findings->Expect(AreNear(there, back, .02), "reciprocity", double(there.Y()), double(back.Y()));
}

void CheckBsdf(const Sight& sight, Arena* arena, RandomStream* random, Findings* findings) {
  SurfaceInteraction surface = sight.surface;
  const Bsdf bsdf = surface.material->Evaluate(&surface, TransportMode::Radiance, arena);
  const LobeSet possible = surface.material->PossibleLobes();
  for (const Bxdf* lobe : bsdf.Lobes())
    findings->Expect(lobe->Matches(possible), "a lobe that the material may have",
                     unsigned(lobe->Lobe()), unsigned(possible));
  const Vector3 wo = surface.wo;
  for (int i = 0; i < 4; ++i) {
    const Point2 u = NextPoint(random);
    const Real uLobe = random->Uniform();
    for (const LobeSet mask : {LobeSet::All, LobeSet::NonSpecular}) {
      const auto sample = bsdf.Sample(wo, u, uLobe, mask);
      if (!sample) continue;
      findings->Expect(std::abs(double(Length(sample->wi)) - 1) < 1e-4, "unit directions",
                       double(Length(sample->wi)), 1);
      if (sample->IsSpecular())
        CheckSpecularSample(bsdf, wo, *sample, findings);
      else
        CheckSmoothSample(bsdf, wo, *sample, mask, findings);
      if (!sample->IsSpecular()) CheckReciprocity(bsdf, wo, sample->wi, findings);
    }
    CheckModes(sight.surface, bsdf, arena, {u, uLobe}, findings);
    CheckReciprocity(bsdf, wo, SampleUniformSphere(NextPoint(random)), findings);
  }
}

}  // namespace

void ProbeScattering(const ProbedScene& scene, Findings* findings) {
  RandomStream random = scene.Stream(3);
  Arena arena;
  for (const Sight& sight : scene.Sights()) {
    if (!sight.surface.material) continue;
    arena.Reset();
    CheckBsdf(sight, &arena, &random, findings);
  }
}

}  // namespace exphoton::random_scenes
