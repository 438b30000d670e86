// SPDX-License-Identifier: BSD-2-Clause
// These tests check the file of a stopped render: what is written is read again, and no damaged
// file is taken for a whole one.
#include "core/files/state_file.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>

#include "core/base/error.h"
#include "core/imaging/film/film.h"
#include "core/render/state/checkpoints.h"
#include "tests/support/process.h"

namespace exphoton {
namespace {

class StateFileTest : public testing::Test {
 protected:
  std::string Path() const { return folder_.File("a.state"); }
  // Writes two sections and returns the bytes of the file.
  std::string WriteSome() const {
    StateWriter writer(Path());
    writer.Add("numbers", std::string("\1\2\3\0\5\6\7\10\11", 9));
    writer.Add("empty", "");
    writer.Commit();
    return ReadFile(Path());
  }
  // Returns the reason why bytes cannot be read, or "".
  std::string Reason(const std::string& bytes) const {
    WriteFile(Path(), bytes);
    try {
      const StateFile file(Path());
    } catch (const Error& error) {
      EXPECT_EQ(error.Status(), ExitStatus::File);
      return error.what();
    }
    return "";
  }
  static bool Has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  const TestFolder folder_;
};

TEST_F(StateFileTest, GivesBackItsSections) {
  WriteSome();
  const StateFile file(Path());
  EXPECT_EQ(file.Get("numbers"), std::string("\1\2\3\0\5\6\7\10\11", 9));
  EXPECT_EQ(file.Get("empty"), "");
  EXPECT_TRUE(file.Has("empty"));
  EXPECT_FALSE(file.Has("missing"));
  EXPECT_THROW(file.Get("missing"), Error);
  EXPECT_TRUE(IsStateFile(Path()));
}

TEST_F(StateFileTest, MapsAlignedSections) {
  const std::string first(1000, 'a'), second(3 * 4096 + 1, 'b');
  {
    StateWriter writer(Path());
    writer.Add("odd", "x");
    writer.AddAligned("first", std::as_bytes(std::span(first)));
    writer.AddAligned("none", {});
    writer.AddAligned("second", std::as_bytes(std::span(second)));
    writer.Commit();
  }
  MappedBytes mapped;
  {
    const StateFile file(Path());
    EXPECT_EQ(file.Get("first"), first);
    EXPECT_TRUE(file.Map("none").bytes.empty());
    EXPECT_THROW(file.Map("missing"), Error);
    for (const char* name : {"first", "second"}) {
      mapped = file.Map(name);
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(mapped.bytes.data()) % StateWriter::kAlignment,
                0u);
    }
  }
  // The bytes stay when the file is closed, and when another takes its place.
  std::filesystem::rename(Path(), Path() + ".old");
  WriteFile(Path(), "");
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(mapped.bytes.data()), mapped.bytes.size()),
            second);
}

TEST_F(StateFileTest, NoTruncatedFileIsRead) {
  const std::string whole = WriteSome();
  ASSERT_EQ(Reason(whole), "");
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_TRUE(Has(Reason(whole.substr(0, size)), "cut off"))
        << size << Reason(whole.substr(0, size));
  EXPECT_NE(Reason(whole + "x"), "");
}

TEST_F(StateFileTest, NoFileWithAFlippedBitIsRead) {
  const std::string whole = WriteSome();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = whole;
      damaged[at] = char(damaged[at] ^ (1 << bit));
      EXPECT_NE(Reason(damaged), "") << "byte " << at << ", bit " << bit;
    }
  }
}

TEST_F(StateFileTest, NamesOtherFilesAndVersions) {
  std::string bytes = WriteSome();
  EXPECT_TRUE(Has(Reason("some other file, of another program"), "not the state of"));
  EXPECT_FALSE(IsStateFile(Path()));
  bytes[16] = 13;
  EXPECT_TRUE(Has(Reason(bytes), "version 13, and this program reads version 12"));
  EXPECT_TRUE(Has(Reason(bytes.substr(0, 17)), "cut off"));
  try {
    const StateFile file(folder_.File("none.state"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(Has(error.what(), "no such file")) << error.what();
  }
}

TEST_F(StateFileTest, AnOlderFileStaysUntilTheNewOneIsComplete) {
  const std::string whole = WriteSome();
  {
    StateWriter writer(Path());
    writer.Add("more", "bytes");
  }
  EXPECT_EQ(ReadFile(Path()), whole);
  EXPECT_EQ(folder_.Names(), std::vector<std::string>{"a.state"});
}

// A film whose pixels have different sums.
Film SomeFilm(PixelBounds crop) {
  Film film({0, 0, 8, 8}, crop);
  for (int y = crop.y0; y < crop.y1; ++y)
    for (int x = crop.x0; x < crop.x1; ++x)
      for (int i = 0; i <= x; ++i)
        film.AddSample({x, y}, Spectrum(Real(.1), Real(x), Real(y)), Real(.7), Real(.3));
  return film;
}

std::string SavedFilm(Film film) {
  ByteArchive archive;
  film.Transfer(&archive);
  return archive.Take();
}

TEST_F(StateFileTest, AFilmComesBackBitByBit) {
  const Film film = SomeFilm({1, 2, 5, 8});
  const std::string bytes = SavedFilm(film);
  Film other({0, 0, 8, 8}, {1, 2, 5, 8});
  ByteArchive archive(bytes);
  other.Transfer(&archive);
  EXPECT_NO_THROW(archive.CheckEnd());
  EXPECT_EQ(other.ToImage(true).pixels, film.ToImage(true).pixels);
  EXPECT_EQ(SavedFilm(other), bytes);
}

TEST_F(StateFileTest, SectionsOfOtherRendersDoNotFit) {
  const std::string bytes = SavedFilm(SomeFilm({0, 0, 8, 8}));
  StateWriter writer(Path());
  writer.Add("film", bytes);
  writer.Add("short", bytes.substr(0, bytes.size() - 1));
  writer.Add("long", bytes + "x");
  writer.Commit();
  const StateFile file(Path());
  Film same({0, 0, 8, 8}, {0, 0, 8, 8}), other({0, 0, 8, 8}, {0, 0, 8, 7});
  EXPECT_NO_THROW(LoadSection("film", &same, file));
  EXPECT_THROW(LoadSection("film", &other, file), Error);
  EXPECT_THROW(LoadSection("short", &same, file), Error);
  EXPECT_THROW(LoadSection("long", &same, file), Error);
}

TEST(ByteArchive, ReservesNoMemoryForAWrongCount) {
  const std::uint64_t huge = std::uint64_t(1) << 60;
  std::string bytes(8, '\0');
  std::memcpy(bytes.data(), &huge, 8);
  ByteArchive archive(bytes);
  std::vector<double> list;
  EXPECT_THROW(archive.List(&list), ArchiveError);
  EXPECT_TRUE(list.empty());
  std::string text;
  ByteArchive second(bytes);
  EXPECT_THROW(second.Text(&text), ArchiveError);
}

}  // namespace
}  // namespace exphoton
