#include "core/plugin/late_types.h"

#include <map>
#include <mutex>
#include <utility>

namespace runnel {

namespace {

struct LateTypes {
  std::mutex mutex;  // a leaf, but for what finders lock
  std::map<std::string, LateTypeFinder, std::less<>> finders;
  // Of all finders there ever were: who has been told of a type may keep the pointer.
  std::map<std::string, ModuleType, std::less<>> known;
};

LateTypes& Late() {
  static auto* const late = new LateTypes;  // plugins' code may ask until the very end
  return *late;
}

}  // namespace

void AddLateTypes(std::string prefix, LateTypeFinder find) {
  const std::lock_guard lock(Late().mutex);
  Late().finders.insert_or_assign(std::move(prefix), std::move(find));
}

Result<const ModuleType*> internal::FindLateType(std::string_view name) {
  LateTypes& late = Late();
  LateTypeFinder find;
  {
    const std::lock_guard lock(late.mutex);
    if (const auto known = late.known.find(name); known != late.known.end()) return &known->second;
    for (const auto& [prefix, finder] : late.finders) {
      if (name.starts_with(prefix)) find = finder;
    }
  }
  if (!find) return Error{};
  auto found = find(name);
  if (!found) return found.error();
  const std::lock_guard lock(late.mutex);
  return &late.known.try_emplace(std::string(name), std::move(*found)).first->second;
}

}  // namespace runnel
