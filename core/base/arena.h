// SPDX-License-Identifier: BSD-2-Clause
// Arena allocates memory that lives until the end of one camera sample or photon path. Each thread
// owns one arena. Reset keeps the memory blocks, so only the first samples allocate from the heap.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace exphoton {

// The alignment is two cache lines, because machines fetch cache lines in pairs. It prevents false
// sharing between arenas that lie in one array.
class alignas(128) Arena {
 public:
  Arena();
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  // Constructs a T. Its destructor never runs, so T must not own anything that needs one.
  template <class T, class... Args>
  T* Make(Args&&... args) {
    return new (Allocate(sizeof(T), alignof(T))) T(std::forward<Args>(args)...);
  }
  template <class T>
  std::span<T> MakeArray(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T>);
    if (count == 0) return {};
    return {new (Allocate(sizeof(T) * count, alignof(T))) T[count](), count};
  }
  // Allocates an array of `count` elements without constructing them. The caller constructs each
  // element in place (new (array + i) T) before reading it.
  template <class T>
  T* AllocateArray(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T>);
    return static_cast<T*>(Allocate(sizeof(T) * count, alignof(T)));
  }

  void Reset() { block_ = 0, used_ = 0; }

  // Rewind releases everything allocated after the mark. Recursive functions use marks for their
  // temporary buffers.
  struct Mark {
    std::size_t block, used;
  };
  Mark GetMark() const { return {block_, used_}; }
  void Rewind(Mark mark) { block_ = mark.block, used_ = mark.used; }

 private:
  struct Block {
    std::unique_ptr<std::byte[]> data;
    std::size_t size;
  };
  static constexpr std::size_t kBlockBytes = 64 * 1024;

  void* Allocate(std::size_t bytes, std::size_t alignment) {
    for (; block_ < blocks_.size(); ++block_, used_ = 0) {
      const std::size_t start = (used_ + alignment - 1) / alignment * alignment;
      if (start + bytes <= blocks_[block_].size) {
        used_ = start + bytes;
        return blocks_[block_].data.get() + start;
      }
    }
    return AllocateInNewBlock(bytes);
  }
  void* AllocateInNewBlock(std::size_t bytes);

  std::vector<Block> blocks_;
  std::size_t block_ = 0, used_ = 0;
};

}  // namespace exphoton
