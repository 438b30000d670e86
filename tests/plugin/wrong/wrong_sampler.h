// SPDX-License-Identifier: BSD-2-Clause
// WrongSampler draws 16 random points a pixel, by a rule that `exphoton check-plugin` must refuse:
// Rule::Key makes a key of a sample, and Rule::Number changes a number.
#pragma once

#include "core/math/sampling/random.h"
#include "core/plugin.h"

namespace exphoton {

// PlainRule does nothing wrong.
struct PlainRule {
  std::uint64_t Key(const SampleKey& key) const {
    return HashKey({key.seed, std::uint64_t(key.pixel.x), std::uint64_t(key.pixel.y),
                    std::uint64_t(key.index)});
  }
  Real Number(Real u) const { return u; }
};

template <class Rule>
class WrongSampler : public Sampler {
 public:
  std::int64_t SamplesPerPixel() const override { return 16; }
  std::unique_ptr<Sampler> WithSamplesPerPixel(std::int64_t) const override {
    return std::make_unique<WrongSampler>();
  }

  std::uint64_t FillCamera(const SampleKey& key, CameraSamples* samples) const override {
    const std::uint64_t sampleKey = rule_.Key(key);
    RandomStream random(sampleKey);
    samples->film = NextPoint(&random);
    samples->lens = NextPoint(&random);
    samples->time = rule_.Number(random.Uniform());
    return sampleKey;
  }
  void Fill(std::uint64_t sampleKey, std::int64_t, int request,
            std::span<Real> values) const override {
    RandomStream random(HashKey({sampleKey, std::uint64_t(request)}));
    for (Real& u : values) u = rule_.Number(random.Uniform());
  }
  void Fill(std::uint64_t sampleKey, std::int64_t, int request,
            std::span<Point2> values) const override {
    RandomStream random(HashKey({sampleKey, std::uint64_t(request)}));
    for (Point2& u : values) u = NextPoint(&random);
  }

 private:
  Point2 NextPoint(RandomStream* random) const {
    const Real x = rule_.Number(random->Uniform());
    return Point2(x, rule_.Number(random->Uniform()));
  }

  Rule rule_;
};

struct NoSettings {};

}  // namespace exphoton
