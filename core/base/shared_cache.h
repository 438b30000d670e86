// SPDX-License-Identifier: BSD-2-Clause
// SharedCache: what several parts of a scene need and is expensive to make, such as an image that
// many textures show: made once, and kept as long as any of them uses it. For one thread.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <utility>

namespace exphoton {

class SharedCache {
 public:
  // The T of this name; where nobody has one, what make() returns by value. What make throws is
  // passed on, and leaves nothing behind.
  template <class T, class Make>
  std::shared_ptr<const T> GetOrMake(const std::string& name, Make&& make) {
    std::weak_ptr<const void>& kept = made_[{typeid(T), name}];
    if (const auto found = kept.lock()) return std::static_pointer_cast<const T>(found);
    auto made = std::make_shared<const T>(std::forward<Make>(make)());
    kept = made;
    return made;
  }

 private:
  std::map<std::pair<std::type_index, std::string>, std::weak_ptr<const void>> made_;
};

}  // namespace exphoton
