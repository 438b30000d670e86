// SPDX-License-Identifier: BSD-2-Clause
// ByteArchive turns numbers into bytes and back. One function of a class describes its members in
// order, and the same function saves and loads them. Numbers are little-endian.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace exphoton {

// Thrown while loading: the bytes end too early or contradict each other.
struct ArchiveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class ByteArchive {
 public:
  ByteArchive() = default;  // saves
  // Loads. The bytes must outlive this object.
  explicit ByteArchive(std::string_view bytes) : rest_(bytes), isLoading_(true) {}

  bool IsLoading() const { return isLoading_; }
  std::string Take() { return std::move(saved_); }  // the saved bytes
  void CheckEnd() const;                            // throws if bytes were not loaded

  template <class... Numbers>
  void Values(Numbers*... numbers) {
    (Value(numbers), ...);
  }
  // Loading requires the saved number to be equal to this one.
  template <class Number>
  void Same(Number number) {
    Number other = number;
    Value(&other);
    if (std::memcmp(&other, &number, sizeof number) != 0)
      throw ArchiveError("a number is not the one of this render");
  }
  // Saves or loads the number of items that follow. Each takes at least `leastBytes` bytes.
  std::size_t Count(std::size_t count, std::size_t leastBytes);
  void Text(std::string* text);
  template <class Number>
  void List(std::vector<Number>* numbers) {
    numbers->resize(Count(numbers->size(), sizeof(Number)));
    for (Number& number : *numbers) Value(&number);
  }

 private:
  template <class Number>
  void Value(Number* number) {
    static_assert(std::endian::native == std::endian::little);
    static_assert(std::is_trivially_copyable_v<Number> && !std::is_class_v<Number> &&
                  !std::is_pointer_v<Number> && !std::is_same_v<Number, bool>);
    if (isLoading_)
      Load(number, sizeof *number);
    else
      saved_.append(reinterpret_cast<const char*>(number), sizeof *number);
  }
  void Load(void* to, std::size_t size) {
    if (size > rest_.size()) throw ArchiveError("it ends too early");
    std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }

  std::string saved_;
  std::string_view rest_;
  bool isLoading_ = false;
};

}  // namespace exphoton
