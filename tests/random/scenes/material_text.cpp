// SPDX-License-Identifier: BSD-2-Clause
// MaterialText writes the materials and textures of random scenes. Coefficients are scaled so that
// a material returns no more light than it receives. The exceptions are shinymetal, and metal,
// which has no coefficient to scale.
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "tests/random/scenes/scene_text.h"

namespace exphoton::random_scenes {
namespace {

// The lobes of a material together reflect at most this fraction.
constexpr double kReflected = .95;

double DiffuseShare(const MaterialModel& material) {
  constexpr std::array<double, 3> kShares{.8, .5, .2};
  return kShares[std::size_t(material.share)];
}

std::string Name(int number) { return "\"t" + std::to_string(number) + "\""; }

// Returns: Texture "tN" "color" CLASS
std::string Define(int number, const std::string& type, const std::string& rest) {
  return "  Texture " + Name(number) + " \"" + type + "\" " + rest + "\n";
}

// The sum of the amplitudes of all octaves of noise, by default.
constexpr int kOctaves = 2;

// Returns a noise texture divided by the largest value that it can have.
std::string Normalised(const std::string& noise, int largest, int* next, std::string* text) {
  const int number = (*next)++;
  *text += Define(number, "color", noise);
  return "\"scale\" \"texture tex1\" " + Name(number) + " \"color tex2\" " +
         ColourText({10, 10, 10}, 1. / largest);
}

// Returns the class of a texture and its parameters. Appends textures that it needs to `text`.
std::string ClassText(const TextureModel& t, int* next, std::string* text) {
  const std::string first = ColourText(t.first, 1), second = ColourText(t.second, 1);
  const std::string both = " \"color tex1\" " + first + " \"color tex2\" " + second;
  switch (t.kind) {
    case TextureKind::Scale:
      return "\"scale\"" + both;
    case TextureKind::Mix:
      return "\"mix\"" + both + " \"float amount\" .3";
    case TextureKind::Checkerboard:
      return "\"checkerboard\" \"float uscale\" 4 \"float vscale\" 4" + both;
    case TextureKind::CheckerboardOfSpace:
      return "\"checkerboard\" \"integer dimension\" 3" + both;
    case TextureKind::Bilerp:
      return "\"bilerp\" \"color v00\" " + first + " \"color v01\" " + second + " \"color v10\" " +
             second + " \"color v11\" " + first;
    case TextureKind::Uv:
      return "\"uv\"";
    case TextureKind::Image:
      return "\"imagemap\" \"string filename\" \"" + ImageFile() + "\"";
    case TextureKind::Nested: {
      const int board = (*next)++, product = (*next)++;
      *text += Define(board, "color", "\"checkerboard\" \"string aamode\" \"none\"" + both);
      *text += Define(product, "color",
                      "\"scale\" \"texture tex1\" " + Name(board) + " \"color tex2\" " + second);
      return "\"mix\" \"texture tex1\" " + Name(product) + " \"color tex2\" " + first;
    }
    case TextureKind::Dots:
      return "\"dots\" \"float uscale\" 5 \"float vscale\" 5 \"color inside\" " + first +
             " \"color outside\" " + second;
    case TextureKind::Fbm:
      return Normalised(R"("fbm" "integer octaves" 6)", kOctaves, next, text);
    case TextureKind::Wrinkled:
      return Normalised(R"("wrinkled" "float roughness" .5)", kOctaves, next, text);
    case TextureKind::Windy:
      return Normalised(R"("windy")", kOctaves * kOctaves, next, text);
    case TextureKind::Marble:
      return R"("marble" "float scale" 4 "float variation" .6)";
    case TextureKind::Constant:
      break;
  }
  return "\"constant\" \"color value\" " + first;
}

// Returns a parameter whose value is the texture times the factor.
std::string Coefficient(const std::string& name, const TextureModel& t, double factor, int* next,
                        std::string* text) {
  if (t.kind == TextureKind::Constant)
    return " \"color " + name + "\" " + ColourText(t.first, factor);
  const std::string definition = ClassText(t, next, text);
  const int inner = (*next)++, outer = (*next)++;
  *text += Define(inner, "color", definition);
  *text += Define(outer, "color",
                  "\"scale\" \"texture tex1\" " + Name(inner) + " \"color tex2\" " +
                      ColourText({10, 10, 10}, factor));
  return " \"texture " + name + "\" " + Name(outer);
}

std::string BumpText(int bump, int* next, std::string* text) {
  if (bump == 0) return "";
  const int number = (*next)++;
  std::string definition = "\"constant\" \"float value\" .1";
  if (bump == 2)
    definition = "\"checkerboard\" \"float uscale\" 3 \"float tex1\" .1 \"float tex2\" 0";
  if (bump == 3) definition = "\"bilerp\" \"float v01\" .2 \"float v10\" .1 \"float v11\" -.1";
  if (bump == 4) definition = "\"imagemap\" \"string filename\" \"" + ImageFile() + "\"";
  *text += Define(number, "float", definition);
  return " \"texture bumpmap\" " + Name(number);
}

// Returns a float parameter: one of three values, or a texture between the first two.
std::string Choice(const std::string& name, int choice, const std::array<const char*, 3>& values,
                   int* next, std::string* text) {
  if (choice < 3) return " \"float " + name + "\" " + values[std::size_t(choice)];
  const int number = (*next)++;
  *text += Define(number, "float",
                  std::string("\"checkerboard\" \"float vscale\" 3 \"float tex1\" ") + values[0] +
                      " \"float tex2\" " + values[1]);
  return " \"texture " + name + "\" " + Name(number);
}

// Returns uber's opacity, as MaterialModel::opacity defines it.
std::string OpacityText(int opacity, int* next, std::string* text) {
  if (opacity == 0) return "";
  if (opacity == 1) return " \"color opacity\" [.5 .5 .5]";
  if (opacity == 2) return " \"color opacity\" [0 0 1]";
  const int number = (*next)++;
  if (opacity == 4) {
    const int amount = (*next)++;
    *text += Define(amount, "float", "\"bilerp\" \"float v01\" .1 \"float v10\" .3");
    *text += Define(number, "color",
                    "\"mix\" \"color tex1\" [1 1 1] \"texture amount\" " + Name(amount));
  } else {
    *text += Define(number, "color", "\"checkerboard\" \"color tex1\" [1 1 1]");
  }
  return " \"texture opacity\" " + Name(number);
}

// Returns the largest value of a texture in a channel.
double Largest(const TextureModel& t, int Colour::*channel) {
  const bool isAnywhere = t.kind >= TextureKind::Fbm && t.kind <= TextureKind::Marble;
  if (isAnywhere || t.kind == TextureKind::Uv || t.kind == TextureKind::Image) return 1;
  if (t.kind == TextureKind::Constant) return .1 * (t.first.*channel);
  return .1 * std::max(t.first.*channel, t.second.*channel);
}

double AlbedoOf(const MaterialModel& m, int Colour::*channel) {
  const double kd = Largest(m.diffuse, channel), ks = Largest(m.glossy, channel),
               kr = Largest(m.mirror, channel);
  const double diffuse = DiffuseShare(m), glossy = kReflected - diffuse;
  switch (m.kind) {
    // The Oren-Nayar model returns up to 2 % more than its reflectance at grazing angles.
    case MaterialKind::Matte:
      return kReflected * kd * (m.roughness == 0 ? 1 : 1.02);
    case MaterialKind::Mirror:
      return kr;
    case MaterialKind::Glass:
      return std::max(kd, ks);
    case MaterialKind::Plastic:
      return diffuse * kd + glossy * ks;
    case MaterialKind::Translucent:
      return (diffuse * kd + glossy * ks) * (.5 + .5 * kr);
    case MaterialKind::Uber:
      return m.opacity != 0 ? 1 : diffuse * kd + glossy / 2 * (ks + kr);
    case MaterialKind::Mix:
      return std::max(kReflected * kd, kr);
    case MaterialKind::Metal:
    case MaterialKind::Substrate:
    case MaterialKind::ShinyMetal:
    case MaterialKind::Fitted:
    case MaterialKind::Measured:
      break;
  }
  return 1;
}

// Returns the two materials that a mix refers to, and appends its parameters. Both may have
// textures, which are defined first.
std::string PartsOfMix(const MaterialModel& m, int* next, std::string* parameters) {
  std::string text;
  const std::string matte = Coefficient("Kd", m.diffuse, kReflected, next, &text);
  const std::string mirror = Coefficient("Kr", m.mirror, 1, next, &text);
  const std::string first = Name((*next)++), second = Name((*next)++);
  *parameters += " \"string namedmaterial1\" " + first + " \"string namedmaterial2\" " + second +
                 " \"color amount\" [.3 .5 1]";
  return text + "  MakeNamedMaterial " + first + " \"string type\" \"matte\"" + matte +
         "\n  MakeNamedMaterial " + second + " \"string type\" \"mirror\"" + mirror + "\n";
}

}  // namespace

double SixDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

std::string ColourText(const Colour& colour, double factor, double scale) {
  const auto channel = [&](int value) { return SixDigits(.1 * factor * value) * scale; };
  char text[80];
  std::snprintf(text, sizeof text, "[%.12g %.12g %.12g]", channel(colour.red),
                channel(colour.green), channel(colour.blue));
  return text;
}

std::string ImageFile() {
  return std::string(EXPHOTON_SOURCE_DIR) + "/scenes/parts/tile_height.png";
}

std::string MeasurementFile() {
  return std::string(EXPHOTON_SOURCE_DIR) + "/tests/random/glossy.brdf";
}

std::array<double, 3> LargestAlbedo(const MaterialModel& material) {
  return {AlbedoOf(material, &Colour::red), AlbedoOf(material, &Colour::green),
          AlbedoOf(material, &Colour::blue)};
}

namespace {

// MaterialWriter writes a material's textures and its Material directive.
class MaterialWriter {
 public:
  MaterialWriter(const MaterialModel& material, int* next) : m_(material), next_(next) {}

