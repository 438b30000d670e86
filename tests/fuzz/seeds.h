// SPDX-License-Identifier: BSD-2-Clause
// A file NAME.seeds holds the inputs of a fuzz target, one after the other: the number of bytes in
// decimal digits, a line break, the bytes and a line break.
#pragma once

#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace exphoton::fuzz {

inline std::string ReadBytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::string PackSeeds(const std::vector<std::string>& seeds) {
  std::string text;
  for (const std::string& seed : seeds) text += std::to_string(seed.size()) + "\n" + seed + "\n";
  return text;
}

// Throws std::runtime_error if the text is not a sequence of seeds.
inline std::vector<std::string> UnpackSeeds(const std::string& text) {
  std::vector<std::string> seeds;
  const char *at = text.data(), *const end = at + text.size();
  while (at != end) {
    std::size_t size = 0;
    const auto [after, error] = std::from_chars(at, end, size);
    if (error != std::errc() || after == end || *after != '\n' ||
        size >= std::size_t(end - after - 1) || after[size + 1] != '\n')
      throw std::runtime_error("damaged seeds, in number " + std::to_string(seeds.size() + 1));
    seeds.emplace_back(after + 1, size);
    at = after + size + 2;
  }
  return seeds;
}

}  // namespace exphoton::fuzz
