// SPDX-License-Identifier: BSD-2-Clause
// ProbeLights checks samples of lights against densities, radiance and visibility, and light
// samplers against the probabilities that they give.
#include <cmath>

#include "core/lights/selection/light_sampler.h"
#include "tests/random/probes/focused_scene.h"
#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kReferences = 8, kSamplesOfLight = 6, kEmissions = 12;

bool AreClose(double a, double b, double share) {
  return std::abs(a - b) <= share * std::max(std::abs(a), std::abs(b)) + 1e-6;
}

// LightCheck checks one light.
class LightCheck {
 public:
  LightCheck(const ProbedScene& scene, const Light& light, RandomStream* random, Findings* findings)
      : scene_(scene), light_(light), random_(random), findings_(findings) {}

  void CheckDirect(const SurfacePoint& reference) {
    for (int i = 0; i < kSamplesOfLight; ++i) {
      const Point2 u = NextPoint(random_);
      const auto direct = light_.SampleDirect(reference, u, random_->Uniform());
      if (!direct || !(direct->pdf > 0)) continue;
      Expect(direct->shadowRay.time == reference.time, "time of a shadow ray",
             double(direct->shadowRay.time), double(reference.time));
      if (light_.IsDelta())
        continue;
      else if (light_.IsInfinite())
        CheckInfinite(reference, *direct);
      else
        CheckArea(reference, *direct);
    }
  }

  void CheckEmission() {
    for (int i = 0; i < kEmissions; ++i) {
      const Interval times = scene_.World().Exposure();
      const Real time = Lerp(random_->Uniform(), times.min, times.max);
      const Point2 u = NextPoint(random_), v = NextPoint(random_);
      const auto sample = light_.SampleEmission(u, v, random_->Uniform(), time);
      if (!sample) continue;
      Expect(sample->ray.time == time, "time of an emitted ray", double(sample->ray.time),
             double(time));
      if (light_.IsDelta())
        CheckEmissionOfPoint(*sample);
      else if (light_.IsInfinite())
        CheckEmissionOfSky(*sample);
      else
        CheckEmissionOfArea(*sample);
    }
  }

  // A few samples at an edge may miss the light by rounding, or meet another face of it.
  void Finish() {
    Expect(wrongDensities_ <= 1, "densities of directions to a light", wrongDensities_, meetings_);
    Expect(wrongRadiances_ <= 1, "radiance of a light", wrongRadiances_, meetings_);
    Expect(misses_ <= 2 + meetings_ / 5, "sampled points lie on the light", misses_, meetings_);
  }

 private:
  void Expect(bool isRight, const char* check, double value, double expected) {
    findings_->Expect(isRight, check, value, expected);
  }

  void CheckInfinite(const SurfacePoint& reference, const LightLiSample& direct) {
    const double pdf = double(light_.PdfDirect(reference, direct.wi, nullptr));
    Expect(AreClose(pdf, double(direct.pdf), .02), "density of a direction to the sky", pdf,
           double(direct.pdf));
    const Spectrum seen = light_.Le(direct.wi);
    Expect(AreClose(double(seen.Y()), double(direct.Li.Y()), .02), "radiance of the sky",
           double(seen.Y()), double(direct.Li.Y()));
  }

  void CheckArea(const SurfacePoint& reference, const LightLiSample& direct) {
    // The reference may lie in the plane of a flat light, which is then seen from its edge.
    if (AbsDot(reference.ng, direct.wi) < Real(.02)) return;
    const double sampled = double(Length(direct.shadowRay.d));  // its end is at t = 1
    const auto sight = scene_.Look(SpawnRay(reference, direct.wi));
    const double distance =
        sight ? double(Distance(sight->surface.p, reference.p)) : double(kInfinity);
    const bool isOccluded = scene_.World().Occluded(direct.shadowRay);
    if (distance < sampled * .99) {
      Expect(isOccluded, "a shadow ray that something blocks", distance, sampled);
    } else if (distance > sampled * 1.01) {
      ++misses_;
    } else if (std::abs(distance - sampled) < 1e-4 * sampled) {  // not another face at an edge
      ++meetings_;
      if (sight->surface.areaLight != &light_) return;  // two surfaces at one place
      const SurfaceInteraction& on = sight->surface;
      if (AbsDot(on.ng, direct.wi) < Real(.1)) return;  // rounding decides
      const double pdf = double(light_.PdfDirect(reference, direct.wi, &on));
      wrongDensities_ += !AreClose(pdf, double(direct.pdf), .03);
      const double seen = double(on.areaLight->L(on, on.uv, -direct.wi).Y());
      wrongRadiances_ += !AreClose(seen, double(direct.Li.Y()), .01);
    }
  }

  void CheckEmissionOfPoint(const LightLeSample& sample) {
    const SurfacePoint from{sample.ray.o, {}, {}, sample.ray.time};
    const double pdf = double(light_.PdfEmission(from, sample.ray.d).direction);
    if (!(pdf > 0)) return;  // all rays have one direction
    Expect(AreClose(pdf, double(sample.pdfDirection), .02), "density of a direction of a point",
           pdf, double(sample.pdfDirection));
  }

