// SPDX-License-Identifier: BSD-2-Clause
// Finds one symbol of a library: the program headers locate the dynamic section, which locates the
// hash table. Offsets come from the file and may have any value, so every read is checked against
// the end of the file.
#include "core/plugins/elf_file.h"

#include <elf.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace exphoton {
namespace {

#if defined(__x86_64__)
constexpr int kMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr int kMachine = EM_AARCH64;
#else
constexpr int kMachine = EM_NONE;  // unknown: left to the system's loader
#endif
constexpr std::uint64_t kMaxSymbols = 1 << 24;

struct Fault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] void FailTruncated() { throw Fault("is truncated"); }

class Library {
 public:
  explicit Library(int file) : file_(file) {
    struct stat status;
    if (fstat(file, &status) != 0) throw Fault(std::strerror(errno));
    size_ = std::uint64_t(status.st_size);
    ReadHeader();
    ReadParts();
    ReadDynamicSection();
  }

  bool Exports(const std::string& name) const {
    if (symbols_ == 0 || names_ == 0) return false;
    return gnuHash_ ? IsInGnuTable(name) : hash_ && IsInTable(name);
  }

 private:
  template <class T>
  T Read(std::uint64_t offset) const {
    T value;
    if (offset > size_ || sizeof value > size_ - offset ||
        pread(file_, &value, sizeof value, off_t(offset)) != ssize_t(sizeof value))
      FailTruncated();
    return value;
  }

  void ReadHeader() {
    char magic[SELFMAG] = {};
    if (size_ < SELFMAG || pread(file_, magic, SELFMAG, 0) != SELFMAG ||
        std::memcmp(magic, ELFMAG, SELFMAG) != 0)
      throw Fault("is not a library");
    header_ = Read<Elf64_Ehdr>(0);
    constexpr int kOrder = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? ELFDATA2LSB : ELFDATA2MSB;
    if (header_.e_ident[EI_CLASS] != ELFCLASS64 || header_.e_ident[EI_DATA] != kOrder ||
        (kMachine != EM_NONE && header_.e_machine != kMachine))
      throw Fault("cannot be loaded: it is built for another kind of machine");
    if (header_.e_type != ET_DYN || header_.e_phentsize != sizeof(Elf64_Phdr))
      throw Fault("is not a shared library");
  }

  // The system's loader maps the segments that the headers describe. The process would die if the
  // file were shorter.
  void ReadParts() {
    for (std::uint64_t i = 0; i < header_.e_phnum; ++i) {
      const auto part = Read<Elf64_Phdr>(header_.e_phoff + i * sizeof(Elf64_Phdr));
      if (part.p_filesz > size_ || part.p_offset > size_ - part.p_filesz) FailTruncated();
      parts_.push_back(part);
    }
  }

  // Returns the file offset of a memory address; 0 if the file does not contain it.
  std::uint64_t OffsetOf(std::uint64_t address) const {
    for (const Elf64_Phdr& part : parts_)
      if (part.p_type == PT_LOAD && address >= part.p_vaddr &&
          address - part.p_vaddr < part.p_filesz)
        return part.p_offset + (address - part.p_vaddr);
    return 0;
  }

  void ReadDynamicSection() {
    for (const Elf64_Phdr& part : parts_) {
      if (part.p_type != PT_DYNAMIC) continue;
      for (std::uint64_t at = 0; at + sizeof(Elf64_Dyn) <= part.p_filesz; at += sizeof(Elf64_Dyn)) {
        const auto entry = Read<Elf64_Dyn>(part.p_offset + at);
        if (entry.d_tag == DT_NULL) break;
        if (entry.d_tag == DT_SYMTAB) symbols_ = OffsetOf(entry.d_un.d_ptr);
        if (entry.d_tag == DT_STRTAB) names_ = OffsetOf(entry.d_un.d_ptr);
        if (entry.d_tag == DT_HASH) hash_ = OffsetOf(entry.d_un.d_ptr);
        if (entry.d_tag == DT_GNU_HASH) gnuHash_ = OffsetOf(entry.d_un.d_ptr);
      }
      return;
    }
    throw Fault("is not a shared library");
  }

  bool IsDefinedAs(std::uint64_t index, const std::string& name) const {
    const auto symbol = Read<Elf64_Sym>(symbols_ + index * sizeof(Elf64_Sym));
    const unsigned binding = ELF64_ST_BIND(symbol.st_info);
    if (symbol.st_shndx == SHN_UNDEF || ELF64_ST_TYPE(symbol.st_info) != STT_FUNC ||
        (binding != STB_GLOBAL && binding != STB_WEAK))
      return false;
    for (std::uint64_t i = 0; i <= name.size(); ++i)
      if (Read<char>(names_ + symbol.st_name + i) != name.c_str()[i]) return false;
    return true;
  }

  bool IsInTable(const std::string& name) const {
    const std::uint64_t count = Read<std::uint32_t>(hash_ + 4);
    for (std::uint64_t i = 1; i < std::min(count, kMaxSymbols); ++i)
      if (IsDefinedAs(i, name)) return true;
    return false;
  }

  bool IsInGnuTable(const std::string& name) const {
    std::uint32_t hash = 5381;
    for (const char c : name) hash = hash * 33 + static_cast<unsigned char>(c);
    const auto word = [&](std::uint64_t index) {
      return std::uint64_t(Read<std::uint32_t>(gnuHash_ + 4 * index));
    };
    const std::uint64_t buckets = word(0), first = word(1), filterWords = word(2);
    if (buckets == 0) return false;
    const std::uint64_t bucketsAt = 4 + 2 * filterWords, chainsAt = bucketsAt + buckets;
    std::uint64_t index = word(bucketsAt + hash % buckets);
    if (index < first) return false;
    for (std::uint64_t i = 0; i < kMaxSymbols; ++i, ++index) {
      const std::uint64_t other = word(chainsAt + index - first);
      if ((other | 1) == (std::uint64_t(hash) | 1) && IsDefinedAs(index, name)) return true;
      if (other & 1) return false;  // the end of the chain
    }
    return false;
  }

  int file_;
  std::uint64_t size_ = 0;
  Elf64_Ehdr header_{};
  std::vector<Elf64_Phdr> parts_;
  std::uint64_t symbols_ = 0, names_ = 0, hash_ = 0, gnuHash_ = 0;  // file offsets; 0: none
};

}  // namespace

std::optional<LibraryFault> FaultOfLibrary(int file, const std::string& symbol) {
  try {
    if (Library(file).Exports(symbol)) return std::nullopt;
    return LibraryFault{"is a library, but not a plugin: it has no symbol " + symbol, true};
  } catch (const Fault& fault) {
    return LibraryFault{fault.what(), false};
  }
}

}  // namespace exphoton
