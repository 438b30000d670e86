// SPDX-License-Identifier: BSD-2-Clause
// The medium "exponential" has the density a exp(-b h) at height h above the lower corner of the
// box (the smaller of p0 and p1 on each axis) along updir, like air or ground fog. The integral
// along a ray has a closed form, so it needs no ray marching.
#include "materials/volumes/common/box_medium.h"

namespace exphoton {
namespace {

struct Settings : MediumSettings {
  Real a = 1, b = 1;
  Vector3 up{0, 1, 0};

  void Validate() const {
    if (up == Vector3()) throw ParamError{"updir", "must not be 0", ""};
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      MediumParameters(),
      Param("a", &Settings::a, "density at the lower corner: the smaller of p0 and p1 on each axis")
          .AtLeast(0),
      Param("b", &Settings::b, "how fast it falls with height; the height of 1/e is 1 / b"),
      Param("updir", &Settings::up, "direction of increasing height; its length scales the height")
          .As(ParamType::Vector)};
  return table;
}

class Exponential {
 public:
  explicit Exponential(const Settings& s)
      : a_(double(s.a)), b_(double(s.b)), bottom_(Min(s.p0, s.p1)), up_(s.up) {}

  bool IsZero() const { return !(a_ > 0); }
  double At(const Point3& p) const { return a_ > 0 ? a_ * std::exp(-b_ * Height(p)) : 0; }

  // Let the exponent change by x over the part. The mean density is then the density at the denser
  // end times (1 - e^-|x|) / |x|. The thinner end could be 0 in double precision.
  double Integral(const Point3& o, const Vector3& d, Interval part) const {
    if (!(a_ > 0)) return 0;
    const double length = double(part.max) - double(part.min);
    const double slope =
        double(d.x) * double(up_.x) + double(d.y) * double(up_.y) + double(d.z) * double(up_.z);
    const double x = b_ * slope * length;
    const double denser = double(x < 0 ? part.max : part.min);
    const double highest = a_ * std::exp(-b_ * (Height(o) + slope * denser));
    const double mean = std::abs(x) < 1e-12 ? 1 : -std::expm1(-std::abs(x)) / std::abs(x);
    return highest > 0 ? highest * mean * length : 0;
  }

 private:
  double Height(const Point3& p) const {
    return (double(p.x) - double(bottom_.x)) * double(up_.x) +
           (double(p.y) - double(bottom_.y)) * double(up_.y) +
           (double(p.z) - double(bottom_.z)) * double(up_.z);
  }

  double a_, b_;
  Point3 bottom_;
  Vector3 up_;
};

std::unique_ptr<Medium> Create(const Settings& settings, const MediumContext& context) {
  return std::make_unique<BoxMedium<Exponential>>(settings, context, Exponential(settings));
}

}  // namespace
}  // namespace exphoton

EXPHOTON_VOLUME("exponential", "a medium whose density falls with height")