  void CheckEmissionOfSky(const LightLeSample& sample) {
    const Vector3& w = sample.ray.d;
    const SurfacePoint from{sample.ray.o, {}, {}, sample.ray.time};
    const auto pdf = light_.PdfEmission(from, w);
    Expect(AreClose(double(pdf.direction), double(sample.pdfDirection), .02),
           "density of an emitted direction", double(pdf.direction), double(sample.pdfDirection));
    const Spectrum power = light_.Le(-w) / (sample.pdfPosition * sample.pdfDirection);
    Expect(AreClose(double(power.Y()), double(sample.power.Y()), .02), "power of a ray of the sky",
           double(power.Y()), double(sample.power.Y()));
  }

  void CheckEmissionOfArea(const LightLeSample& sample) {
    const Vector3& w = sample.ray.d;
    const auto ahead = scene_.Look(sample.ray);  // another face is near where two faces meet
    const Real distance = std::min(Real(.01), ahead ? ahead->hit.hit.t / 2 : kInfinity);
    Ray back = sample.ray;
    back.o = sample.ray(distance), back.d = -w;
    const auto sight = scene_.Look(back);
    if (!sight || std::abs(sight->hit.hit.t - distance) > distance / 10) {
      ++misses_;
      return;
    }
    ++meetings_;
    const SurfaceInteraction& on = sight->surface;
    if (on.areaLight != &light_) return;
    const Real cosine = Dot(on.ng, w);
    if (!(cosine > Real(.1))) return;
    const auto pdf = light_.PdfEmission(on, w);
    wrongDensities_ += !AreClose(double(pdf.direction), double(sample.pdfDirection), .03);
    const Spectrum power =
        on.areaLight->L(on, on.uv, w) * (cosine / (sample.pdfPosition * sample.pdfDirection));
    wrongRadiances_ += !AreClose(double(power.Y()), double(sample.power.Y()), .05);
  }

  const ProbedScene& scene_;
  const Light& light_;
  RandomStream* random_;
  Findings* findings_;
  int misses_ = 0, meetings_ = 0, wrongDensities_ = 0, wrongRadiances_ = 0;
};

void CheckSelection(const ProbedScene& scene, LightSelection selection, Findings* findings) {
  constexpr int kChoices = 64;
  const auto& lights = scene.World().Lights();
  const auto sampler = scene.World().MakeLightSampler(selection);
  if (sampler->IsEmpty()) return;
  RandomStream random = scene.Stream(4);
  for (int i = 0; i < 3; ++i) {
    const Point3 p = RandomRay(&random, {0, 0}).o;
    std::vector<double> counts(lights.size());
    double sum = 0;
    for (int k = 0; k < kChoices; ++k) {
      const auto choice = sampler->Sample(p, (Real(k) + Real(.5)) / kChoices);
      const bool isIndex = lights[std::size_t(choice.index)].get() == choice.light;
      findings->Expect(isIndex, "index of a chosen light", choice.index, 0);
      const double pmf = double(sampler->Pmf(p, *choice.light));
      findings->Expect(AreClose(pmf, double(choice.probability), 1e-3),
                       "probability of a chosen light", pmf, double(choice.probability));
      findings->Expect(choice.remapped >= 0 && choice.remapped < 1, "remapped number",
                       double(choice.remapped), 0);
      counts[std::size_t(choice.index)] += 1. / kChoices;
    }
    for (std::size_t l = 0; l < lights.size(); ++l) {
      const double pmf = double(sampler->Pmf(p, *lights[l]));
      sum += pmf;
      findings->Expect(std::abs(counts[l] - pmf) < 4. / kChoices, "share of a light", counts[l],
                       pmf);
    }
    findings->Expect(AreClose(sum, 1, 1e-3), "sum of the probabilities of lights", sum, 1);
  }
}

}  // namespace

void ProbeLamps(const SceneModel& model, const ProbedScene& scene, Findings* findings) {
  int expected = 0, shining = 0;
  for (const BodyModel& body : model.bodies) {
    const bool emits = (body.emission == 1 && body.light.Max() > 0) || body.emission == 2;
    expected += emits && body.isInstance == 0;
  }
  for (const auto& light : scene.World().Lights())
    shining += !light->IsProvablyBlack() && !light->IsDelta() && !light->IsInfinite();
  findings->Expect(shining == expected, "lamps that shine", shining, expected);
}

void ProbeLoneLamps(std::uint64_t seed, Findings* findings) {
  constexpr std::uint64_t kLamps = 3;
  for (std::uint64_t i = 0; i < kLamps; ++i) {
    const SceneModel model = LoneLamp(kLamps * seed + i);
    const ProbedScene scene(SceneText(model, {}), seed, 24);
    ProbeSurfaces(scene, findings);
    ProbeLamps(model, scene, findings);
    ProbeLights(scene, findings);
  }
}

void ProbeLights(const ProbedScene& scene, Findings* findings) {
  RandomStream random = scene.Stream(5);
  for (const auto& light : scene.World().Lights()) {
    if (light->IsProvablyBlack()) continue;
    LightCheck check(scene, *light, &random, findings);
    for (int i = 0; i < std::min(kReferences, int(scene.Sights().size())); ++i)
      check.CheckDirect(scene.Sights()[std::size_t(i)].surface);
    check.CheckEmission();
    check.Finish();
  }
  for (const LightSelection selection :
       {LightSelection::Uniform, LightSelection::Power, LightSelection::Tree, LightSelection::Auto})
    CheckSelection(scene, selection, findings);
}

}  // namespace exphoton::random_scenes
