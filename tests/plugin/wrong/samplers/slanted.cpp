// SPDX-License-Identifier: BSD-2-Clause
// Sampler "slanted" is wrong on purpose: the second coordinates of its arrays depend on the arrays
// before.
#include "tests/plugin/wrong/wrong_sampler.h"

namespace exphoton {
namespace {

using Settings = NoSettings;

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{};
  return table;
}

class SlantedSampler final : public WrongSampler<PlainRule> {
 public:
  std::unique_ptr<Sampler> WithSamplesPerPixel(std::int64_t) const override {
    return std::make_unique<SlantedSampler>();
  }
  using WrongSampler::Fill;
  void Fill(std::uint64_t sampleKey, std::int64_t element, int request,
            std::span<Point2> values) const override {
    WrongSampler::Fill(sampleKey, element, request, values);
    RandomStream random(++count_);
    for (Point2& u : values) u.y = random.Uniform();
  }

 private:
  mutable std::uint64_t count_ = 0;
};

std::unique_ptr<Sampler> Create(const Settings&, const SamplerContext&) {
  return std::make_unique<SlantedSampler>();
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SAMPLER("slanted", "its second coordinates depend on the arrays before")
