// SPDX-License-Identifier: BSD-2-Clause
// These tests read scene files from disk: folders, devices, pipes, links and compressed files. They
// also check that the parser either parses a sequence of bytes or reports an error.
#include "core/parser/syntax/source.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

class FileSourceTest : public testing::Test {
 protected:
  FileSourceTest() {
    std::string name = testing::TempDir() + "exphoton-XXXXXX";
    folder_ = mkdtemp(name.data());
  }
  ~FileSourceTest() override { std::filesystem::remove_all(folder_); }

  std::string Path(const std::string& name) const { return folder_ + "/" + name; }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(Path(name), std::ios::binary) << text;
  }
  // Returns the error without the folder's name, or the number of directives if there is no error.
  std::string Parse(const std::string& name) const {
    Log log(Log::Level::Normal, Log::Sink::Memory);
    FileSource source;
    DirectiveList list;
    try {
      ParseScene(source, Path(name), list, log);
    } catch (const Error& error) {
      std::string text = std::to_string(int(error.Status())) + ": " + error.what();
      for (std::size_t at; (at = text.find(folder_ + "/")) != std::string::npos;)
        text.erase(at, folder_.size() + 1);
      return text;
    }
    return std::to_string(list.directives.size());
  }

 private:
  std::string folder_;
};

TEST_F(FileSourceTest, IncludesRelativeToTheIncludingFile) {
  std::filesystem::create_directory(Path("sub"));
  Write("a.pbrt", "Include \"sub/b.pbrt\" Identity");
  Write("sub/b.pbrt", "Include \"c.pbrt\" Include \"" + Path("d.pbrt") + "\"");
  Write("sub/c.pbrt", "Identity");
  Write("d.pbrt", "Identity Identity");
  EXPECT_EQ(Parse("a.pbrt"), "4");
}

TEST_F(FileSourceTest, ReadsCompressedFiles) {
  const std::string text = "Identity Include \"b.pbrt.gz\"";
  for (const auto& [name, content] :
       {std::pair<std::string, std::string>{"a.pbrt", text}, {"b.pbrt.gz", "Translate 1 2 3"}}) {
    gzFile file = gzopen(Path(name).c_str(), "wb");
    gzwrite(file, content.data(), unsigned(content.size()));
    gzclose(file);
  }
  EXPECT_EQ(Parse("a.pbrt"), "2");
  std::filesystem::resize_file(Path("b.pbrt.gz"), 12);
  EXPECT_EQ(Parse("a.pbrt"),
            "2: cannot read the included file \"b.pbrt.gz\": ends in the middle of its gzip data");
}

TEST_F(FileSourceTest, DoesNotHangOnWhatIsNoFile) {
  mkfifo(Path("pipe").c_str(), 0600);
  std::filesystem::create_directory(Path("folder"));
  Write("pipe.pbrt", "Include \"pipe\"");
  Write("zero.pbrt", "Include \"/dev/zero\"");
  Write("folder.pbrt", "Include \"folder\"");
  EXPECT_EQ(Parse("pipe.pbrt"), "2: cannot read the included file \"pipe\": is not a regular file");
  EXPECT_EQ(Parse("zero.pbrt"),
            "2: cannot read the included file \"/dev/zero\": is not a regular file");
  EXPECT_EQ(Parse("folder.pbrt"), "2: cannot read the included file \"folder\": is a directory");
  EXPECT_EQ(Parse("folder"), "3: cannot read the scene \"folder\": is a directory");
  EXPECT_EQ(Parse("none"), "3: cannot read the scene \"none\": no such file");
}

TEST_F(FileSourceTest, RecognisesACycleThroughALink) {
  Write("a.pbrt", "Include \"b.pbrt\"");
  ASSERT_EQ(symlink("a.pbrt", Path("b.pbrt").c_str()), 0);
  EXPECT_EQ(Parse("a.pbrt"), "2: the file includes itself: a.pbrt -> b.pbrt");
}

// The test is not a fuzzer, but tries the inputs that a fuzzer would find first: pieces of the
// language in any order, and flipped bytes.
TEST(Parser, SurvivesAnySequenceOfBytes) {
  const std::vector<std::string> pieces{"Shape",
                                        "\"sphere\"",
                                        "\"float radius\"",
                                        "[",
                                        "]",
                                        "1",
                                        "-1e3",
                                        "1e999",
                                        "\"",
                                        "\\",
                                        "#",
                                        "\n",
                                        "WorldBegin",
                                        "Include",
                                        "\"scene.pbrt\"",
                                        "LookAt",
                                        "Translate 1 2 3",
                                        "\"color Kd\" [1 2 3]",
                                        "Texture",
                                        "\"true\"",
                                        "\xef\xbb\xbf",
                                        "\x1f\x8b",
                                        ".",
                                        "+"};
  std::mt19937 random(1);
  int parsed = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (auto k = random() % 12; k > 0; --k) text += pieces[random() % pieces.size()] + " ";
    if (!text.empty() && random() % 4 == 0) text[random() % text.size()] = char(random() % 256);
    const std::string error = ParseErrorOf(text);
    parsed += error.empty();
    const bool isPlaced = error.starts_with("scene.pbrt:") || IsGzip(text);
    EXPECT_TRUE(error.empty() || isPlaced) << error;
  }
  EXPECT_GT(parsed, 100);
}

}  // namespace
}  // namespace exphoton
