// SPDX-License-Identifier: BSD-2-Clause
// The light "infinite" emits radiance from all directions, uniform or from a latitude-longitude map
// (azimuth about z from x, polar angle from +z). Directions are sampled in proportion to the cells
// of the map, uniformly in solid angle within a cell. Photons start on a disk covering the scene.
#include <vector>

#include "core/imaging/image.h"
#include "core/math/sampling/distribution.h"
#include "core/math/sampling/sampling.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  Spectrum radiance{1};
  Spectrum scale{1};
  std::string mapName;
  int sampleCount = 1;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("L", &Settings::radiance, "radiance, or factor on the map")
          .AtLeast(0)
          .Unit("W/(m^2 sr)"),
      Param("scale", &Settings::scale, "factor on L").AtLeast(0),
      Param("mapname", &Settings::mapName,
            "latitude-longitude map (EXR or PNG); top row is +z of the light")
          .As(ParamType::File),
      Param("nsamples", &Settings::sampleCount, "shadow rays at a shading point")
          .Range(1, 1 << 20)};
  return table;
}

// This class stores the radiance over the sphere in light space, bilinear between texels. It
// samples directions by the mean radiance in each cell, so the density is positive wherever the
// radiance is.
class EnvironmentMap {
 public:
  EnvironmentMap(std::vector<Spectrum> texels, int width, int height)
      : texels_(std::move(texels)), width_(width), height_(height) {
    std::vector<double> weights;
    weights.reserve(texels_.size());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const Spectrum mean = CellMean(x, y);
        const double solidAngle = CellSolidAngle(y);
        for (int c = 0; c < Spectrum::kChannels; ++c)
          integral_[std::size_t(c)] += double(mean[c]) * solidAngle;
        for (int c = 0; c < Spectrum::kChannels; ++c)
          largest_[c] = std::max(largest_[c], Texel(x, y)[c]);
        weights.push_back(double(mean.MaxComponent()) * solidAngle);
      }
    }
    cells_ = PiecewiseConstant2D(weights, width_, height_);
  }

  // Largest value of each channel. Unlike the integral, it cannot underflow to 0.
  const Spectrum& Largest() const { return largest_; }
  // Integral of the radiance over the sphere.
  Spectrum Integral() const { return {Real(integral_[0]), Real(integral_[1]), Real(integral_[2])}; }

  Spectrum Evaluate(const Vector3& w) const {
    const Coordinates c = ToMap(w);
    const double x = c.x - .5, y = c.y - .5;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    const Real fx = Real(x - x0), fy = Real(y - y0);
    return Lerp(fy, Lerp(fx, Texel(x0, y0), Texel(x0 + 1, y0)),
                Lerp(fx, Texel(x0, y0 + 1), Texel(x0 + 1, y0 + 1)));
  }

  // Returns the density of Sample per solid angle.
  Real Pdf(const Vector3& w) const {
    const Coordinates c = ToMap(w);
    const int column = std::min(int(c.x), width_ - 1), row = std::min(int(c.y), height_ - 1);
    const Point2 centre{Real((column + .5) / width_), Real((row + .5) / height_)};
    return Real(double(cells_.Pdf(centre)) / (double(width_) * height_ * CellSolidAngle(row)));
  }

  Vector3 Sample(Point2 u) const {
    const Point2 p = cells_.Sample(u);
    const double y = double(p.y) * height_;
    const int row = std::min(int(y), height_ - 1);
    // 1 - cos is linear in the position within the cell, and has no cancellation at the pole z = 1.
    const double a = OneMinusCosOfRow(row), b = OneMinusCosOfRow(row + 1);
    const double t = a + (y - row) * (b - a);
    const double sinTheta = std::sqrt(std::max(t * (2 - t), 0.0));
    const double phi = 2 * kPiDouble * double(p.x);
    return {Real(sinTheta * std::cos(phi)), Real(sinTheta * std::sin(phi)), Real(1 - t)};
  }

 private:
  static constexpr double kPiDouble = 3.14159265358979323846;

  // Position in texels: x in [0, width], y in [0, height].
  struct Coordinates {
    double x, y;
  };
  Coordinates ToMap(const Vector3& w) const {
    double phi = std::atan2(double(w.y), double(w.x));
    if (phi < 0) phi += 2 * kPiDouble;
    const double theta = std::atan2(std::hypot(double(w.x), double(w.y)), double(w.z));
    return {phi / (2 * kPiDouble) * width_, theta / kPiDouble * height_};
  }
  double OneMinusCosOfRow(int row) const {
    const double s = std::sin(kPiDouble * row / height_ / 2);
    return 2 * s * s;
  }
  double CellSolidAngle(int row) const {
    return 2 * kPiDouble / width_ * (OneMinusCosOfRow(row + 1) - OneMinusCosOfRow(row));
  }
  // Columns wrap around. Beyond a pole the same row continues, rotated by half a turn.
  Spectrum Texel(int x, int y) const {
    if (y < 0 || y >= height_) {
      y = std::clamp(y, 0, height_ - 1);
      x += width_ / 2;
    }
    x = (x % width_ + width_) % width_;
    return texels_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
  }
  // Returns the mean of the bilinear interpolant over a cell: weights 1/8, 6/8, 1/8 per axis.
  Spectrum CellMean(int x, int y) const {
    constexpr Real kWeights[3] = {Real(.125), Real(.75), Real(.125)};
    Spectrum sum;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i) sum += kWeights[i + 1] * kWeights[j + 1] * Texel(x + i, y + j);
    return sum;
  }

  std::vector<Spectrum> texels_;
  int width_, height_;
  std::array<double, 3> integral_{};
  Spectrum largest_;
  PiecewiseConstant2D cells_;
};

