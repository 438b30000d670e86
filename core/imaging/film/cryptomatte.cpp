// SPDX-License-Identifier: BSD-2-Clause
// FinishCryptomatte lists all names of the scene in the manifest, also those that no pixel shows.
#include "core/imaging/film/cryptomatte.h"

#include <bit>
#include <cstring>

#include "core/base/format.h"

namespace exphoton {
namespace {

std::uint32_t ScrambleBlock(std::uint32_t block) {
  return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

std::string HexText(std::uint32_t number) { return Format("%08x", unsigned(number)); }

std::string JsonQuoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) {
      quoted += Format("\\u%04x", unsigned(c));
      continue;
    }
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::uint32_t MurmurHash3(std::string_view text) {
  std::uint32_t hash = 0;
  const std::size_t whole = text.size() / 4 * 4;
  for (std::size_t at = 0; at < whole; at += 4) {
    std::uint32_t block;
    static_assert(std::endian::native == std::endian::little);
    std::memcpy(&block, text.data() + at, 4);
    hash = std::rotl(hash ^ ScrambleBlock(block), 13) * 5 + 0xe6546b64u;
  }
  std::uint32_t rest = 0;
  for (std::size_t at = text.size(); at-- > whole;)
    rest = rest << 8 | static_cast<unsigned char>(text[at]);
  if (whole < text.size()) hash ^= ScrambleBlock(rest);
  hash ^= std::uint32_t(text.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

std::uint32_t CryptomatteHash(std::string_view name) {
  const std::uint32_t hash = MurmurHash3(name), exponent = hash >> 23 & 255;
  return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

void FinishCryptomatte(const std::string& layer,
                       const std::function<std::string(std::uint32_t number)>& nameOf,
                       std::uint32_t count, Image* image) {
  std::vector<std::uint32_t> hashes{0};
  std::string manifest;
  std::vector<int> channels;
  for (int c = 0; c < image->ChannelCount(); ++c) {
    const std::string& name = image->channels[std::size_t(c)];
    // R and B hold ids, G and A hold shares.
    if (name.starts_with(layer) && (name.ends_with(".R") || name.ends_with(".B")))
      channels.push_back(c);
  }
  if (channels.empty()) return;
  for (std::uint32_t number = 1; number <= count; ++number) {
    const std::string name = nameOf(number);
    hashes.push_back(CryptomatteHash(name));
    manifest +=
        (manifest.empty() ? "" : ",") + JsonQuoted(name) + ":\"" + HexText(hashes.back()) + '"';
  }
  for (int y = 0; y < image->Height(); ++y)
    for (int x = 0; x < image->Width(); ++x)
      for (const int channel : channels) {
        float& value = image->At(x, y, channel);
        const auto number = std::size_t(value);
        value = std::bit_cast<float>(number < hashes.size() ? hashes[number] : 0);
      }
  const std::string key = "cryptomatte/" + HexText(MurmurHash3(layer)).substr(0, 7) + "/";
  image->attributes[key + "name"] = layer;
  image->attributes[key + "hash"] = std::string("MurmurHash3_32");
  image->attributes[key + "conversion"] = std::string("uint32_to_float32");
  image->attributes[key + "manifest"] = "{" + manifest + "}";
}

}  // namespace exphoton
