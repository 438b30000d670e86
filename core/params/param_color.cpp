// SPDX-License-Identifier: BSD-2-Clause
// ParamReader for colours in all notations, and for textures.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/log.h"
#include "core/files/input_file.h"
#include "core/math/cie.h"
#include "core/params/param_reader.h"
#include "core/params/param_text.h"
#include "core/params/scene_path.h"
#include "core/params/suggestions.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;

constexpr double kHottestKelvin = 1e9;
constexpr std::uintmax_t kMaxSpectrumBytes = 16 << 20;  // bytes

std::string ReadSmallFile(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw std::runtime_error("there is no such file");
  try {
    RequireRegularFile(path);
  } catch (const InputFileError& fault) {
    throw std::runtime_error(std::string("it ") + fault.what());
  }
  if (fs::file_size(path, error) > kMaxSpectrumBytes || error) {
    throw std::runtime_error("it is too large for a spectrum");
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (!stream || (fs::file_size(path, error) > 0 && !(text << stream.rdbuf()))) {
    throw std::runtime_error("it cannot be read");
  }
  return text.str();
}

// Parses numbers between blanks; '#' begins a comment. Lines end with LF, CR LF or CR. Numbers use
// the C locale.
std::vector<double> ParseNumbers(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) text[i] = '\n';
  std::vector<double> numbers;
  std::istringstream lines(text);
  int count = 0;
  for (std::string line; std::getline(lines, line);) {
    ++count;
    std::istringstream words(line.substr(0, line.find('#')));
    words.imbue(std::locale::classic());
    for (double number; words >> number;) numbers.push_back(number);
    if (!words.eof()) {
      throw std::runtime_error("line " + std::to_string(count) +
                               " contains a word that is not a number");
    }
  }
  return numbers;
}

// Returns the error text, or "" if the numbers are valid.
std::string FaultOf(const std::vector<double>& numbers) {
  if (numbers.empty() || numbers.size() % 2 != 0) {
    return "needs pairs of a wavelength and a value, not " + std::to_string(numbers.size()) +
           (numbers.size() == 1 ? " number" : " numbers");
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!std::isfinite(numbers[i])) return "must have finite numbers only";
    if (i % 2 == 0 && !(numbers[i] > 0)) return "must have wavelengths above 0 nm";
  }
  return "";
}

Spectrum ColorOfPairs(const std::vector<double>& numbers) {
  std::vector<SpectralSample> samples;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
    samples.push_back({numbers[i], numbers[i + 1]});
  }
  std::stable_sort(
      samples.begin(), samples.end(),
      [](const SpectralSample& a, const SpectralSample& b) { return a.wavelength < b.wavelength; });
  return RgbFromSamples(samples);
}

}  // namespace

Spectrum ParamReader::ColorFromFile() const {
  NeedCount(1);
  const std::string path = ResolveScenePath(param_.strings[0], param_.where);
  std::string fault;
  std::vector<double> numbers;
  try {
    numbers = ParseNumbers(ReadSmallFile(path));
    fault = FaultOf(numbers);
  } catch (const std::runtime_error& error) {
    fault = error.what();
  }
  if (!fault.empty()) {
    Fail("cannot use the spectrum file \"" + path + "\": " + fault, Place(0),
         fs::exists(path) ? "" : TriedPaths());
  }
  return KeepInGamut(ColorOfPairs(numbers), numbers);
}

Spectrum ParamReader::ColorFromPairs() const {
  const std::string fault = FaultOf(param_.numbers);
  if (!fault.empty()) Fail(fault, Place(0));
  return KeepInGamut(ColorOfPairs(param_.numbers), param_.numbers);
}

// Sets negative components to 0 if all input numbers in `from` are non-negative. Such a colour is
// outside the RGB gamut, for example a blackbody below about 1900 K.
Spectrum ParamReader::KeepInGamut(Spectrum color, const std::vector<double>& from) const {
  const bool isPhysical =
      std::all_of(from.begin(), from.end(), [](double number) { return number >= 0; });
  if (!isPhysical || !(color.MinComponent() < 0)) return color;
  if (context_.log) {
    context_.log->Notice(Subject() + " is a color outside of RGB: its negative part counts as 0",
                         param_.where);
  }
  return {std::max(color.r, Real(0)), std::max(color.g, Real(0)), std::max(color.b, Real(0))};
}

Spectrum ParamReader::ColorOfBlackbody() const {
  NeedCount(2);
  const double kelvin = param_.numbers[0], scale = param_.numbers[1];
  if (!(kelvin > 0 && kelvin <= kHottestKelvin)) {
    Fail("must have a temperature above 0 K and at most " + NumberText(kHottestKelvin) +
             " K, not " + NumberText(kelvin),
         Place(0));
  }
  if (!(scale >= 0) || !std::isfinite(scale)) {
    Fail("must have a finite scale of at least 0, not " + NumberText(scale), Place(1));
  }
  return KeepInGamut(RgbOfBlackbody(kelvin), {}) * Real(scale);
}

Spectrum ParamReader::ReadColor() const {
  if (param_.type == "color" || param_.type == "rgb") {
    NeedCount(3);
    return {NeedReal(0), NeedReal(1), NeedReal(2)};
  }
  Spectrum color;
  if (param_.type == "xyz") {
    NeedCount(3);
    for (std::size_t i = 0; i < 3; ++i) {
      if (std::isfinite(param_.numbers[i])) continue;
      Fail("must be finite numbers, not " + NumberText(param_.numbers[i]), Place(i));
    }
    color = KeepInGamut(RgbFromXyz(param_.numbers[0], param_.numbers[1], param_.numbers[2]),
                        param_.numbers);
  } else if (param_.type == "blackbody") {
    color = ColorOfBlackbody();
  } else {
    color = param_.strings.empty() ? ColorFromPairs() : ColorFromFile();
  }
  if (!color.IsFinite()) Fail("is too large", Place(0));
  for (int i = 0; i < 3; ++i) NeedRange(double(color[i]), 0);
  return color;
}

const TextureLookup* ParamReader::Textures() const {
  const bool isOverride = context_.overrides && context_.overrides->Find(param_.name) == &param_;
  return isOverride ? context_.overrideTextures : context_.textures;
}

template <class T>
std::any ParamReader::ReadTexture() const {
  constexpr bool isColor = std::is_same_v<T, Spectrum>;
  if (param_.type != "texture") {
    T value;
    if constexpr (isColor) {
      value = ReadColor();
    } else {
      NeedCount(1);
      value = NeedReal(0);
    }
    return TexturePtr<T>(std::make_shared<UniformTexture<T>>(value));
  }
  NeedCount(1);
  const std::string& name = param_.strings[0];
  if (!Textures()) Fail("cannot be a texture here", param_.where);
  const TextureLookup& textures = *Textures();
  TexturePtr<T> texture;
  if constexpr (isColor) {
    texture = textures.Color(name);
  } else {
    texture = textures.Float(name);
  }
  if (texture) return texture;
  // Looks up the other kind for the error message only, because a lookup counts as a use.
  if (isColor ? textures.Float(name) != nullptr : textures.Color(name) != nullptr) {
    Fail(std::string("needs a ") + (isColor ? "color" : "float") + " texture, and \"" + name +
             "\" is a " + (isColor ? "float" : "color") + " texture",
         Place(0));
  }
  Fail("names a texture that is not defined: \"" + name + '"', Place(0),
       DidYouMean(name, textures.Names()));
}

template std::any ParamReader::ReadTexture<Real>() const;
template std::any ParamReader::ReadTexture<Spectrum>() const;

}  // namespace exphoton
