#include "plugins/command_service/hand_settings.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "core/paths/path_search.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "core/types/value_copy.h"

namespace runnel {

namespace {

// Between two looks at the application's clock, which may pass faster than the machine's.
constexpr Duration kShortestLook = std::chrono::milliseconds(1);
constexpr Duration kLongestLook = std::chrono::milliseconds(10);

Error At(const Port& port, std::string message) {
  return {.message = std::move(message), .path = port.path()};
}

// An object of the port's type.
Result<std::shared_ptr<const void>> ValueOf(const Port& port, const std::string& text) {
  const TypeInfo& type = port.type();
  if (!type.is_transparent()) {
    return At(port, "values of type " + type.name() + " have no text format");
  }
  const std::shared_ptr<void> value = type.Make();
  if (!value) return At(port, "only a module can make values of type " + type.name());
  if (auto set = SetFromText(type, text, value.get()); !set) {
    Error error = set.error();
    if (error.path.empty()) error.path = port.path();
    return error;
  }
  return std::shared_ptr<const void>(value);
}

Result<void> Publish(Port& port, const void* value) {
  return port.PublishByHand([&](void* to) -> Result<void> {
    if (CopyValue(port.type(), value, to)) return {};
    return At(port, "the value does not fit into a buffer of the port");
  });
}

struct HandSet {
  std::string path;
  std::shared_ptr<const void> value;
};

Result<HandSet> SetPort(Runtime& runtime, const std::string& path, const std::string& text) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = PathSearch(runtime).FindPort(path, PathKind::kElement);
  if (!found) return found.error();
  const auto value = ValueOf(**found, text);
  if (!value) return value.error();
  if (auto published = Publish(**found, value->get()); !published) return published.error();
  return HandSet{(*found)->path(), *value};
}

}  // namespace

Result<std::string> SetPortByHand(Runtime& runtime, const std::string& path,
                                  const std::string& value) {
  const auto set = SetPort(runtime, path, value);
  if (!set) return set.error();
  return set->path;
}

Result<std::string> ReleasePort(Runtime& runtime, const std::string& path) {
  const std::lock_guard lock(runtime.structure_mutex());
  if (!path.empty()) {
    const auto found = PathSearch(runtime).FindPort(path, PathKind::kElement);
    if (!found) return found.error();
    if ((*found)->Release()) return (*found)->path();
    return At(**found, "is not set by hand");
  }
  std::string released;
  runtime.root().Visit([&](FrameworkElement& element) {
    auto* const port = dynamic_cast<Port*>(&element);
    if (port != nullptr && port->Release()) released += (released.empty() ? "" : ", ") + port->path();
  });
  if (released.empty()) return Error{.message = "no port is set by hand"};
  return released;
}

Result<std::string> HandSettings::Publish(const PublishRequest& request) {
  if (request.rate && (*request.rate <= 0 || *request.rate > PublishRequest::kFastestRate)) {
    return Error{.message = "the rate must be above 0 and at most 1000 Hz"};
  }
  const auto set = SetPort(runtime_, request.port, request.value);
  if (!set) return set.error();
  const std::uint64_t number = last_[set->path] = ++count_;
  if (!request.rate) return set->path;
  const Duration period = FromSeconds(1 / *request.rate);
  tasks_.PostSteps([this, set = *set, number, period,
                    due = runtime_.clock().Now() + period]() mutable -> std::optional<Duration> {
    const auto last = last_.find(set.path);
    if (last == last_.end() || last->second != number) return {};
    const Time now = runtime_.clock().Now();
    if (now >= due) {
      const std::lock_guard lock(runtime_.structure_mutex());
      const auto found = PathSearch(runtime_).FindPort(set.path, PathKind::kElement);
      if (!found || !(*found)->is_set_by_hand()) return {};  // released, or gone
      if (!runnel::Publish(**found, set.value.get())) return {};
      due = std::max(due + period, now);
    }
    return std::clamp(due - now, kShortestLook, kLongestLook);
  });
  return set->path;
}

Result<std::string> HandSettings::Release(const ReleaseRequest& request) {
  auto released = ReleasePort(runtime_, request.port);
  if (!released) return released;
  if (request.port.empty()) {
    last_.clear();
  } else {
    last_.erase(*released);
  }
  return released;
}

}  // namespace runnel
