// SPDX-License-Identifier: BSD-2-Clause
// PathWeight: sums the squared ratios of the other techniques' densities to the density of the
// technique that made the path. The ratios divide only by densities of vertices that were sampled.
#include "integrators/lightpaths/path_weight.h"

#include <cmath>

namespace exphoton {
namespace {

class RatioSum {
 public:
  explicit RatioSum(const WholePath& path) : path_(path), k_(int(path.vertices.size())) {}

  void Add(int technique, double ratio) {
    if (IsPossible(technique)) sum_ += ratio * ratio;
  }
  double Weight() const { return std::isfinite(sum_) ? 1 / sum_ : 0; }

  // The i-th vertex from the camera, counted from 1.
  const VertexDensities& At(int i) const { return path_.vertices[std::size_t(i - 1)]; }

 private:
  bool IsPossible(int s) const {
    if (s == 0) return !path_.isDeltaLight;
    if (s == 1) return !At(k_ - 1).isSpecular;
    return path_.hasLightPaths && !At(k_ - s).isSpecular && !At(k_ - s + 1).isSpecular;
  }

  const WholePath& path_;
  int k_;
  double sum_ = 1;  // of the technique itself
};

}  // namespace

double PathWeight(const WholePath& path, int s) {
  const int k = int(path.vertices.size());
  if (k < 2) return 1;
  RatioSum sum(path);
  const double direct = path.direct, hit = sum.At(k).fromCamera;
  // p_2 / p_0 is begin / (hit next); p_1 / p_0 is direct / hit.
  const double next = sum.At(k - 1).fromCamera;
  const double begin = sum.At(k).fromLight * sum.At(k - 1).fromLight;
  double ratio = 1;  // of technique j to technique s
  int j = 2;
  if (s == 0) {
    sum.Add(1, direct / hit);
    ratio = k > 2 ? begin / (hit * next) : 0;
  } else if (s == 1) {
    sum.Add(0, hit / direct);
    ratio = k > 2 ? begin / (direct * next) : 0;
  } else {
    for (j = s; j > 2; --j) {
      ratio *= sum.At(k - j + 1).fromCamera / sum.At(k - j + 1).fromLight;
      sum.Add(j - 1, ratio);
    }
    sum.Add(1, ratio * direct * next / begin);
    sum.Add(0, ratio * hit * next / begin);
    ratio = 1;
    j = s;
  }
  // Techniques with more vertices of the light path. The first vertex is always the camera's.
  if (s < 2 && k > 2) sum.Add(2, ratio);
  for (; j + 1 <= k - 1; ++j) {
    ratio *= sum.At(k - j).fromLight / sum.At(k - j).fromCamera;
    sum.Add(j + 1, ratio);
  }
  return sum.Weight();
}

}  // namespace exphoton