  std::string Text(bool hasBumps) {
    constexpr std::array<const char*, kMaterialKinds> kNames{
        "matte",       "mirror", "glass",      "plastic", "metal", "substrate",
        "translucent", "uber",   "shinymetal", "",        "mix",   "measured"};
    constexpr std::array<const char*, 6> kFits{"bluepaint", "brushedmetal", "clay",
                                               "felt",      "primer",       "skin"};
    if (m_.kind == MaterialKind::Measured)
      parameters_ += " \"string filename\" \"" + MeasurementFile() + "\"";
    if (m_.kind == MaterialKind::Mix) text_ += PartsOfMix(m_, next_, &parameters_);
    AddParameters();
    const bool isFitted = m_.kind == MaterialKind::Fitted;
    const std::string name = isFitted ? kFits[std::size_t(m_.Fit())] : kNames[std::size_t(m_.kind)];
    if (hasBumps && m_.kind != MaterialKind::Mix) parameters_ += BumpText(m_.bump, next_, &text_);
    return text_ + "  Material \"" + name + "\"" + parameters_ + "\n";
  }

 private:
  void Add(const std::string& name, const TextureModel& texture, double factor) {
    parameters_ += Coefficient(name, texture, factor, next_, &text_);
  }
  void Choose(const char* name, const std::array<const char*, 3>& values) {
    parameters_ += Choice(name, m_.roughness, values, next_, &text_);
  }

