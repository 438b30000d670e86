// SPDX-License-Identifier: BSD-2-Clause
// Computes directions, densities, lobes, transformations and a hit in the precision of Real. The
// macro PRECISION_FUNCTION is the name of the function, and `exphoton` is another name for each.
// NOLINTBEGIN(bugprone-suspicious-include): the sources belong to this precision.
#include "tests/precision/kernels/kernels.h"

#include "core/geometry/triangle_single.h"
#include "core/math/octahedral.h"
#include "core/math/sampling/mis.h"
#include "core/math/sampling/sampling.h"
#include "core/math/transform.cpp"
#include "core/math/vec.cpp"
#include "core/scattering/lobes/lafortune.cpp"
#include "core/scattering/lobes/microfacet.cpp"
#include "core/scattering/lobes/oren_nayar.cpp"
#include "core/scattering/lobes/specular.cpp"
#include "core/scattering/medium.h"
// NOLINTEND(bugprone-suspicious-include)

namespace precision {
namespace {

using namespace exphoton;

class Values {
 public:
  void Add(const std::string& name, Real value) { all_.push_back({name, value}); }
  void Add(const std::string& name, const Vec3& v) {
    Add(name + ".x", v.x), Add(name + ".y", v.y), Add(name + ".z", v.z);
  }
  void Add(const std::string& name, const Bxdf& lobe, const Vector3& wo, const Vector3& wi) {
    Add(name + ".f", lobe.f(wo, wi)[0]);
    Add(name + ".pdf", lobe.Pdf(wo, wi));
  }
  std::vector<Value> Take() { return std::move(all_); }

 private:
  std::vector<Value> all_;
};

void AddWarps(const Point2& u, Values* values) {
  values->Add("cosine hemisphere", SampleCosineHemisphere(u));
  values->Add("uniform sphere", SampleUniformSphere(u));
  values->Add("uniform hemisphere", SampleUniformHemisphere(u));
  const Real oneMinusCos = OneMinusCos(Radians(1));
  values->Add("cone", SampleUniformCone(u, oneMinusCos));
  values->Add("cone.pdf", UniformConePdf(oneMinusCos));
  values->Add("triangle", SampleTriangle(u).x);
  const BlinnDistribution blinn(100);
  const Vector3 h = blinn.Sample(u);
  values->Add("blinn", h);
  values->Add("blinn.pdf", blinn.Pdf(h.z));
  const Vector3 w = SampleUniformSphere(u);
  values->Add("polar.phi", SphericalPhi(w));
  values->Add("polar.theta", SphericalTheta(w));
  values->Add("octahedron", OctahedralPlace(w).x);
  values->Add("frame", Frame::FromZ(w).ToWorld(h));
}

void AddLobes(const Vector3& wo, const Vector3& wi, Values* values) {
  const Fresnel glass = Fresnel::Dielectric(1, Real(1.5));
  values->Add("microfacet", Microfacet(Spectrum(1), glass, 50), wo, wi);
  values->Add("orennayar", OrenNayar(Spectrum(1), Radians(20)), wo, wi);
  const LafortuneLobe lobes[] = {{Spectrum(-1), Spectrum(Real(.9)), Spectrum(20)}};
  values->Add("lafortune", Lafortune(lobes, Spectrum(Real(.5))), wo, wi);
  values->Add("fresnel.in", FresnelDielectric(wo.z, 1, Real(1.5)));
  values->Add("fresnel.out", FresnelDielectric(-wo.z, 1, Real(1.5)));
  values->Add("fresnel.metal", FresnelConductor(wo.z, Real(.25), 3));
  values->Add("phase", HenyeyGreenstein(Real(.75), wo, wi));
  values->Add("weight",
              PowerHeuristic(1, CosineHemispherePdf(wi.z), 2, BlinnDistribution(8).Pdf(wo.z)));
}

void AddGeometry(const Vector3& axis, const Point3& p, Values* values) {
  const auto rotation = Transform::Rotate(30, axis);
  const Transform all = Transform::Translate(axis * 8) * *rotation;
  values->Add("transformed", all.ApplyPoint(p));
  const auto scaled = *Transform::Scale(1, 2, 4) * *rotation;
  values->Add("normal", scaled.ApplyNormal(axis));
  const Real corners[9] = {-8, -8, 16, 9, -8, 15, 0, 11, 17};
  const TriangleRay ray(Ray(Point3(0, 0, 0), p / 8 + Vector3(0, 0, 4)));
  const TriangleCorners<3, 1> corner{corners};
  if (const auto hit = HitInSingle(ray, corner)) {
    values->Add("hit.t", hit->t);
    values->Add("hit.b1", hit->b1);
  } else {  // the same values in each precision, or the test fails
    values->Add("hit.t", 0);
    values->Add("hit.b1", 0);
  }
}

}  // namespace

std::vector<Value> PRECISION_FUNCTION(const double* u) {
  Values values;
  const Point2 a{Real(u[0]), Real(u[1])}, b{Real(u[2]), Real(u[3])};
  AddWarps(a, &values);
  AddLobes(SampleCosineHemisphere(a), SampleCosineHemisphere(b), &values);
  AddGeometry(SampleUniformSphere(b), Point3(Real(u[4]), Real(u[5]), Real(u[6])), &values);
  return values.Take();
}

}  // namespace precision
