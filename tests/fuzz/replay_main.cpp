// SPDX-License-Identifier: BSD-2-Clause
// This program runs a fuzz target without a fuzzer, over every given file, every file in the given
// folders and every seed in files NAME.seeds.
#include "tests/fuzz/input.h"
#include "tests/fuzz/seeds.h"

namespace {

namespace fs = std::filesystem;
using exphoton::fuzz::ReadBytes;

void Run(const std::string& name, const std::string& bytes) {
  std::printf("%s\n", name.c_str());
  std::fflush(stdout);
  // A copy of the exact size, so that a sanitizer notices what is read beyond the end.
  const std::vector<std::uint8_t> data(bytes.begin(), bytes.end());
  LLVMFuzzerTestOneInput(data.data(), data.size());
}

int Replay(const fs::path& path) {
  if (path.extension() != ".seeds") {
    Run(path.string(), ReadBytes(path));
    return 1;
  }
  int count = 0;
  for (const std::string& seed : exphoton::fuzz::UnpackSeeds(ReadBytes(path)))
    Run(path.string() + " " + std::to_string(++count), seed);
  if (count == 0) throw std::runtime_error(path.string() + " has no seeds");
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  int count = 0;
  for (int i = 1; i < argc; ++i) {
    if (!fs::is_directory(argv[i])) {
      count += Replay(argv[i]);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(argv[i]))
      if (entry.is_regular_file()) count += Replay(entry.path());
  }
  std::printf("%d inputs\n", count);
  return count > 0 ? 0 : 1;
}
