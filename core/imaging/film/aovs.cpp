// SPDX-License-Identifier: BSD-2-Clause
// Names, channels and descriptions of the AOVs.
#include "core/imaging/film/aovs.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace exphoton {
namespace {

std::vector<std::string> Colors(const std::string& name) {
  return {name + ".R", name + ".G", name + ".B"};
}
std::vector<std::string> Axes(const std::string& name) {
  return {name + ".X", name + ".Y", name + ".Z"};
}

// Cryptomatte stores two pairs of an id and a share in each layer of four channels.
std::vector<std::string> Pairs(const std::string& name) {
  std::vector<std::string> channels;
  for (const char* layer : {"00", "01", "02"})
    for (const char* channel : {".R", ".G", ".B", ".A"}) channels.push_back(name + layer + channel);
  return channels;
}

std::string Lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = char(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

// Returns whether `item` names the AOV. "albedo.rgb" matches "albedo", because it lists all its
// channels.
bool Matches(const std::string& item, const AovInfo& info) {
  const std::string name = Lower(info.name);
  if (item == name) return true;
  std::string suffix;
  for (const std::string& channel : info.channels)
    if (channel.size() > name.size()) suffix += Lower(channel.substr(name.size() + 1));
  return !suffix.empty() && item == name + "." + suffix;
}

}  // namespace

const AovInfo& GetAovInfo(Aov aov) {
  static const std::array<AovInfo, kAovCount> infos{{
      {"albedo", Colors("albedo"), "reflectance and transmittance of the first surface"},
      {"N", Axes("N"), "its shading normal, turned to the camera, in world space"},
      {"Ng", Axes("Ng"), "its geometric normal, turned to the camera, in world space"},
      {"P", Axes("P"), "where it was hit, in world space", true},
      {"Z", {"Z"}, "its depth along the view axis, in camera units", true},
      {"uv", {"uv.U", "uv.V"}, "its texture coordinates", true},
      {"objectId", {"objectId.id"}, "number of its shape or instance", true},
      {"materialId", {"materialId.id"}, "number of its material", true},
      {"variance", Colors("variance"), "estimated variance of the pixel"},
      {"emission", Colors("emission"), "light that the first surface emits, and the background"},
      {"direct", Colors("direct"), "direct light that it scatters"},
      {"caustic", Colors("caustic"), "light that it scatters, from lights over specular surfaces"},
      {"indirect", Colors("indirect"), "all other light that it scatters"},
      {"specular", Colors("specular"), "light over its own specular lobes"},
      {"time", {"time.ms"}, "milliseconds that the pixel took, of one thread", true},
      {"samples", {"samples.count"}, "camera samples", true},
      {"photonDensity", {"photonDensity.Y"}, "photons of all maps per unit of area"},
      {"radianceDistance",
       {"radianceDistance.Y"},
       "mean distance from gather hits to the radiance photons they read"},
      {"sharingBias", Colors("sharingBias"),
       "estimated error that shared gathers add, with its sign"},
      {"cryptoObject", Pairs("CryptoObject"), "objects of the pixel and their shares", true},
      {"cryptoMaterial", Pairs("CryptoMaterial"), "materials of the pixel and their shares", true},
  }};
  return infos[std::size_t(aov)];
}

bool IsExactChannel(const std::string& channel) {
  for (int i = 0; i < kAovCount; ++i) {
    const AovInfo& info = GetAovInfo(Aov(i));
    if (info.isExact &&
        std::find(info.channels.begin(), info.channels.end(), channel) != info.channels.end())
      return true;
  }
  return false;
}

std::vector<Aov> AovSet::List() const {
  std::vector<Aov> list;
  for (int i = 0; i < kAovCount; ++i)
    if (Has(Aov(i))) list.push_back(Aov(i));
  return list;
}

std::string AovSet::Names() const {
  std::string names;
  for (const Aov aov : List())
    names += (names.empty() ? "" : ", ") + std::string(GetAovInfo(aov).name);
  return names;
}

std::optional<AovSet> ParseAovs(std::string_view list, std::string* unknown) {
  AovSet set;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t end = std::min(list.find(',', at), list.size());
    const std::string item = Lower(list.substr(at, end - at));
    at = end + 1;
    bool isKnown = item == "light" || item == "cryptomatte";
    if (isKnown) set = set | (item == "light" ? kLightAovs : kCryptomatte);
    for (int i = 0; i < kAovCount && !isKnown; ++i) {
      isKnown = Matches(item, GetAovInfo(Aov(i)));
      if (isKnown) set.Add(Aov(i));
    }
    if (!isKnown) {
      *unknown = item;
      return std::nullopt;
    }
  }
  return set;
}

}  // namespace exphoton
