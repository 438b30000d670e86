// SPDX-License-Identifier: BSD-2-Clause
// StateFile: the whole file is read and its checksum compared before any section is used. A section
// is read again when it is needed.
#include "core/files/state_file.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "core/base/error.h"
#include "core/base/mix_bits.h"
#include "core/files/input_file.h"

namespace exphoton {
namespace {

// The line ends show a transfer that changed them.
constexpr std::string_view kSignature = "EXPHOTON STATE\r\n";
constexpr std::string_view kEnd = "checksum";
constexpr std::string_view kFiller = "filler";

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

std::string Noun(StateUse use) { return use == StateUse::Photons ? "the photons" : "the state"; }

// Adds the words of some bytes to a checksum. Zeros fill the last word.
std::uint64_t AddWords(std::uint64_t hash, std::string_view bytes) {
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    std::uint64_t word;
    std::memcpy(&word, bytes.data(), 8);
    hash = MixWord(hash, word);
  }
  if (bytes.empty()) return hash;
  std::uint64_t word = 0;
  std::memcpy(&word, bytes.data(), bytes.size());
  return MixWord(hash, word);
}

}  // namespace

std::uint64_t StateChecksum(std::uint64_t before, std::string_view bytes) {
  return AddWords(MixWord(before, bytes.size()), bytes);
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

void StateWriter::AddAligned(std::string_view name, std::span<const std::byte> bytes) {
  const auto headSize = [](std::string_view of) { return SectionHead(of, 0).size(); };
  const std::uint64_t past = (file_.Tell() + headSize(name)) % kAlignment;
  if (past != 0) {
    const std::size_t least = headSize(kFiller);
    const std::size_t zeros = (2 * kAlignment - past - least % kAlignment) % kAlignment;
    Add(kFiller, std::string(zeros, '\0'));
  }
  Add(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void StateWriter::AddArchive(std::string_view name, const Save& save) {
  ByteArchive archive;
  save(&archive);
  Add(name, archive.Take());
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
    *checksum = MixWord(*checksum, size);
    *digest = MixWord(*digest, size);
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
      if (use == StateUse::Photons)
        Fail("it is no file of photons, or its first bytes are damaged", isDamaged);
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
    throw Error(ExitStatus::File,
                "cannot read " + Noun(use) + " \"" + path + "\": " + error.what());
  }
}

void StateFile::Fail(const std::string& why, bool isDamaged) const {
  const auto [refusal, hint] = [&]() -> std::pair<const char*, const char*> {
    switch (use_) {
      case StateUse::Part:  // a render replaces damaged parts only
        return {"cannot use the part", isDamaged
                                           ? "render this part again"
                                           : "if it is a part, remove it and render it again"};
      case StateUse::Photons:
        return {"cannot use the photons", "exphoton photons SCENE -o FILE shoots them again"};
      case StateUse::Resume:
        break;
    }
    return {"cannot continue from", "without --resume the render starts from the beginning"};
  }();
  const std::string text = std::string(refusal) + " \"" + path_ + "\": " + why;
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
    throw Error(ExitStatus::File,
                "cannot read " + Noun(use_) + " \"" + path_ + "\": " + error.what());
  }
}

MappedBytes StateFile::Map(const std::string& name) const {
  const auto found = sections_.find(name);
  if (found == sections_.end()) Fail("its section \"" + name + "\" is missing");
  const auto [offset, size, digest] = found->second;
  if (size == 0) return {};
  if (offset % StateWriter::kAlignment != 0)
    Fail("its section \"" + name + "\" has another alignment", true);
  try {
    if (!file_) file_ = std::make_unique<Descriptor>(OpenRegularFile(path_));
  } catch (const InputFileError& error) {
    throw Error(ExitStatus::File,
                "cannot read " + Noun(use_) + " \"" + path_ + "\": " + error.what());
  }
  // A mapping begins at a page.
  const auto page = std::uint64_t(sysconf(_SC_PAGESIZE));
  const std::uint64_t begin = offset / page * page;
  const auto length = std::size_t(offset - begin + size);
  void* const mapping = mmap(nullptr, length, PROT_READ, MAP_PRIVATE, file_->Get(), off_t(begin));
  if (mapping == MAP_FAILED)
    throw Error(ExitStatus::Resource,
                "cannot map \"" + path_ + "\" into memory: " + std::strerror(errno));
  const std::shared_ptr<const void> owner(
      mapping, [length](const void* at) { munmap(const_cast<void*>(at), length); });
  return {{static_cast<const std::byte*>(mapping) + (offset - begin), std::size_t(size)}, owner};
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
