// SPDX-License-Identifier: BSD-2-Clause
// The material "mix" of version 2 blends two named materials: every lobe of the first times the
// amount, and every lobe of the second times one minus the amount. As in version 2, both are shaded
// in the frame of the first, with its bump map. Where the amount is 0, the result is exactly the
// second material, with its own bump map.
#include "core/params/suggestions.h"
#include "core/scattering/lobes/scaled.h"
#include "materials/common/surface_material.h"

namespace exphoton {
namespace {

struct Settings {
  TexturePtr<Spectrum> amount = Uniform(Spectrum(Real(.5)));
  std::string first, second;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("amount", &Settings::amount, "share of the first material").Range(0, 1),
      Param("namedmaterial1", &Settings::first, "name of the first material").Required(),
      Param("namedmaterial2", &Settings::second, "name of the second material").Required()};
  return table;
}

using MaterialPtr = std::shared_ptr<const Material>;

class Mix final : public Material {
 public:
  Mix(TexturePtr<Spectrum> amount, MaterialPtr first, MaterialPtr second)
      : amount_(std::move(amount)), first_(std::move(first)), second_(std::move(second)) {
    const auto constant = amount_->ConstantValue();
    usesFirst_ = !constant || !constant->IsBlack();
    usesSecond_ = !constant || *constant != Spectrum(1);
  }

  LobeSet PossibleLobes() const override {
    return (usesFirst_ ? first_->PossibleLobes() : LobeSet::None) |
           (usesSecond_ ? second_->PossibleLobes() : LobeSet::None);
  }
  bool NeedsDifferentials() const override {
    return amount_->IsFiltered() || (usesFirst_ && first_->NeedsDifferentials()) ||
           (usesSecond_ && second_->NeedsDifferentials());
  }
  // A material without lobes counts as one, which bounds the work of mixes of mixes.
  int LobeCount() const override {
    return std::max(first_->LobeCount(), 1) + std::max(second_->LobeCount(), 1);
  }

  Bsdf Evaluate(SurfaceInteraction* si, TransportMode mode, Arena* arena) const override {
    const Spectrum amount = Clamp(ReadNonNegative(amount_, *si), 0, 1);
    if (amount == Spectrum(1)) return first_->Evaluate(si, mode, arena);
    if (amount.IsBlack()) return second_->Evaluate(si, mode, arena);
    SurfaceInteraction copy = *si;
    const Bsdf second = second_->Evaluate(&copy, mode, arena);
    const Bsdf first = first_->Evaluate(si, mode, arena);
    const bool keepsCoat = MayBeCoated(first) && MayBeCoated(second);
    Bsdf mixed(*si);
    for (const Bxdf* lobe : first.Lobes())
      mixed.Add(arena->Make<ScaledLobe>(*lobe, amount, keepsCoat));
    for (const Bxdf* lobe : second.Lobes())
      mixed.Add(arena->Make<ScaledLobe>(*lobe, Spectrum(1) - amount, keepsCoat));
    return mixed;
  }

 private:
  // A coat lowers the diffuse light on both sides of a surface (RadiancePhotonMap). Every diffuse
  // lobe must therefore lie under it.
  static bool MayBeCoated(const Bsdf& bsdf) {
    return bsdf.IsCoated() || !bsdf.Has(LobeSet::Diffuse);
  }

  TexturePtr<Spectrum> amount_;
  MaterialPtr first_, second_;
  bool usesFirst_, usesSecond_;
};

MaterialPtr Find(const std::string& param, const std::string& name,
                 const MaterialContext& context) {
  MaterialPtr material = context.named ? context.named->Find(name) : nullptr;
  if (!material)
    throw ParamError{param, "names a material \"" + name + "\" that has not been defined",
                     context.named ? DidYouMean(name, context.named->Names()) : ""};
  return material;
}

std::unique_ptr<Material> Create(const Settings& settings, const MaterialContext& context) {
  auto mix = std::make_unique<Mix>(settings.amount, Find("namedmaterial1", settings.first, context),
                                   Find("namedmaterial2", settings.second, context));
  if (mix->LobeCount() > Bsdf::kMaxLobes)
    throw ParamError{"namedmaterial2",
                     "makes a mix of " + std::to_string(mix->LobeCount()) +
                         " lobes; a surface can have " + std::to_string(Bsdf::kMaxLobes),
                     "colours of 0 leave out the lobes that they scale"};
  return mix;
}

}  // namespace
}  // namespace exphoton

EXPHOTON_MATERIAL("mix", "blend of two named materials")