class InfiniteLight final : public Light {
 public:
  // If map is null, the radiance is uniform.
  InfiniteLight(const Transform& lightToWorld, const Spectrum& radiance,
                std::unique_ptr<EnvironmentMap> map, int sampleCount)
      : toWorld_(lightToWorld),
        toLight_(lightToWorld.Inverted()),
        radiance_(radiance),
        map_(std::move(map)),
        sampleCount_(sampleCount) {
    const Vector3 x = toWorld_.ApplyVector({1, 0, 0}), y = toWorld_.ApplyVector({0, 1, 0});
    determinant_ = AbsDot(Cross(x, y), toWorld_.ApplyVector({0, 0, 1}));
  }

  void Prepare(const Sphere3& world) override { world_ = world; }
  bool IsInfinite() const override { return true; }
  bool IsDistant() const override { return true; }
  bool IsProvablyBlack() const override {
    return radiance_.IsBlack() || (map_ && (radiance_ * map_->Largest()).IsBlack());
  }
  int SampleCount() const override { return sampleCount_; }
  Spectrum Power() const override {
    const Spectrum integral = map_ ? map_->Integral() : Spectrum(4 * kPi);
    return radiance_ * integral * DiskArea();
  }

  Spectrum Le(const Vector3& w) const override {
    return map_ ? radiance_ * map_->Evaluate(ToLight(w)) : radiance_;
  }

  std::optional<LightLiSample> SampleDirect(const SurfacePoint& ref, Point2 u,
                                            Real) const override {
    const auto wi = SampleDirection(u);
    if (!wi) return std::nullopt;
    return LightLiSample{*wi, Le(*wi), DirectionPdf(*wi), SpawnRay(ref, *wi)};
  }
  Real PdfDirect(const SurfacePoint&, const Vector3& wi, const SurfacePoint* on) const override {
    return on ? 0 : DirectionPdf(wi);
  }

  // The density is DirectionPdf per solid angle times 1 / (pi r^2) per area of the disk.
  std::optional<LightLeSample> SampleEmission(Point2 uPosition, Point2 uDirection, Real,
                                              Real time) const override {
    const auto w = SampleDirection(uDirection);
    if (!w || !(world_.radius > 0)) return std::nullopt;
    const Point2 d = SampleDisk(uPosition);
    const Frame frame = Frame::FromZ(*w);
    // Start slightly outside the sphere, so that rounding never starts a photon inside a wall that
    // touches the sphere.
    const Vector3 offset = frame.x * d.x + frame.y * d.y + *w * Real(1.001);
    const Ray ray{world_.center + offset * world_.radius, -*w, kInfinity, time};
    const Real pdf = DirectionPdf(*w);
    return LightLeSample{ray, Le(*w) * (DiskArea() / pdf), 1 / DiskArea(), pdf};
  }
  EmissionPdf PdfEmission(const SurfacePoint&, const Vector3& w) const override {
    return {world_.radius > 0 ? 1 / DiskArea() : 0, DirectionPdf(-w)};
  }

