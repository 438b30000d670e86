// SPDX-License-Identifier: BSD-2-Clause
// The texture "imagemap" reads an image file; t = 0 is the top row. A float texture takes the
// luminance. Non-finite pixels count as 0, with a warning. With "gamma", a texel is
// (scale * stored value)^gamma, as in version 2, where the values of 8-bit files are not sRGB.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/imaging/files/srgb.h"
#include "core/imaging/image.h"
#include "core/imaging/mipmap.h"
#include "core/params/scene_path.h"
#include "materials/textures/common/mapping.h"

namespace exphoton {
namespace {

struct ImageSettings : MappingSettings {
  std::string filename;
  WrapMode wrap = WrapMode::Repeat;
  Real maxAnisotropy = 8;
  bool trilinear = false;
  std::optional<Real> gamma;  // absent: sRGB files are decoded
  Real scale = 1;

  // Textures with equal keys share the pixels.
  std::string Key() const {
    std::ostringstream key;
    key << int(wrap) << ' ' << scale << ' ' << gamma.value_or(0) << ' ' << filename;
    return key.str();
  }
};

const ParamTable<ImageSettings>& ImageParameters() {
  static const ParamTable<ImageSettings> table{
      MappingParameters(),
      Param("filename", &ImageSettings::filename, "image file: EXR, HDR, JPEG, PFM, PNG or TGA")
          .As(ParamType::File)
          .Required(),
      Param("wrap", &ImageSettings::wrap, "the image outside the unit square")
          .OneOf({{"repeat", WrapMode::Repeat},
                  {"black", WrapMode::Black},
                  {"clamp", WrapMode::Clamp}}),
      Param("maxanisotropy", &ImageSettings::maxAnisotropy,
            "longest side of a filtered footprint over its shortest")
          .Range(1, 64),
      Param("trilinear", &ImageSettings::trilinear,
            "square footprints instead of elliptical ones: faster and more blurred"),
      Param("gamma", &ImageSettings::gamma,
            "exponent of the stored values; if absent, JPEG, PNG and TGA files are decoded from "
            "sRGB; 1 "
            "in scenes of version 2")
          .Above(0)
          .AtMost(100)
          .InVersion2({1}),
      Param("scale", &ImageSettings::scale, "factor of the values, before \"gamma\"")
          .Range(0, 1e6)};
  return table;
}

// Float and colour textures have the same parameters.
template <class T>
const ParamTable<ImageSettings>& Parameters() {
  return ImageParameters();
}

Real FromRgb(const Spectrum& rgb, Real) { return rgb.Y(); }
Spectrum FromRgb(const Spectrum& rgb, const Spectrum&) { return rgb; }

// Returns a channel of a texel. The stored value of a file in sRGB is encoded again.
Real Adjusted(float value, bool isFromSrgb, const ImageSettings& settings) {
  if (!settings.gamma) return Real(value) * settings.scale;
  const double stored = isFromSrgb ? EncodeSrgb(double(value)) : double(value);
  return Real(std::pow(std::max(stored * double(settings.scale), 0.), double(*settings.gamma)));
}

template <class T>
MipMap<T> ReadMipMap(const ImageSettings& settings, const TextureContext& context) {
  Image image;
  try {
    image = ReadImage(settings.filename);
  } catch (const ImageError& error) {
    throw ParamError{"filename", UnreadableFileText(settings.filename, error.what()), ""};
  }
  const int r = image.FindChannel("R"), g = image.FindChannel("G"), b = image.FindChannel("B");
  if (r < 0 || g < 0 || b < 0 || image.Width() < 1 || image.Height() < 1)
    throw ParamError{"filename", "'" + settings.filename + "' has no channels R, G and B", ""};
  std::vector<T> texels;
  texels.reserve(std::size_t(image.Width()) * std::size_t(image.Height()));
  std::size_t bad = 0;
  for (int y = 0; y < image.Height(); ++y) {
    for (int x = 0; x < image.Width(); ++x) {
      const auto channel = [&](int c) {
        return Adjusted(image.At(x, y, c), image.isFromSrgb, settings);
      };
      Spectrum rgb(channel(r), channel(g), channel(b));
      if (!rgb.IsFinite()) {
        rgb = Spectrum();
        ++bad;
      }
      texels.push_back(FromRgb(rgb, T{}));
    }
  }
  if (bad > 0) {
    context.log.Warning("'" + settings.filename + "': " + std::to_string(bad) +
                            " pixels are no finite number and count as 0",
                        context.where);
  }
  return MipMap<T>(image.Width(), image.Height(), std::move(texels), settings.wrap);
}

template <class T>
std::shared_ptr<const MipMap<T>> SharedMipMap(const ImageSettings& settings,
                                              const TextureContext& context) {
  return context.shared.GetOrMake<MipMap<T>>(settings.Key(),
                                             [&] { return ReadMipMap<T>(settings, context); });
}

template <class T>
class ImageMap final : public Texture<T> {
 public:
  ImageMap(const ImageSettings& s, const TextureContext& context)
      : mapping_(s.Mapping(context)),
        image_(SharedMipMap<T>(s, context)),
        maxAnisotropy_(s.maxAnisotropy),
        isTrilinear_(s.trilinear) {}

  T Evaluate(const SurfaceInteraction& si) const override {
    const TexturePoint2 at = mapping_.Map(si);
    if (isTrilinear_) return image_->Trilinear(at.st, at.dstdx, at.dstdy);
    return image_->Ewa(at.st, at.dstdx, at.dstdy, maxAnisotropy_);
  }
  bool IsFiltered() const override { return true; }

 private:
  TextureMapping2D mapping_;
  std::shared_ptr<const MipMap<T>> image_;
  Real maxAnisotropy_;
  bool isTrilinear_;
};

template <class T>
std::unique_ptr<Texture<T>> Create(const ImageSettings& settings, const TextureContext& context) {
  return std::make_unique<ImageMap<T>>(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_TEXTURE("imagemap", "image file, filtered over the pixel's footprint")
