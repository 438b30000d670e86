// SPDX-License-Identifier: BSD-2-Clause
// StateFile: the whole file is read and its checksum compared before any section is used.
#include "core/render/state/state_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>

#include "core/base/error.h"
#include "core/files/input_file.h"

namespace exphoton {
namespace {

// The line ends show a transfer that changed them.
constexpr std::string_view kSignature = "EXPHOTON STATE\r\n";
constexpr std::string_view kEnd = "checksum";

// The finalizer of SplitMix64 (Steele, Lea and Flood 2014). It is a bijection of the hash.
std::uint64_t Mix(std::uint64_t hash, std::uint64_t word) {
  std::uint64_t x = (hash ^ word) + 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::string SectionHead(std::string_view name, std::uint64_t size) {
  ByteArchive archive;
  std::string text(name);
  archive.Text(&text);
  archive.Values(&size);
  return archive.Take();
}

std::string ReadAll(const std::string& path, std::size_t most) {
  const Descriptor file(OpenRegularFile(path));
  struct stat status;
  if (fstat(file.Get(), &status) != 0) throw InputFileError(std::strerror(errno));
  std::string bytes(std::min(std::size_t(status.st_size), most), '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = read(file.Get(), bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw InputFileError(std::strerror(errno));
    if (count == 0) break;
    done += std::size_t(count);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace

std::uint64_t StateChecksum(std::uint64_t before, std::string_view bytes) {
  std::uint64_t hash = Mix(before, bytes.size());
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data(), 8);
    hash = Mix(hash, word);
  }
  if (bytes.empty()) return hash;
  std::uint64_t word = 0;
  std::memcpy(&word, bytes.data(), bytes.size());
  return Mix(hash, word);
}

StateWriter::StateWriter(const std::string& path) : file_(path) {
  ByteArchive version;
  std::uint32_t number = kStateVersion;
  version.Values(&number);
  const std::string head = std::string(kSignature) + version.Take();
  Write(head.data(), head.size());
}

void StateWriter::Write(const void* data, std::size_t size) {
  checksum_ = StateChecksum(checksum_, {static_cast<const char*>(data), size});
  file_.Write(data, size);
}

void StateWriter::Add(std::string_view name, std::string_view bytes) {
  const std::string head = SectionHead(name, bytes.size());
  Write(head.data(), head.size());
  Write(bytes.data(), bytes.size());
}

void StateWriter::Commit() {
  const std::string head = SectionHead(kEnd, sizeof checksum_);
  Write(head.data(), head.size());
  file_.Write(&checksum_, sizeof checksum_);
  file_.Commit();
}

StateFile::StateFile(const std::string& path) : path_(path) {
  try {
    bytes_ = ReadAll(path, std::numeric_limits<std::size_t>::max());
  } catch (const InputFileError& error) {
    throw Error(ExitStatus::File, "cannot read the state \"" + path + "\": " + error.what());
  }
  std::string_view rest = bytes_;
  const auto take = [&](std::size_t size) {
    if (size > rest.size()) Fail("it is cut off or damaged");
    const std::string_view part = rest.substr(0, size);
    rest.remove_prefix(size);
    return part;
  };
  const auto takeNumber = [&](auto number) {
    std::memcpy(&number, take(sizeof number).data(), sizeof number);
    return number;
  };
  if (!kSignature.starts_with(rest.substr(0, kSignature.size())))
    Fail("it is not the state of a stopped render");
  take(kSignature.size());
  const auto version = takeNumber(std::uint32_t());
  if (version != kStateVersion)
    Fail("it has version " + std::to_string(version) + ", and this program reads version " +
         std::to_string(kStateVersion));
  std::uint64_t checksum = StateChecksum(0, std::string_view(bytes_).substr(0, 20));
  for (;;) {
    const char* const begin = rest.data();
    const std::string name(take(std::size_t(takeNumber(std::uint64_t()))));
    const auto size = std::size_t(takeNumber(std::uint64_t()));
    checksum = StateChecksum(checksum, {begin, std::size_t(rest.data() - begin)});
    const std::string_view bytes = take(size);
    if (name == kEnd) {
      std::uint64_t saved = 0;
      if (bytes.size() == sizeof saved) std::memcpy(&saved, bytes.data(), sizeof saved);
      if (saved != checksum || !rest.empty()) Fail("it is damaged: its checksum does not match");
      return;
    }
    checksum = StateChecksum(checksum, bytes);
    sections_[name] = bytes;
  }
}

void StateFile::Fail(const std::string& why) const {
  throw Error(ExitStatus::File, "cannot continue from \"" + path_ + "\": " + why, {},
              "without --resume the render starts from the beginning");
}

std::string_view StateFile::Get(const std::string& name) const {
  const auto section = sections_.find(name);
  if (section == sections_.end()) Fail("its section \"" + name + "\" is missing");
  return section->second;
}

bool IsStateFile(const std::string& path) {
  try {
    return ReadAll(path, kSignature.size()) == kSignature;
  } catch (const InputFileError&) {
    return false;
  }
}

}  // namespace exphoton
