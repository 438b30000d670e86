// SPDX-License-Identifier: BSD-2-Clause
#include "tests/fuzz/state_edits.h"

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

namespace exphoton::fuzz {

TemporaryFolder::TemporaryFolder() {
  const char* const parent = std::filesystem::is_directory("/dev/shm") ? "/dev/shm" : "/tmp";
  path_ = std::string(parent) + "/exphoton-fuzz.XXXXXX";
  Require(mkdtemp(path_.data()) != nullptr, "a folder can be made");
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

EditableState::EditableState(const std::string& path) {
  const StateFile file(path);
  for (const std::string& name : file.Names()) sections_.emplace_back(name, file.Get(name));
}

void EditableState::Edit(Input input) {
  const auto number = [&input] { return std::size_t(input.Byte()) << 8 | input.Byte(); };
  while (!input.IsEmpty() && !sections_.empty()) {
    const int kind = input.Byte() % 8;
    const std::size_t index = input.Byte() % sections_.size();
    std::string& bytes = sections_[index].second;
    const std::size_t at = bytes.empty() ? 0 : number() % bytes.size();
    switch (kind) {
      case 0:
        sections_.erase(sections_.begin() + std::ptrdiff_t(index));
        break;
      case 1:
        bytes.resize(at);
        break;
      case 2:
        bytes.append(number() % 1024, '\0');
        break;
      case 3:  // a whole number, for counts
        for (std::size_t i = 0; i < 8 && at + i < bytes.size(); ++i)
          bytes[at + i] = char(input.Byte());
        break;
      default:
        if (!bytes.empty()) bytes[at] = char(input.Byte());
    }
  }
}

void EditableState::Write(const std::string& path) const {
  StateWriter writer(path);
  for (const auto& [name, bytes] : sections_)
    writer.AddAligned(name, std::as_bytes(std::span(bytes)));
  writer.Commit();
}

Silence::Silence() {
  std::fflush(nullptr);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (int i = 0; i < 2; ++i) {
    saved_[i] = dup(1 + i);
    dup2(nowhere, 1 + i);
  }
  close(nowhere);
}

Silence::~Silence() {
  std::fflush(nullptr);
  for (int i = 0; i < 2; ++i) {
    dup2(saved_[i], 1 + i);
    close(saved_[i]);
  }
}

}  // namespace exphoton::fuzz
