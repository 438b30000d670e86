// SPDX-License-Identifier: BSD-2-Clause
// bad_inputs renders randomly damaged inputs: scene files, parameters, graphs of textures and
// includes, images and PLY files. Each runs in a separate process, which must end within a minute
// with a documented status and without a signal. A process that fails must print a message and
// leave no picture. Usage: bad_inputs [--cases N] [--first N] [--seconds S]. Cases have fixed
// seeds.
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "tests/random/scenes/scene_generator.h"
#include "tests/random/scenes/scene_text.h"
#include "tests/support/process.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

class Luck {
 public:
  explicit Luck(unsigned seed) : engine_(seed) {}
  std::size_t Below(std::size_t n) { return n == 0 ? 0 : engine_() % n; }
  bool OneIn(std::size_t n) { return Below(n) == 0; }
  const std::string& Of(const Names& names) { return names[Below(names.size())]; }

 private:
  std::mt19937 engine_;
};

const Names kStrangeWords{"0",
                          "-1",
                          "1e38",
                          "-1e38",
                          "1e-45",
                          "nan",
                          "inf",
                          "[",
                          "]",
                          "\"",
                          "\"\"",
                          "#",
                          "\r",
                          "1e400",
                          "[ ]",
                          "[0 0 0]",
                          "[1e38]",
                          "2147483648",
                          "\"texture Kd\" \"t1\"",
                          ".",
                          "\\",
                          "WorldEnd",
                          "WorldBegin",
                          "AttributeEnd",
                          "AttributeBegin",
                          "ObjectEnd",
                          "Include \"scene.pbrt\"",
                          "\"spectrum L\" [400 1 300 2]",
                          "\"blackbody L\" [-5 1]",
                          "Scale 0 0 0",
                          "Transform [0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0]",
                          "Rotate 1e30 0 0 0"};

