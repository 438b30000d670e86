// SPDX-License-Identifier: BSD-2-Clause
// StateFile: the whole file is read and its checksum compared before any section is used. A section
// is read again when it is needed.
#include "core/render/state/state_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

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

// Reads until `size` bytes are there or the file ends. Returns their number.
std::size_t ReadAt(int file, std::uint64_t offset, char* to, std::size_t size) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t count = pread(file, to + done, size - done, off_t(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw InputFileError(std::strerror(errno));
    if (count == 0) break;
    done += std::size_t(count);
  }
  return done;
}

std::string ReadHead(const std::string& path) {
  const Descriptor file(OpenRegularFile(path));
  std::string bytes(kSignature.size(), '\0');
  bytes.resize(ReadAt(file.Get(), 0, bytes.data(), bytes.size()));
  return bytes;
}

// Adds the words of some bytes to a checksum. Zeros fill the last word.
std::uint64_t AddWords(std::uint64_t hash, std::string_view bytes) {
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

}  // namespace

std::uint64_t StateChecksum(std::uint64_t before, std::string_view bytes) {
  return AddWords(Mix(before, bytes.size()), bytes);
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

// Scanner reads a file from its beginning to its end in blocks.
class StateFile::Scanner {
 public:
  explicit Scanner(const StateFile& state) : state_(state), block_(kBlock, '\0') {
    struct stat status;
    if (fstat(state.file_->Get(), &status) != 0) throw InputFileError(std::strerror(errno));
    left_ = std::uint64_t(status.st_size);
  }

  std::uint64_t Offset() const { return offset_; }
  bool IsAtEnd() const { return left_ == 0; }

  // Returns the next bytes, at most a block.
  std::string Take(std::uint64_t size) {
    if (size > left_ || size > kBlock) FailShort();
    std::string bytes(std::size_t(size), '\0');
    Read(bytes.data(), bytes.size());
    return bytes;
  }
  template <class Number>
  Number TakeNumber() {
    Number number;
    std::memcpy(&number, Take(sizeof number).data(), sizeof number);
    return number;
  }
  // Passes the next bytes and adds them to both checksums.
  void Pass(std::uint64_t size, std::uint64_t* checksum, std::uint64_t* digest) {
    if (size > left_) FailShort();
    *checksum = Mix(*checksum, size);
    *digest = Mix(*digest, size);
    while (size > 0) {
      const std::string_view block(block_.data(),
                                   std::size_t(std::min<std::uint64_t>(size, kBlock)));
      Read(block_.data(), block.size());
      *checksum = AddWords(*checksum, block);
      *digest = AddWords(*digest, block);
      size -= block.size();
    }
  }
  [[noreturn]] void FailShort() const { state_.Fail("it is cut off or damaged", true); }

 private:
  static constexpr std::size_t kBlock = std::size_t(1) << 20;  // whole words

  void Read(char* to, std::size_t size) {
    if (ReadAt(state_.file_->Get(), offset_, to, size) != size) FailShort();
    offset_ += size;
    left_ -= size;
  }

  const StateFile& state_;
  std::uint64_t offset_ = 0, left_ = 0;
  std::string block_;
};

StateFile::StateFile(const std::string& path, StateUse use) : path_(path), use_(use) {
  try {
    file_ = std::make_unique<Descriptor>(OpenRegularFile(path));
    const std::string head = ReadHead(path);
    if (!kSignature.starts_with(head)) {
      const bool isDamaged = MayBeStateFile(path);
      if (isDamaged || use == StateUse::Part)
        Fail("it is not the state of a render, or its first bytes are damaged", isDamaged);
      Fail("it is not the state of a stopped render");
    }
    Scanner scanner(*this);
    std::string start = scanner.Take(kSignature.size());
    start += scanner.Take(sizeof kStateVersion);
    std::uint32_t version;
    std::memcpy(&version, start.data() + kSignature.size(), sizeof version);
    if (version != kStateVersion)
      Fail("it has version " + std::to_string(version) + ", and this program reads version " +
           std::to_string(kStateVersion));
    std::uint64_t checksum = StateChecksum(0, start);
    for (;;) {
      const std::string name = scanner.Take(scanner.TakeNumber<std::uint64_t>());
      const auto size = scanner.TakeNumber<std::uint64_t>();
      checksum = StateChecksum(checksum, SectionHead(name, size));
      if (name == kEnd) {
        const std::string saved = scanner.Take(size);
        const bool isSame =
            saved == std::string_view(reinterpret_cast<const char*>(&checksum), sizeof checksum);
        if (!isSame || !scanner.IsAtEnd()) Fail("it is damaged: its checksum does not match", true);
        return;
      }
      Section& section = sections_[name];
      section = {scanner.Offset(), size, 0};
      scanner.Pass(size, &checksum, &section.digest);
    }
  } catch (const InputFileError& error) {
    throw Error(ExitStatus::File, "cannot read the state \"" + path + "\": " + error.what());
  }
}

void StateFile::Fail(const std::string& why, bool isDamaged) const {
  const bool isPart = use_ == StateUse::Part;
  const std::string text =
      (isPart ? "cannot use the part \"" : "cannot continue from \"") + path_ + "\": " + why;
  const std::string hint =
      isPart ? "render this part again" : "without --resume the render starts from the beginning";
  if (isDamaged) throw DamagedState(ExitStatus::File, text, {}, hint);
  throw Error(ExitStatus::File, text, {}, hint);
}

std::vector<std::string> StateFile::Names() const {
  std::vector<std::string> names;
  for (const auto& [name, section] : sections_) names.push_back(name);
  return names;
}

std::string StateFile::Get(const std::string& name) const {
  const auto found = sections_.find(name);
  if (found == sections_.end()) Fail("its section \"" + name + "\" is missing");
  const Section& section = found->second;
  try {
    if (!file_) file_ = std::make_unique<Descriptor>(OpenRegularFile(path_));
    std::string bytes(std::size_t(section.size), '\0');
    const std::size_t size = ReadAt(file_->Get(), section.offset, bytes.data(), bytes.size());
    if (size != bytes.size() || StateChecksum(0, bytes) != section.digest)
      Fail("it has changed while it was read");
    return bytes;
  } catch (const InputFileError& error) {
    throw Error(ExitStatus::File, "cannot read the state \"" + path_ + "\": " + error.what());
  }
}

std::uint64_t StateFile::Digest(const std::string& name) const {
  return StateChecksum(sections_.at(name).digest, name);
}

bool IsStateFile(const std::string& path) {
  try {
    return ReadHead(path) == kSignature;
  } catch (const InputFileError&) {
    return false;
  }
}

bool MayBeStateFile(const std::string& path) {
  try {
    const std::string head = ReadHead(path);
    std::size_t same = 0;
    for (std::size_t i = 0; i < head.size(); ++i) same += head[i] == kSignature[i] ? 1u : 0u;
    return same == head.size() || same + 1 == kSignature.size();
  } catch (const InputFileError&) {
    return false;
  }
}

}  // namespace exphoton
