// SPDX-License-Identifier: BSD-2-Clause
// The light "projection" throws an image from one point, as a slide projector. The transformation
// alone places it.
//
// It looks along +z of the light. A direction (x, y, z) with z > 0 meets the plane z = 1 at
// (X, Y) = (x / z, y / z). The image covers |X| <= a, |Y| <= b, where the smaller of a and b is
// tan(fov / 2) and a / b = width / height. Columns go from X = -a to a, and rows from Y = -b to b,
// the first row of the file at -b. Outside the image and behind the light, the intensity is 0.
//
// An area dX dY subtends the solid angle dX dY / (1 + X^2 + Y^2)^(3/2). A density per area of the
// plane is therefore a density per solid angle divided by this factor. A rectangle has the solid
// angle F(X1, Y1) - F(X0, Y1) - F(X1, Y0) + F(X0, Y0), F(X, Y) = atan(X Y / sqrt(1 + X^2 + Y^2)).
#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/sampling/distribution.h"
#include "lights/environment/map_texels.h"
#include "lights/environment/mapped_point_light.h"

namespace exphoton {
namespace {

struct Settings : MappedPointLightSettings {
  std::string mapName;
  Real fov = 45;  // degrees
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      MappedPointLightParameters(),
      Param("mapname", &Settings::mapName,
            "image file, as for imagemap; first row is -y of the light; a white square if absent")
          .As(ParamType::File),
      Param("fov", &Settings::fov, "angle of the shorter axis of the image")
          .Above(0)
          .Below(180)
          .Unit("degrees")};
  return table;
}

// 1 / (1 + X^2 + Y^2)^(3/2): solid angle per area of the plane.
double SolidAnglePerArea(double x, double y) {
  const double r2 = 1 + x * x + y * y;
  return 1 / (r2 * std::sqrt(r2));
}

struct Rectangle {
  double x0, y0, x1, y1;

  double SolidAngle() const { return F(x1, y1) - F(x0, y1) - F(x1, y0) + F(x0, y0); }

 private:
  static double F(double x, double y) { return std::atan(x * y / std::sqrt(1 + x * x + y * y)); }
};

class ProjectedImage final : public IntensityMap {
 public:
  // tanHalf is the tangent of half the angle of the shorter axis.
  ProjectedImage(MapTexels map, double tanHalf)
      : isUniform_(map.IsUniform()),
        texels_(std::move(map.texels)),
        width_(map.width),
        height_(map.height) {
    const double aspect = double(width_) / height_;
    a_ = tanHalf * std::max(aspect, 1.);
    b_ = tanHalf * std::max(1 / aspect, 1.);
    for (const Spectrum& texel : texels_)
      for (int c = 0; c < Spectrum::kChannels; ++c) largest_[c] = std::max(largest_[c], texel[c]);
    columns_ = width_ * std::max(1, kLeastCells / width_);
    rows_ = height_ * std::max(1, kLeastCells / height_);
    std::vector<double> weights;
    weights.reserve(std::size_t(columns_) * std::size_t(rows_));
    for (int y = 0; y < rows_; ++y) {
      for (int x = 0; x < columns_; ++x) {
        const std::array<double, 3> cell = CellIntegral(x, y);
        for (std::size_t c = 0; c < 3; ++c) integral_[c] += cell[c];
        weights.push_back(*std::max_element(cell.begin(), cell.end()));
      }
    }
    distribution_ = PiecewiseConstant2D(weights, columns_, rows_);
  }

  Spectrum Integral() const override {
    return {Real(integral_[0]), Real(integral_[1]), Real(integral_[2])};
  }
  Spectrum Largest() const override { return largest_; }
  Spectrum LargestWeight() const override {
    Spectrum largest;
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x) {
        const Spectrum value = LargestWeight(x, y);
        for (int c = 0; c < Spectrum::kChannels; ++c) largest[c] = std::max(largest[c], value[c]);
      }
    return largest;
  }

  // The corners of the image are the farthest directions from the axis.
  Cone EmissionCone() const override { return {{0, 0, 1}, std::atan(std::hypot(a_, b_))}; }

  Spectrum Evaluate(const Vector3& w) const override {
    const auto p = OnImage(w);
    return p ? Interpolate(p->s, p->t) : Spectrum();
  }

  // Samples a cell by the light that passes it, and a point in the cell uniformly by area.
  Vector3 Sample(Point2 u) const override {
    const Point2 p = distribution_.Sample(u);
    const double x = (2 * double(p.x) - 1) * a_, y = (2 * double(p.y) - 1) * b_;
    const double length = std::sqrt(1 + x * x + y * y);
    return {Real(x / length), Real(y / length), Real(1 / length)};
  }
  Real Pdf(const Vector3& w) const override {
    const auto p = OnImage(w);
    if (!p) return 0;
    const int column = std::min(int(p->s * columns_), columns_ - 1);
    const int row = std::min(int(p->t * rows_), rows_ - 1);
    const Point2 centre{Real((column + .5) / columns_), Real((row + .5) / rows_)};
    const double x = double(w.x) / double(w.z), y = double(w.y) / double(w.z);
    return Real(double(distribution_.Pdf(centre)) / (4 * a_ * b_ * SolidAnglePerArea(x, y)));
  }