 private:
  Real DiskArea() const { return kPi * world_.radius * world_.radius; }
  Vector3 ToLight(const Vector3& w) const {
    return NormalizeOr(toLight_.ApplyVector(w), {0, 0, 1});
  }

  // Samples a world direction towards the light; nullopt if its density rounds to 0.
  std::optional<Vector3> SampleDirection(Point2 u) const {
    const Vector3 w = map_ ? NormalizeOr(toWorld_.ApplyVector(map_->Sample(u)), {0, 0, 1})
                           : SampleUniformSphere(u);
    if (!(DirectionPdf(w) > 0)) return std::nullopt;
    return w;
  }
  // Returns the density per solid angle in world space. A transformation M that is not a similarity
  // stretches solid angles by |det M| / |M w|^3.
  Real DirectionPdf(const Vector3& w) const {
    if (!map_) return kUniformSpherePdf;
    const Vector3 local = ToLight(w);
    const Real stretch = Length(toWorld_.ApplyVector(local));
    return map_->Pdf(local) * (stretch * stretch * stretch / determinant_);
  }

  Transform toWorld_, toLight_;
  Spectrum radiance_;
  std::unique_ptr<EnvironmentMap> map_;
  int sampleCount_;
  Real determinant_;
  Sphere3 world_;
};

// Reads the colours of the map. Negative and non-finite values become 0, with a warning.
std::vector<Spectrum> ReadTexels(const Image& image, const std::string& name,
                                 const LightContext& context) {
  const int channels[3] = {image.FindChannel("R"), image.FindChannel("G"), image.FindChannel("B")};
  if (channels[0] < 0 || channels[1] < 0 || channels[2] < 0)
    throw ParamError{"mapname", "\"" + name + "\" lacks one of the channels R, G, B", ""};
  long long bad = 0;
  std::vector<Spectrum> texels(std::size_t(image.Width()) * std::size_t(image.Height()));
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const int x = int(i % std::size_t(image.Width())), y = int(i / std::size_t(image.Width()));
    for (int c = 0; c < 3; ++c) {
      const float value = image.At(x, y, channels[c]);
      const bool isRadiance = std::isfinite(value) && value >= 0;
      if (!isRadiance) ++bad;
      texels[i][c] = isRadiance ? Real(value) : 0;
    }
  }
  if (bad > 0)
    context.log.Warning("\"" + name + "\": " + std::to_string(bad) +
                            " values are negative or not finite; they count as 0",
                        context.where);
  return texels;
}

std::unique_ptr<Light> Create(const Settings& settings, const LightContext& context) {
  Spectrum radiance = settings.radiance * settings.scale;
  std::unique_ptr<EnvironmentMap> map;
  if (!settings.mapName.empty()) {
    Image image;
    try {
      image = ReadImage(settings.mapName);
    } catch (const ImageError& error) {
      throw ParamError{"mapname", error.what(), ""};
    }
    std::vector<Spectrum> texels = ReadTexels(image, settings.mapName, context);
    if (texels.empty()) throw ParamError{"mapname", "names an image without pixels", ""};
    const auto differs = [&](const Spectrum& s) { return !(s == texels.front()); };
    if (std::none_of(texels.begin(), texels.end(), differs)) {
      radiance *= texels.front();  // a map of one colour is a uniform light
      if (texels.front().IsBlack())
        context.log.Warning("\"" + settings.mapName + "\" is black: the light is off",
                            context.where);
    } else {
      map = std::make_unique<EnvironmentMap>(std::move(texels), image.Width(), image.Height());
    }
    if (!context.lightToWorld.SimilarityScale())
      context.log.Warning(
          "light \"infinite\": the transformation is not a similarity; the map is "
          "stretched",
          context.where);
  }
  return std::make_unique<InfiniteLight>(context.lightToWorld, radiance, std::move(map),
                                         settings.sampleCount);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("infinite", "light from all directions, uniform or from a map")
