// SPDX-License-Identifier: BSD-2-Clause
// SharedCache holds objects that are expensive to make and that several parts of a scene use, such
// as an image shown by many textures. Each object is made once and lives as long as any part uses
// it. The cache is not thread-safe.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <utility>

namespace exphoton {

class SharedCache {
 public:
  // Returns the T of this name. If none is alive, it calls make(), which returns a T by value. An
  // exception from make is passed on, and nothing is cached.
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
