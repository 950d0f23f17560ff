#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/element/runtime.h"
#include "core/element/unlisted_element.h"
#include "plugins/structure/replacement.h"

namespace runnel::internal {

/// What one change set makes beside the tree, by what it is and where it goes: kept from one attempt to the next, as
/// others may change the structure while a slow module is made, and it is to be made once.
///
/// Threads: one.
class Workshop {
 public:
  struct Work {
    std::shared_ptr<UnlistedElement> element;
    Values values = {};  // of the module whose place it takes, when it was made
  };
  /// Thrown when others have changed the structure meanwhile: the attempt is to begin anew.
  struct Overtaken {};

  /// What has been made for `key`, or what `make` makes.
  const Result<Work>& Get(const std::string& key, const std::function<Result<Work>()>& make) {
    const auto known = works_.find(key);
    return known != works_.end() ? known->second : works_.emplace(key, make()).first->second;
  }
  [[nodiscard]] std::size_t size() const noexcept { return works_.size(); }

 private:
  std::map<std::string, Result<Work>>
      works_;  // a group comes before what is in it: it is asked for first
};

/// While one lives, the thread that holds the structure lock does not. Precondition: it has taken it once.
class Unlocked {
 public:
  explicit Unlocked(Runtime& runtime) : mutex_(runtime.structure_mutex()) { mutex_.unlock(); }
  ~Unlocked() { mutex_.lock(); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  OrderedMutex& mutex_;
};

}  // namespace runnel::internal
