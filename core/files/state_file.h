// SPDX-License-Identifier: BSD-2-Clause
// StateWriter and StateFile write and read files that keep the work of a render: the state of a
// stopped render, a part of a picture, or photons. Such a file has named sections of bytes between
// a signature and a checksum. docs/development/state-files.md describes the format. The sections
// themselves belong to the classes that they are named after.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/files/atomic_file.h"
#include "core/files/byte_archive.h"

namespace exphoton {

inline constexpr std::uint32_t kStateVersion = 12;

// Writes a file that appears under its name only with Commit. Errors throw Error(File).
class StateWriter {
 public:
  explicit StateWriter(const std::string& path);
  void Add(std::string_view name, std::string_view bytes);
  // Adds a section that can be mapped: its bytes begin at a multiple of kAlignment. A section of
  // zeros may precede it.
  void AddAligned(std::string_view name, std::span<const std::byte> bytes);
  // Adds a section of what `save` puts into an archive. StateFile::Read reads it.
  using Save = std::function<void(ByteArchive*)>;
  void AddArchive(std::string_view name, const Save& save);
  void Commit();

  static constexpr std::size_t kAlignment = 128;

 private:
  void Write(const void* data, std::size_t size);

  AtomicFile file_;
  std::uint64_t checksum_ = 0;
};

// The purpose of reading a state, for messages.
enum class StateUse {
  Resume,   // to continue a stopped render
  Part,     // to merge the part of a picture that one process rendered
  Photons,  // to render with photons that were shot before
};

// MappedBytes are the bytes of a section, mapped into memory. Processes that map the same file
// share its pages. The file must not be changed meanwhile; replacing it by another one is allowed.
struct MappedBytes {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;  // keeps them mapped
};

// Thrown for a file that has been read but is no complete state.
class DamagedState : public Error {
 public:
  using Error::Error;
};

class StateFile {
 public:
  // Reads a whole file and checks it. Only the places of the sections stay in memory. Errors throw
  // Error(File): the text says whether the file cannot be read, is of another kind or version, is
  // cut off or is damaged. The last two are a DamagedState.
  explicit StateFile(const std::string& path, StateUse use = StateUse::Resume);

  const std::string& Path() const { return path_; }
  void Release() { Close(), sections_.clear(); }  // frees the memory
  // Closes the file until a section is read again.
  void Close() const { file_.reset(); }
  bool Has(const std::string& name) const { return sections_.contains(name); }
  std::vector<std::string> Names() const;  // of all sections, sorted
  // Returns the bytes of a section. Throws Error(File) if it is missing or has changed since.
  std::string Get(const std::string& name) const;
  // Maps a section that was written by AddAligned. Throws Error(File).
  MappedBytes Map(const std::string& name) const;
  // Throws Error(File) because the content of the file does not fit.
  [[noreturn]] void FailAsDamaged(const std::string& why) const { Fail(why, true); }
  // Returns a checksum of a section's name and bytes.
  std::uint64_t Digest(const std::string& name) const;
  // Loads a section. A section that does not fit throws Error(File).
  template <class Load>
  void Read(const std::string& name, const Load& load) const;

 private:
  struct Section {
    std::uint64_t offset = 0, size = 0;
    std::uint64_t digest = 0;  // the checksum of the bytes alone
  };
  class Scanner;
  [[noreturn]] void Fail(const std::string& why, bool isDamaged = false) const;

  std::string path_;
  StateUse use_;
  mutable std::unique_ptr<Descriptor> file_;  // null: closed
  std::map<std::string, Section> sections_;
};

// Returns whether the file begins with the signature of a state.
bool IsStateFile(const std::string& path);
// Returns whether the file is a state or may have been one: it is empty, cut off within the
// signature, or one byte of the signature is another one.
bool MayBeStateFile(const std::string& path);

// The checksum of some bytes that follow bytes with the checksum `before`. A change of any single
// byte changes it.
std::uint64_t StateChecksum(std::uint64_t before, std::string_view bytes);

template <class Load>
void StateFile::Read(const std::string& name, const Load& load) const {
  const std::string bytes = Get(name);
  try {
    ByteArchive archive(bytes);
    load(&archive);
    archive.CheckEnd();
  } catch (const ArchiveError& error) {
    Fail("its section \"" + name + "\" does not fit this render: " + error.what());
  }
}

}  // namespace exphoton
