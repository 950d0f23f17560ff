#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/element/framework_element.h"
#include "core/plugin/module_registry.h"
#include "core/port/port.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::internal {

/// What there is to know of elements besides themselves.
struct ElementSurroundings {
  const ModuleRegistry* modules = nullptr;                 ///< their summaries
  const Scheduler* scheduler = nullptr;                    ///< who says which modules are stuck
  std::map<std::uint64_t, std::string> thread_names;       ///< by id
  std::uint64_t default_thread = 0;                        ///< for what is assigned to none
  std::unordered_map<std::uint64_t, std::string> failed;  ///< modules, and what they threw
  std::vector<std::string> paused;                         ///< paths of elements, of threads
};

/// The element as the protocol has it: {"path":…,"kind":…,…}. Under the structure lock.
[[nodiscard]] std::string ElementJson(const FrameworkElement& element,
                                      const ElementSurroundings& around);
/// A number that is another one if ElementJson() of the same element would be (or most probably so):
/// quicker. Under the structure lock.
[[nodiscard]] std::uint64_t ElementFingerprint(const FrameworkElement& element,
                                               const ElementSurroundings& around);

/// {"from":…,"to":…,…}. Under the structure lock.
[[nodiscard]] std::string ConnectionJson(const Connection& connection);

}  // namespace runnel::internal
