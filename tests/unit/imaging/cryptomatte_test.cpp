// SPDX-License-Identifier: BSD-2-Clause
// These tests check the hashes and ranks of Cryptomatte layers. tests/cli decodes whole pictures.
#include "core/imaging/film/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "core/imaging/film/id_shares.h"

namespace exphoton {
namespace {

// Values of other implementations.
TEST(Cryptomatte, HashIsMurmurHash3) {
  EXPECT_EQ(MurmurHash3(""), 0u);
  EXPECT_EQ(MurmurHash3("test"), 0xba6bd213u);
  EXPECT_EQ(MurmurHash3("hello"), 0x248bfa47u);
  EXPECT_EQ(MurmurHash3("Hello, world!"), 0xc0363e43u);
  EXPECT_EQ(MurmurHash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Cryptomatte, IdsAreFiniteFloats) {
  for (int i = 0; i < 100000; ++i) {
    const std::uint32_t hash = CryptomatteHash("object_" + std::to_string(i));
    const float id = std::bit_cast<float>(hash);
    EXPECT_TRUE(std::isnormal(id)) << i;
  }
}

TEST(Cryptomatte, SharesAreRanked) {
  IdShares shares(2);
  shares.Add(1, 7, 1);
  shares.Add(1, 0, 2);
  shares.Add(1, 9, 3);
  shares.Add(1, 7, 1);
  shares.Add(1, 5, 2);
  float out[2 * IdShares::kRanks];
  shares.Rank(1, out);
  const float expected[2 * IdShares::kRanks] = {9, 3 / 9.f, 5, 2 / 9.f, 7, 2 / 9.f};
  for (std::size_t i = 0; i < 2 * IdShares::kRanks; ++i) EXPECT_EQ(out[i], expected[i]) << i;
  shares.Rank(0, out);
  for (const float value : out) EXPECT_EQ(value, 0);
}

TEST(Cryptomatte, SharesOfPartsAddUp) {
  IdShares whole(1), first(1), second(1);
  for (int i = 0; i < 20; ++i) {
    whole.Add(0, std::uint32_t(i % 5), 1);
    (i < 9 ? first : second).Add(0, std::uint32_t(i % 5), 1);
  }
  first.Add(second);
  float expected[2 * IdShares::kRanks], out[2 * IdShares::kRanks];
  whole.Rank(0, expected);
  first.Rank(0, out);
  for (std::size_t i = 0; i < 2 * IdShares::kRanks; ++i) EXPECT_EQ(out[i], expected[i]);
  first.ClearPixel(0);
  first.Rank(0, out);
  EXPECT_EQ(out[1], 0);
}

TEST(Cryptomatte, MoreIdsThanRanksKeepTheLargestShares) {
  IdShares shares(1);
  for (std::uint32_t id = 1; id <= 9; ++id) shares.Add(0, id, id);
  float out[2 * IdShares::kRanks];
  shares.Rank(0, out);
  for (std::size_t rank = 0; rank < IdShares::kRanks; ++rank) {
    EXPECT_EQ(out[2 * rank], float(9 - rank));
    EXPECT_EQ(out[2 * rank + 1], float(9 - rank) / 45);
  }
}

TEST(Cryptomatte, NumbersBecomeIdsWithAManifest) {
  Image image(2, 1, {"R", "CryptoObject00.R", "CryptoObject00.G"});
  image.At(0, 0, 1) = 2;
  image.At(0, 0, 2) = .5f;
  FinishCryptomatte(
      "CryptoObject",
      [](std::uint32_t number) { return number == 1 ? std::string("a\"b") : "ball"; }, 2, &image);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(image.At(0, 0, 1)), CryptomatteHash("ball"));
  EXPECT_EQ(image.At(0, 0, 2), .5f);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(image.At(1, 0, 1)), 0u);
  ASSERT_EQ(image.attributes.size(), 4u);
  for (const auto& [name, value] : image.attributes) {
    ASSERT_TRUE(name.starts_with("cryptomatte/")) << name;
    const std::string what = name.substr(20), text = std::get<std::string>(value);
    if (what == "name") EXPECT_EQ(text, "CryptoObject");
    if (what == "hash") EXPECT_EQ(text, "MurmurHash3_32");
    if (what == "conversion") EXPECT_EQ(text, "uint32_to_float32");
    if (what == "manifest") EXPECT_TRUE(text.starts_with("{\"a\\\"b\":\"")) << text;
  }
}

}  // namespace
}  // namespace exphoton