Names WordsOf(const std::string& text) {
  Names words(1);
  for (const char c : text) {
    const bool isSpace = c == ' ' || c == '\n';
    if (isSpace) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

// Drops, doubles, exchanges or replaces words of the world. The text before WorldBegin stays, so
// pictures stay small.
std::string DamagedScene(Luck* luck) {
  const std::string text =
      random_scenes::SceneText(random_scenes::SceneOfSeed(luck->Below(100000)).value(),
                               {.photons = 50, .maxPhotonPaths = 500});
  const std::size_t begin = text.find("WorldBegin");
  Names words = WordsOf(text.substr(begin));
  for (std::size_t i = 1 + luck->Below(4); i > 0; --i) {
    const std::size_t at = luck->Below(words.size());
    switch (luck->Below(5)) {
      case 0:
        words.erase(words.begin() + std::ptrdiff_t(at));
        break;
      case 1:
        words.insert(words.begin() + std::ptrdiff_t(at), std::string(words[at]));
        break;
      case 2:
        std::swap(words[at], words[luck->Below(words.size())]);
        break;
      case 3:
        words[at] = luck->Of(kStrangeWords);
        break;
      default:
        words[at] += char(luck->Below(256));
    }
    if (words.empty()) words.emplace_back();
  }
  std::string damaged = text.substr(0, begin);
  for (const std::string& word : words) damaged += word + (luck->OneIn(8) ? "\n" : " ");
  return damaged;
}

const std::string kSmall =
    "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 6\n"
    "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 1\nCamera \"perspective\"\nWorldBegin\n"
    "LightSource \"point\"\nTranslate 0 0 3\n";

// Each texture reads earlier textures, itself, or a missing one.
std::string TextureGraph(Luck* luck) {
  const std::size_t count = 1 + luck->Below(400);
  const bool isChain = luck->OneIn(2);
  std::string text = kSmall;
  const auto name = [&](std::size_t i) { return "\"t" + std::to_string(i) + "\""; };
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1;
    const std::size_t other = isChain ? before : luck->Below(i + luck->Below(3));
    text += "Texture " + name(i) + (luck->OneIn(200) ? " \"float\" " : " \"color\" ") +
            luck->Of({"\"mix\"", "\"scale\"", "\"checkerboard\""});
    if (i > 0) text += " \"texture tex1\" " + name(before) + " \"texture tex2\" " + name(other);
    text += "\n";
  }
  return text + "Material \"matte\" \"texture Kd\" " + name(count - 1) +
         "\nShape \"sphere\"\nWorldEnd\n";
}

// The files include other files twice, themselves, a folder, a pipe, or a missing file.
std::string IncludeGraph(Luck* luck, const TestFolder& folder) {
  const std::size_t count = 1 + luck->Below(35), times = 1 + luck->Below(2);
  for (std::size_t i = 0; i < count; ++i) {
    std::string text = luck->OneIn(4) ? "# one\r# two\r" : "Translate 0 0 .01\n";
    for (std::size_t k = 0; k < times; ++k) {
      std::string next = i + 1 < count ? "f" + std::to_string(i + 1) : "end";
      if (luck->OneIn(60)) next = luck->Of({"scene.pbrt", ".", "pipe", "none", "f0", "/dev/zero"});
      text += "Include \"" + next + "\"\n";
    }
    WriteFile(folder.File("f" + std::to_string(i)), text);
  }
  WriteFile(folder.File("end"), "Shape \"sphere\"\n");
  mkfifo(folder.File("pipe").c_str(), 0600);
  return kSmall + "Include \"f0\"\nWorldEnd\n";
}

std::string Damaged(std::string bytes, Luck* luck) {
  for (std::size_t i = luck->Below(6); i > 0 && !bytes.empty(); --i) {
    const std::size_t at = luck->OneIn(2) ? luck->Below(bytes.size())
                                          : luck->Below(std::min<std::size_t>(bytes.size(), 400));
    if (luck->OneIn(4))
      bytes.insert(at, std::size_t(1 + luck->Below(9)), char(luck->Below(256)));
    else
      bytes[at] = char(luck->Below(256));
  }
  if (luck->OneIn(4)) bytes.resize(luck->Below(bytes.size() + 1));
  return bytes;
}

std::string BadImage(Luck* luck, const TestFolder& folder) {
  const std::string source = EXPHOTON_SOURCE_DIR;
  const std::string good =
      luck->Of({"/scenes/parts/tile_height.png", "/tests/fuzz/seeds/exr/small.exr",
                "/tests/unit/imaging/files/progressive.jpg"});
  const std::string name = "map" + good.substr(good.rfind('.'));
  WriteFile(folder.File(name), Damaged(ReadFile(source + good), luck));
  if (luck->OneIn(2))
    return kSmall + "LightSource \"infinite\" \"string mapname\" \"" + name +
           "\"\nShape \"sphere\"\nWorldEnd\n";
  return kSmall + "Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"" + name +
         "\"\nMaterial \"matte\" \"texture Kd\" \"t\"\nShape \"sphere\"\nWorldEnd\n";
}

std::string BadObj(Luck* luck, const TestFolder& folder) {
  const std::string source = EXPHOTON_SOURCE_DIR;
  const std::string more = luck->Of({"", "f 1 2 99999999\n", "f -99 1 2\n", "v 1e99 nan 0\n",
                                     "t x 2000000000/2000000000/2000000000\n"});
  WriteFile(folder.File("mesh.obj"),
            Damaged(ReadFile(source + "/tests/recorded/mesh.obj") + more, luck));
  return kSmall + "Shape \"obj\" \"string filename\" \"mesh.obj\"\nWorldEnd\n";
}

std::string BadPly(Luck* luck, const TestFolder& folder) {
  if (luck->OneIn(3)) return BadObj(luck, folder);
  const std::string format =
      luck->Of({"ascii", "binary_little_endian", "binary_big_endian", "odd"});
  const std::string count = luck->Of({"4", "4", "4", "0", "-1", "1000000000", "99999999999", "x"});
  std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + count +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     luck->Of({"2", "2", "0", "4000000000"}) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  if (format == "ascii") {
    text += "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n" +
            luck->Of({"3 0 2 3", "4 0 1 2 3", "3 0 2 9", "3 0 2 -1", "200 0 1", "2 0 1"}) + "\n";
  } else {
    for (int i = 0; i < 80; ++i) text += char(luck->Below(256));
  }
  WriteFile(folder.File("mesh.ply"), Damaged(text, luck));
  return kSmall + "Shape \"plymesh\" \"string filename\" \"mesh.ply\"\nWorldEnd\n";
}

// Returns a description of the fault, or "" if there is none.
std::string Judge(const ProcessResult& result, const TestFolder& folder) {
  if (result.isLate) return "it did not end";
  if (result.status < 0 || result.status > 4)
    return "the status is " + std::to_string(result.status);
  if (result.status == 0) return "";
  if (result.err.empty()) return "it failed without a word";
  const bool hasPicture = std::filesystem::exists(folder.File("out.exr"));
  return hasPicture ? "it failed and left a picture" : "";
}

bool RunBadInput(unsigned seed, std::array<int, 5>* statuses) {
  Luck luck(seed);
  const TestFolder folder;
  std::string scene;
  switch (luck.Below(6)) {
    case 0:
      scene = TextureGraph(&luck);
      break;
    case 1:
      scene = IncludeGraph(&luck, folder);
      break;
    case 2:
      scene = BadImage(&luck, folder);
      break;
    case 3:
      scene = BadPly(&luck, folder);
      break;
    default:
      scene = DamagedScene(&luck);
  }
  WriteFile(folder.File("scene.pbrt"), scene);
  const ProcessResult result =
      RunProcess({.words = {EXPHOTON_BINARY_DIR "/bin/exphoton", "render", "scene.pbrt", "-o",
                            "out.exr", "--quiet", "--no-progress", "--nthreads", "1"},
                  .folder = folder.Path()});
  const std::string fault = Judge(result, folder);
  if (fault.empty()) {
    ++(*statuses)[std::size_t(result.status)];
    return true;
  }
  std::printf("case %u: %s\n%.300s\n%.3000s\n", seed, fault.c_str(), result.err.c_str(),
              scene.c_str());
  std::fflush(stdout);
  return false;
}

}  // namespace
}  // namespace exphoton

int main(int argc, char** argv) {
  if (access("/dev/shm", W_OK) == 0) setenv("TMPDIR", "/dev/shm", 0);
  unsigned cases = 200, first = 0;
  double seconds = 0;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (!std::strcmp(argv[i], "--cases")) cases = unsigned(std::atoi(argv[i + 1]));
    if (!std::strcmp(argv[i], "--first")) first = unsigned(std::atoi(argv[i + 1]));
    if (!std::strcmp(argv[i], "--seconds")) seconds = std::atof(argv[i + 1]);
  }
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  std::array<int, 5> statuses{};
  unsigned done = 0, failed = 0;
  for (; seconds > 0 ? elapsed() < seconds : done < cases; ++done)
    failed += !exphoton::RunBadInput(first + done, &statuses);
  std::printf("%u bad inputs in %.0f s: status 0: %d, 1: %d, 2: %d, 3: %d, 4: %d; faults: %u\n",
              done, elapsed(), statuses[0], statuses[1], statuses[2], statuses[3], statuses[4],
              failed);
  // The test needs both accepted and refused inputs, more than 5 % of each.
  return failed == 0 && statuses[0] * 20 > int(done) && statuses[2] * 20 > int(done) ? 0 : 1;
}