 private:
  // Position on the image: both in [0, 1].
  struct Position {
    double s, t;
  };
  std::optional<Position> OnImage(const Vector3& w) const {
    if (!(w.z > 0)) return std::nullopt;
    const double s = (double(w.x) / double(w.z) / a_ + 1) / 2;
    const double t = (double(w.y) / double(w.z) / b_ + 1) / 2;
    if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1)) return std::nullopt;
    return Position{s, t};
  }
  const Spectrum& Texel(int x, int y) const {
    x = std::clamp(x, 0, width_ - 1);
    y = std::clamp(y, 0, height_ - 1);
    return texels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
  }
  // Bilinear between the centres of texels; constant beyond the outermost centres.
  Spectrum Interpolate(double s, double t) const {
    const double x = s * width_ - .5, y = t * height_ - .5;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const Real fx = Real(x - x0), fy = Real(y - y0);
    return Lerp(fy, Lerp(fx, Texel(x0, y0), Texel(x0 + 1, y0)),
                Lerp(fx, Texel(x0, y0 + 1), Texel(x0 + 1, y0 + 1)));
  }

  double X(double s) const { return (2 * s - 1) * a_; }
  double Y(double t) const { return (2 * t - 1) * b_; }

  // Returns the number of steps of the midpoint rule in a cell, along an axis where the plane has
  // the extent `width` and the image has `cells` cells. One step at the centre of a texel would
  // miss its neighbours, although the interpolant reaches them. An even number of steps sees them,
  // and has no error for a bilinear interpolant.
  int StepsOf(double width, int cells) const {
    if (isUniform_) return 1;
    constexpr double kStep = .005, kLeast = 2;
    const double most = std::max(kLeast, kMaxSteps / cells);
    return 2 * int(std::clamp(std::ceil(width / cells / kStep), kLeast, most) / 2);
  }

  // Returns the integral of the interpolant over the solid angle of a cell. The sum is scaled by
  // the exact solid angle, so that a uniform image has no error.
  std::array<double, 3> CellIntegral(int column, int row) const {
    const int nx = StepsOf(2 * a_, columns_), ny = StepsOf(2 * b_, rows_);
    std::array<double, 3> sum{};
    double weights = 0;
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        const double s = (column + (i + .5) / nx) / columns_, t = (row + (j + .5) / ny) / rows_;
        const double weight = SolidAnglePerArea(X(s), Y(t));
        const Spectrum value = Interpolate(s, t);
        for (int c = 0; c < 3; ++c) sum[std::size_t(c)] += weight * double(value[c]);
        weights += weight;
      }
    }
    const Rectangle cell{X(double(column) / columns_), Y(double(row) / rows_),
                         X((column + 1.) / columns_), Y((row + 1.) / rows_)};
    for (double& channel : sum) channel *= std::max(cell.SolidAngle(), 0.) / weights;
    return sum;
  }

  // Returns a bound on Evaluate / Pdf in a cell. Cells divide texels, so the interpolant is
  // bilinear between the borders of the cell and the centre of its texel, and largest at one of
  // these. The solid angle per area is largest at the point of the cell that is nearest to the
  // axis.
  Spectrum LargestWeight(int column, int row) const {
    const auto positions = [](int cell, int cells, int texels) {
      const double low = double(cell) / cells, high = (cell + 1.) / cells;
      const double centre = (std::floor((cell + .5) / cells * texels) + .5) / texels;
      return std::array{low, std::clamp(centre, low, high), high};
    };
    const auto s = positions(column, columns_, width_), t = positions(row, rows_, height_);
    const Point2 middle{Real((column + .5) / columns_), Real((row + .5) / rows_)};
    const double pdf = double(distribution_.Pdf(middle)) / (4 * a_ * b_);  // per area of the plane
    if (!(pdf > 0)) return {};
    const double stretch =
        SolidAnglePerArea(X(std::clamp(.5, s[0], s[2])), Y(std::clamp(.5, t[0], t[2])));
    Spectrum largest;
    for (const double u : s)
      for (const double v : t) {
        const Spectrum value = Interpolate(u, v);
        for (int c = 0; c < Spectrum::kChannels; ++c)
          largest[c] = std::max(largest[c], Real(double(value[c]) * stretch / pdf));
      }
    return largest;
  }

  static constexpr double kMaxSteps = 1024;  // over the image, along an axis
  // Coarser images have several cells for a texel, so that the weights of photons vary little.
  static constexpr int kLeastCells = 64;

  bool isUniform_;
  std::vector<Spectrum> texels_;
  int width_, height_;
  int columns_, rows_;  // of the cells by which directions are sampled
  double a_, b_;        // half the extents of the image on the plane z = 1
  std::array<double, 3> integral_{};
  Spectrum largest_;
  PiecewiseConstant2D distribution_;
};

std::unique_ptr<Light> Create(const Settings& settings, const LightContext& context) {
  MapTexels texels{{Spectrum(1)}, 1, 1};
  if (!settings.mapName.empty()) texels = ReadMapTexels(settings.mapName, context);
  const double tanHalf = std::tan(double(settings.fov) * 3.14159265358979323846 / 360);
  return MakeMappedPointLight(
      settings, std::make_unique<ProjectedImage>(std::move(texels), tanHalf), context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("projection", "light from one point through an image, as a slide projector's")