  void AddParameters() {
    constexpr std::array<const char*, 3> kRough{".1", ".3", ".02"};
    const double diffuse = DiffuseShare(m_), glossy = kReflected - diffuse;
    switch (m_.kind) {
      case MaterialKind::Matte:
        Add("Kd", m_.diffuse, kReflected);
        Choose("sigma", {"0", "15", "40"});
        break;
      case MaterialKind::Mirror:
        Add("Kr", m_.mirror, 1);
        break;
      case MaterialKind::Glass:
        Add("Kt", m_.diffuse, 1);
        Add("Kr", m_.glossy, 1);
        Choose("index", {"1.5", "1.1", "1"});
        break;
      case MaterialKind::Metal:
        Choose("roughness", kRough);
        break;
      case MaterialKind::Plastic:
      case MaterialKind::Translucent:
      case MaterialKind::Uber:
        Add("Kd", m_.diffuse, diffuse);
        Add("Ks", m_.glossy, m_.kind == MaterialKind::Uber ? glossy / 2 : glossy);
        if (m_.kind == MaterialKind::Translucent) Add("transmit", m_.mirror, .5);
        if (m_.kind == MaterialKind::Translucent && m_.isTransmittingOnly)
          parameters_ += " \"color reflect\" [0 0 0]";
        if (m_.kind == MaterialKind::Uber) {
          Add("Kr", m_.mirror, glossy / 2);
          parameters_ += OpacityText(m_.opacity, next_, &text_);
        }
        Choose("roughness", kRough);
        if (m_.isPhysical) parameters_ += " \"string fresnel\" \"physical\"";
        break;
      case MaterialKind::Substrate:
        Add("Kd", m_.diffuse, diffuse);
        Add("Ks", m_.glossy, glossy);
        Choose("uroughness", kRough);
        parameters_ += " \"float vroughness\" .2";
        break;
      case MaterialKind::ShinyMetal:
        Add("Ks", m_.glossy, .5);
        Add("Kr", m_.mirror, .5);
        Choose("roughness", kRough);
        break;
      default:
        break;
    }
  }

  const MaterialModel& m_;
  int* next_;
  std::string text_, parameters_;
};

}  // namespace

std::string MaterialText(const MaterialModel& m, bool hasBumps, int* next) {
  return MaterialWriter(m, next).Text(hasBumps);
}

}  // namespace exphoton::random_scenes
