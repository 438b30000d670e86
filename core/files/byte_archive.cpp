// SPDX-License-Identifier: BSD-2-Clause
// ByteArchive: counts are checked before memory is reserved for the items.
#include "core/files/byte_archive.h"

namespace exphoton {

void ByteArchive::CheckEnd() const {
  if (!rest_.empty()) throw ArchiveError(std::to_string(rest_.size()) + " bytes are too many");
}

std::size_t ByteArchive::Count(std::size_t count, std::size_t leastBytes) {
  std::uint64_t number = count;
  Value(&number);
  if (isLoading_ && number > rest_.size() / leastBytes)
    throw ArchiveError("a count exceeds its bytes");
  return std::size_t(number);
}

void ByteArchive::Text(std::string* text) {
  const std::size_t size = Count(text->size(), 1);
  if (!isLoading_) {
    saved_ += *text;
    return;
  }
  text->assign(rest_.substr(0, size));
  rest_.remove_prefix(size);
}

}  // namespace exphoton
