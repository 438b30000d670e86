// SPDX-License-Identifier: BSD-2-Clause
// seed_pack pack FOLDER FILE.seeds writes the files of a folder, the shortest first, into one file.
// seed_pack unpack FILE.seeds FOLDER writes each seed into a file of its own, as libFuzzer reads
// them.
#include <algorithm>
#include <cstdio>

#include "tests/fuzz/seeds.h"

namespace {

namespace fs = std::filesystem;

void WriteBytes(const fs::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  if (!(file << bytes).flush()) throw std::runtime_error("cannot write " + path.string());
}

void Pack(const fs::path& folder, const fs::path& file) {
  std::vector<std::string> seeds;
  for (const auto& entry : fs::directory_iterator(folder))
    seeds.push_back(exphoton::fuzz::ReadBytes(entry.path()));
  std::sort(seeds.begin(), seeds.end(), [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  });
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  WriteBytes(file, exphoton::fuzz::PackSeeds(seeds));
}

void Unpack(const fs::path& file, const fs::path& folder) {
  fs::create_directories(folder);
  int number = 0;
  for (const std::string& seed : exphoton::fuzz::UnpackSeeds(exphoton::fuzz::ReadBytes(file)))
    WriteBytes(folder / ("seed-" + std::to_string(++number)), seed);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string command = argc == 4 ? argv[1] : "";
    if (command == "pack")
      Pack(argv[2], argv[3]);
    else if (command == "unpack")
      Unpack(argv[2], argv[3]);
    else
      throw std::runtime_error("usage: seed_pack pack FOLDER FILE | unpack FILE FOLDER");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "seed_pack: %s\n", error.what());
    return 1;
  }
}
