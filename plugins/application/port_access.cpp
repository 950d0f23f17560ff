// Elements by path, and values in and out from outside of cycles.

#include <memory>
#include <mutex>
#include <string>

#include "core/element/attempt.h"
#include "core/paths/path_search.h"
#include "plugins/application/internal/application_parts.h"
#include "plugins/values/watched_port.h"

namespace runnel {

namespace {

// What holds a port of whoever embeds the application, beside it.
class OutsidePort final : public FrameworkElement {
 public:
  explicit OutsidePort(const Placement& placement) : FrameworkElement(placement) {}
  std::unique_ptr<Port> port;
};

// Of ports only ports.
Result<FrameworkElement*> FindAs(Runtime& runtime, std::string_view path, PathKind kind) {
  const PathSearch structure(runtime);
  if (kind == PathKind::kElement || kind == PathKind::kParameter) return structure.Find(path, kind);
  const auto found = structure.FindPort(path, kind);
  if (!found) return found.error();
  return static_cast<FrameworkElement*>(*found);
}

std::string KindText(const FrameworkElement& element) {
  if (const auto* const port = dynamic_cast<const Port*>(&element)) {
    const bool is_input = port->direction() == Port::Direction::kInput;
    return std::string(port->is_proxy() ? "an interface port"
                       : is_input       ? "an input"
                                        : "an output") +
           " of type " + port->type().name();
  }
  if (const auto* const parameter = dynamic_cast<const Configurable*>(&element)) {
    return std::string(parameter->info().is_static ? "a static parameter" : "a parameter") + " of type " +
           parameter->type().name();
  }
  if (element.kind() == ElementKind::kModule) return "a module";
  return element.kind() == ElementKind::kGroup ? "a group" : "another element";
}

}  // namespace

Result<FrameworkElement*> Application::FindElement(std::string_view path, PathKind kind) {
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  return FindAs(parts_->runtime(), path, kind);
}

Error Application::IsAnother(const FrameworkElement& found, const std::string& wanted) {
  return {.message = "this is " + KindText(found) + ", not " + wanted, .path = found.path()};
}

Result<void> Application::LookAt(std::string_view path, const TypeInfo& type, const Port::Visitor& look) {
  const EpochGuard guard;  // what is found stays in memory so long
  std::unique_lock lock(parts_->runtime().structure_mutex());
  const auto found = PathSearch(parts_->runtime()).FindPort(path, PathKind::kOutput);
  if (!found) return found.error();
  const Port& port = **found;
  if (&port.type() != &type) return IsAnother(port, "a port of type " + type.name());
  WatchedPort watched(port.path());
  if (auto there = watched.Find(parts_->runtime()); !there) return there;
  lock.unlock();
  watched.VisitIfNew(look);
  return {};
}

Result<void> Application::Tie(std::string_view path, PathKind kind, const ConnectOptions& options,
                              const std::function<std::unique_ptr<Port>(FrameworkElement& group)>& make) {
  Runtime& runtime = parts_->runtime();
  OutsidePort* place = nullptr;
  const auto tied = Attempt([&]() -> Result<void> {
    const std::lock_guard lock(runtime.structure_mutex());
    const auto found = FindAs(runtime, path, kind);
    if (!found) return found.error();
    auto& port = dynamic_cast<Port&>(**found);
    place = &runtime.Create<OutsidePort>(runtime.root(), "outside_" + std::to_string(++parts_->ties));
    place->port = make(*place);
    if (auto ready = runtime.MakeReady(*place); !ready) return ready;
    if (kind == PathKind::kOutput) return Port::Connect(port, *place->port, options);
    return Port::Connect(*place->port, port, options);
  });
  // Outside of the lock, for deleting waits for cycles.
  if (!tied && place != nullptr) (void)runtime.Delete(*place);
  return tied;
}

Runtime& Application::runtime() const noexcept { return parts_->runtime(); }
FrameworkElement& Application::element() const noexcept { return *parts_->element(); }
const std::string& Application::name() const noexcept { return parts_->name(); }
const std::string& Application::file() const noexcept { return parts_->file(); }
const std::string& Application::text() const noexcept { return parts_->text(); }
const ApplicationOptions& Application::options() const noexcept { return parts_->options(); }
const Extensions& Application::extensions() const noexcept { return parts_->extensions(); }
Scheduler& Application::scheduler() noexcept { return *parts_->scheduler; }
Supervisor& Application::supervisor() noexcept { return *parts_->supervisor; }
StructureEditor& Application::editor() noexcept { return *parts_->editor; }
ChangeHistory& Application::history() noexcept { return *parts_->history; }
PluginManager& Application::plugins() noexcept { return parts_->plugins(); }
XmlTagRegistry& Application::tags() noexcept { return parts_->tags(); }
const char* Application::Version() noexcept { return RUNNEL_VERSION; }
RunReport& Application::report() noexcept { return *parts_->report; }
ApplicationLog& Application::log() noexcept { return *parts_->log; }

}  // namespace runnel
