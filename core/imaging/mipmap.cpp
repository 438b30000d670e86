// SPDX-License-Identifier: BSD-2-Clause
// MipMap: construction of the pyramid, and filtering.
#include "core/imaging/mipmap.h"

#include <array>

namespace exphoton {
namespace {

// The input texels that contribute to output texel `to` of `toCount`, and their weights by shared
// area. Halving the size needs at most three texels, and a fourth by rounding.
struct Share {
  int first = 0;
  int count = 0;
  std::array<Real, 4> weight{};
};
Share ShareOf(int to, int toCount, int fromCount) {
  const double ratio = double(fromCount) / toCount;
  const double begin = to * ratio, end = (to + 1) * ratio;
  Share share;
  share.first = int(begin);
  for (int i = share.first; i < fromCount && i < end && share.count < 4; ++i) {
    const double covered = std::min(end, i + 1.0) - std::max(begin, double(i));
    share.weight[std::size_t(share.count++)] = Real(covered / ratio);
  }
  return share;
}

int WrapIndex(int i, int count) {
  const int rest = i % count;
  return rest < 0 ? rest + count : rest;
}

// exp(-2 r^2), shifted to end at 0, for r^2 in [0, 1). The width is Heckbert's choice.
constexpr int kWeights = 128;
std::array<Real, kWeights> MakeGaussian() {
  std::array<Real, kWeights> table{};
  for (int i = 0; i < kWeights; ++i) {
    const Real r2 = (Real(i) + Real(.5)) / kWeights;
    table[std::size_t(i)] = std::exp(-2 * r2) - std::exp(Real(-2));
  }
  return table;
}
const std::array<Real, kWeights> kGaussian = MakeGaussian();

}  // namespace

template <class T>
MipMap<T>::MipMap(int width, int height, std::vector<T> texels, WrapMode wrap) : wrap_(wrap) {
  levels_.push_back({width, height, std::move(texels)});
  while (levels_.back().width > 1 || levels_.back().height > 1)
    levels_.push_back(Halved(levels_.back()));
}

template <class T>
typename MipMap<T>::Level MipMap<T>::Halved(const Level& fine) {
  const int width = std::max(fine.width / 2, 1), height = std::max(fine.height / 2, 1);
  std::vector<Share> columns;
  for (int x = 0; x < width; ++x) columns.push_back(ShareOf(x, width, fine.width));
  Level coarse{width, height, std::vector<T>(std::size_t(width) * std::size_t(height))};
  for (int y = 0; y < height; ++y) {
    const Share rows = ShareOf(y, height, fine.height);
    for (int x = 0; x < width; ++x) {
      const Share& column = columns[std::size_t(x)];
      T sum{};
      for (int j = 0; j < rows.count; ++j) {
        const T* row = &fine.texels[std::size_t(rows.first + j) * std::size_t(fine.width)];
        for (int i = 0; i < column.count; ++i) {
          sum +=
              row[column.first + i] * (rows.weight[std::size_t(j)] * column.weight[std::size_t(i)]);
        }
      }
      coarse.texels[std::size_t(y) * std::size_t(width) + std::size_t(x)] = sum;
    }
  }
  return coarse;
}

template <class T>
T MipMap<T>::Texel(int level, int x, int y) const {
  const Level& l = levels_[std::size_t(level)];
  switch (wrap_) {
    case WrapMode::Repeat:
      x = WrapIndex(x, l.width);
      y = WrapIndex(y, l.height);
      break;
    case WrapMode::Clamp:
      x = std::clamp(x, 0, l.width - 1);
      y = std::clamp(y, 0, l.height - 1);
      break;
    case WrapMode::Black:
      if (x < 0 || y < 0 || x >= l.width || y >= l.height) return T{};
  }
  return l.texels[std::size_t(y) * std::size_t(l.width) + std::size_t(x)];
}

// Moves st so near to the image that texel indices fit an int, without visible change.
template <class T>
Point2 MipMap<T>::Reduce(Point2 st) const {
  for (int i = 0; i < 2; ++i) {
    if (!std::isfinite(st[i])) st[i] = 0;
    st[i] = wrap_ == WrapMode::Repeat ? st[i] - std::floor(st[i])
                                      : std::clamp(st[i], Real(-3), Real(4));
  }
  return st;
}

template <class T>
T MipMap<T>::Bilinear(int level, Point2 st) const {
  const Real x = st.x * Real(Width(level)) - Real(.5), y = st.y * Real(Height(level)) - Real(.5);
  const Real x0 = std::floor(x), y0 = std::floor(y);
  const Real fx = x - x0, fy = y - y0;
  const int ix = int(x0), iy = int(y0);
  return Texel(level, ix, iy) * ((1 - fx) * (1 - fy)) + Texel(level, ix + 1, iy) * (fx * (1 - fy)) +
         Texel(level, ix, iy + 1) * ((1 - fx) * fy) + Texel(level, ix + 1, iy + 1) * (fx * fy);
}

template <class T>
template <class F>
T MipMap<T>::Blend(Real lod, F&& atLevel) const {
  const int top = LevelCount() - 1;
  if (!(lod < Real(top))) return atLevel(top);
  if (!(lod > 0)) return atLevel(0);
  const int level = int(lod);
  const Real t = lod - Real(level);
  return atLevel(level) * (1 - t) + atLevel(level + 1) * t;
}

template <class T>
T MipMap<T>::Trilinear(Point2 st, Point2 dstdx, Point2 dstdy) const {
  const Real across = std::max(std::abs(dstdx.x), std::abs(dstdy.x)) * Real(Width());
  const Real along = std::max(std::abs(dstdx.y), std::abs(dstdy.y)) * Real(Height());
  const Real width = 2 * std::max(across, along);
  const Point2 near = Reduce(st);
  if (!(width > 1)) return Bilinear(0, near);  // also for NaN
  return Blend(std::log2(width), [&](int level) { return Bilinear(level, near); });
}

template <class T>
T MipMap<T>::Ewa(Point2 st, Point2 dstdx, Point2 dstdy, Real maxAnisotropy) const {
  const Point2 near = Reduce(st);
  const Real w = Real(Width()), h = Real(Height());
  const Point2 a(dstdx.x * w, dstdx.y * h), b(dstdy.x * w, dstdy.y * h);
  Footprint m{a.x * a.x + b.x * b.x, a.x * a.y + b.x * b.y, a.y * a.y + b.y * b.y};
  const Real mean = (m.xx + m.yy) / 2, half = (m.xx - m.yy) / 2;
  const Real spread = std::sqrt(half * half + m.xy * m.xy);
  const Real major2 = mean + spread;
  if (!(major2 > 0)) return Bilinear(0, near);  // no footprint
  if (!std::isfinite(major2)) return Bilinear(LevelCount() - 1, near);
  const Real minor2 = std::max(mean - spread, Real(0));
  const Real widened2 = std::max(minor2, major2 / Square(maxAnisotropy));
  if (widened2 > minor2 && spread > 0) {
    // Widens the minor axis only: adds a multiple of I - v v', where v is the major axis.
    const Real cos2 = half / spread, sin2 = m.xy / spread;  // of twice v's angle
    const Real add = widened2 - minor2;
    m.xx += add * (1 - cos2) / 2;
    m.yy += add * (1 + cos2) / 2;
    m.xy -= add * sin2 / 2;
  }
  return Blend(std::log2(widened2) / 2, [&](int level) { return EwaLevel(level, near, m); });
}

// The footprint at each level is the pixel's footprint, widened by one texel for reconstruction.
// Some texel's centre is then always inside. The footprint is limited to the width of the level.
template <class T>
T MipMap<T>::EwaLevel(int level, Point2 st, const Footprint& footprint) const {
  const Real w = Real(Width(level)), h = Real(Height(level));
  const Real scaleX = std::min(w / Real(Width()), w / std::sqrt(std::max(footprint.xx, Real(1))));
  const Real scaleY = std::min(h / Real(Height()), h / std::sqrt(std::max(footprint.yy, Real(1))));
  const Real xx = footprint.xx * scaleX * scaleX + 1, yy = footprint.yy * scaleY * scaleY + 1;
  const Real xy = footprint.xy * scaleX * scaleY;
  const Real inverse = kWeights / (xx * yy - xy * xy);
  const Real reachX = std::sqrt(xx), reachY = std::sqrt(yy);
  const Real x = st.x * w - Real(.5), y = st.y * h - Real(.5);
  T sum{};
  Real weights = 0;
  const int x0 = int(std::ceil(x - reachX)), x1 = int(std::floor(x + reachX));
  const int y1 = int(std::floor(y + reachY));
  for (int iy = int(std::ceil(y - reachY)); iy <= y1; ++iy) {
    const Real dy = Real(iy) - y;
    for (int ix = x0; ix <= x1; ++ix) {
      const Real dx = Real(ix) - x;
      const Real r2 = (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) * inverse;
      if (!(r2 < kWeights)) continue;
      const Real weight = kGaussian[std::size_t(std::max(r2, Real(0)))];
      sum += Texel(level, ix, iy) * weight;
      weights += weight;
    }
  }
  return weights > 0 ? sum * (1 / weights) : Bilinear(level, st);
}

template class MipMap<Real>;
template class MipMap<Spectrum>;

}  // namespace exphoton
