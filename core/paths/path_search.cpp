#include "core/paths/path_search.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "core/element/file_notes.h"
#include "core/paths/distant_ports.h"
#include "core/port/parameter_input.h"

namespace runnel {

namespace {

bool Fits(const FrameworkElement& element, PathKind kind) {
  const auto* const port = dynamic_cast<const Port*>(&element);
  if (kind == PathKind::kParameter) return dynamic_cast<const Configurable*>(&element) != nullptr;
  if (kind == PathKind::kElement || port == nullptr) return kind == PathKind::kElement;
  const bool sends = port->direction() == Port::Direction::kOutput;
  return port->is_proxy() || sends == (kind == PathKind::kOutput);
}

// What may be named without its group: of ports those of either direction, those that fit first.
std::vector<FrameworkElement*> PartsOf(const FrameworkElement& module, PathKind kind) {
  std::vector<FrameworkElement*> parts;
  const auto add = [&](FrameworkElement& element) {
    const bool is_port = kind != PathKind::kParameter && dynamic_cast<Port*>(&element) != nullptr;
    if (is_port || Fits(element, kind)) parts.push_back(&element);
  };
  for (FrameworkElement* child : module.children()) {
    add(*child);
    if (child->kind() != ElementKind::kPortGroup) continue;
    for (FrameworkElement* inner : child->children()) add(*inner);
  }
  const PathKind first = kind == PathKind::kElement ? PathKind::kOutput : kind;
  std::stable_partition(parts.begin(), parts.end(), [&](const auto* part) { return Fits(*part, first); });
  return parts;
}

std::vector<std::string> NamesOf(const std::vector<FrameworkElement*>& elements, PathKind kind) {
  std::vector<std::string> names;
  for (const FrameworkElement* each : elements) {
    if (Fits(*each, kind)) names.push_back(each->name());
  }
  return names;
}

// The paths of what is called so elsewhere, for who has left out what stands before, in words: "/robot/planner".
std::string ElsewhereHint(FrameworkElement& at, std::string_view name, std::string_view rest) {
  constexpr std::size_t kMost = 3;
  std::vector<std::string> paths;
  at.runtime().root().Visit([&](FrameworkElement& each) {
    const bool is_part =
        each.parent() != nullptr && (each.kind() == ElementKind::kModule || each.kind() == ElementKind::kGroup);
    if (is_part && each.name() == name) paths.push_back(each.path() + std::string(rest));
  });
  if (paths.empty() || paths.size() > kMost) return {};
  std::string hint = "did you mean ";
  for (std::size_t i = 0; i < paths.size(); ++i) hint += (i > 0 ? " or " : "") + paths[i];
  return hint + "?";
}

PathEnd Missing(FrameworkElement& at, std::string_view name, std::vector<std::string> candidates,
                std::string_view rest = {}) {
  std::string hint = NearestName(name, candidates).empty() ? ElsewhereHint(at, name, rest) : "";
  if (hint.empty()) hint = NearestNameHint(name, candidates);
  Error error{
      .message = "there is no '" + std::string(name) + "' in " + at.path(), .path = at.path(), .hint = std::move(hint)};
  return {nullptr, &at, std::string(name), std::move(candidates), std::move(error)};
}

Error WhyNotThere(const DistantPorts* distant, std::string_view path, PathKind kind) {
  if (distant == nullptr) return {.message = "there is no network"};
  if (kind == PathKind::kInput) {
    return {.message = "inputs of another application are connected there",
            .hint = "'runnel connect --app NAME //THIS/PORT /INPUT' where it runs"};
  }
  const DistantType type = distant->TypeOf(SplitPortPath(path).path);
  if (type.type == nullptr) return {.message = type.why_not};
  return {.message = "nothing here is connected to it",
          .hint = "connect an input to it, or ask the other application: --app NAME where it runs"};
}

}  // namespace

PathEnd PathSearch::Follow(std::string_view path, PathKind kind) const {
  if (IsDistantPath(path)) {
    FrameworkElement& root = base_.runtime().root();
    const DistantPorts* const distant = DistantPorts::FindIn(root);
    if (Port* const port = distant != nullptr ? distant->Find(path) : nullptr) return {port, port};
    return {nullptr, &root, std::string(path), {}, WhyNotThere(distant, path, kind)};
  }
  const bool is_from_root = IsAbsolutePath(path) || base_.parent() == nullptr;
  PathEnd end = FollowFrom(is_from_root ? base_.runtime().root() : base_, path, kind);
  if (end.found != nullptr || !is_from_root || !may_leave_out_application_) return end;
  FrameworkElement* const application = OnlyApplication();
  if (application == nullptr) return end;
  PathEnd below = FollowFrom(*application, path, kind);
  // A path that begins with a name at the root is meant from there.
  return below.found != nullptr || end.at->parent() == nullptr ? below : end;
}

PathEnd PathSearch::FollowFrom(FrameworkElement& start, std::string_view path, PathKind kind) const {
  FrameworkElement* at = &start;
  const std::vector<std::string_view> names = SplitPath(path);
  for (const std::string_view& name : names) {
    FrameworkElement* next = Child(*at, name);
    if (name == ".") next = at;
    if (name == "..") next = at->parent();
    // As in a module, whose place a composite may have got.
    const bool is_of_module = name == "input" || name == "output" || name == "parameter";
    if (next == nullptr && is_of_module && at->kind() == ElementKind::kGroup && &name != &names.back()) next = at;
    if (next == nullptr) {
      const bool is_last = &name == &names.back();
      const bool is_of_group = kind == PathKind::kParameter && FindConfigurable(*at, name);
      if (is_last && (at->kind() == ElementKind::kModule || is_of_group)) return FollowShort(*at, name, kind);
      const std::string_view rest = path.substr(static_cast<std::size_t>(name.data() + name.size() - path.data()));
      return Missing(*at, name, NamesOf(Children(*at), PathKind::kElement), rest);
    }
    at = next;
  }
  return {at, at};
}

PathEnd PathSearch::FollowShort(FrameworkElement& module, std::string_view name, PathKind kind) const {
  const std::vector<FrameworkElement*> parts = PartsOf(module, kind);
  std::vector<FrameworkElement*> called = parts;
  std::erase_if(called, [&](const auto* part) { return part->name() != name; });
  if (called.empty() && kind != PathKind::kOutput) {
    if (const auto fed = FindConfigurable(module, name)) return {fed.element, fed.element};
  }
  if (called.empty()) return Missing(module, name, NamesOf(parts, kind));
  const bool is_ambiguous = kind != PathKind::kElement && called.size() > 1 && Fits(*called[1], kind);
  if (!is_ambiguous) return {called[0], called[0]};
  return {nullptr,
          &module,
          {},
          {},
          {.message = "'" + std::string(name) + "' names more than one port of " + module.path(),
           .path = module.path(),
           .hint = "write " + called[0]->path() + " or " + called[1]->path()}};
}

Result<FrameworkElement*> PathSearch::Find(std::string_view path, PathKind kind) const {
  PathEnd end = Follow(path, kind);
  if (end.found == nullptr) return std::move(end.error);
  return end.found;
}

Result<Port*> PathSearch::FindPort(std::string_view path, PathKind kind) const {
  const auto found = Find(path, kind);
  if (!found) return found.error();
  if (auto* const port = dynamic_cast<Port*>(*found)) return port;
  auto* const parameter = dynamic_cast<Configurable*>(*found);
  if (parameter != nullptr && kind == PathKind::kInput) {
    if (Port* const feed = parameter->Feed()) return feed;
    return Error{.message = (*found)->path() + " is a parameter that no output can set", .path = (*found)->path()};
  }
  const std::vector<std::string> ports = NamesOf(PartsOf(**found, kind), kind);
  return Error{.message = (*found)->path() + " is not a port",
               .path = (*found)->path(),
               .hint = !ports.empty()              ? "write one of its ports after it, like '" + ports[0] + "'"
                       : kind == PathKind::kOutput ? "it has no outputs"
                                                   : "it has no inputs"};
}

Result<PortPart> PathSearch::FindPortPart(std::string_view path, PathKind kind) const {
  auto whole = FindPort(path, kind);
  if (whole) return PortPart{*whole};
  const std::size_t begin = path.rfind('/') + 1;  // npos + 1 is 0
  std::optional<Error> error;
  for (std::size_t at = path.size(); at > begin + 1;) {
    at = path.find_last_of(".[", at - 1);
    if (at == std::string_view::npos || at <= begin) break;
    const auto found = FindPort(path.substr(0, at), kind);
    const std::string_view part = path.substr(path[at] == '.' ? at + 1 : at);
    if (found && !part.empty()) return PortPart{*found, std::string(part)};
    if (!found) error = found.error();
  }
  return error ? *error : whole.error();
}

FrameworkElement* PathSearch::Child(const FrameworkElement& parent, std::string_view name) const {
  return parent.FindChild(name);
}

std::vector<FrameworkElement*> PathSearch::Children(const FrameworkElement& parent) const { return parent.children(); }

// Groups at the top are applications, but for the one that holds the threads.
FrameworkElement* PathSearch::OnlyApplication() const {
  FrameworkElement* only = nullptr;
  const FrameworkElement& root = base_.runtime().root();
  for (FrameworkElement* each : root.children()) {
    const bool is_seen = Child(root, each->name()) == each;
    if (!is_seen || each->kind() != ElementKind::kGroup || each->name() == "threads") continue;
    if (only != nullptr) return nullptr;
    only = each;
  }
  return only;
}

std::vector<ConfigurableElement> ConfigurablesOf(const FrameworkElement& module) {
  std::vector<ConfigurableElement> found;
  for (FrameworkElement* part : PartsOf(module, PathKind::kParameter)) {
    found.push_back({part, dynamic_cast<Configurable*>(part)});
  }
  return found;
}

ConfigurableElement FindConfigurable(const FrameworkElement& module, std::string_view name) {
  for (const ConfigurableElement& each : ConfigurablesOf(module)) {
    if (each.element->name() == name) return each;
  }
  for (const ConfigurableElement& each : ConfigurablesOf(module)) {
    const auto* const former = each.element->FindAnnotation<FormerName>();
    if (former != nullptr && former->name == name) return each;
  }
  return {};
}

std::vector<Port*> PortsOf(const FrameworkElement& module) {
  std::vector<Port*> ports;
  const auto add = [&](FrameworkElement* element) {
    if (auto* const port = dynamic_cast<Port*>(element)) ports.push_back(port);
  };
  for (FrameworkElement* child : module.children()) {
    add(child);
    if (child->kind() != ElementKind::kPortGroup) continue;
    for (FrameworkElement* inner : child->children()) add(inner);
  }
  return ports;
}

const std::string& LastingPath(const Port& port) {
  if (const std::string& distant = DistantPathOf(port); !distant.empty()) return distant;
  const FrameworkElement* const parameter = ParameterSetBy(port);
  return parameter != nullptr ? parameter->path() : port.path();
}

std::string FreeName(const FrameworkElement& parent, const std::string& name) {
  std::string free = name;
  for (int i = 2; parent.FindChild(free) != nullptr; ++i) free = name + "_" + std::to_string(i);
  return free;
}

const std::string& DistantPathOf(const Port& port) {
  static const std::string none;
  const auto* const distant = port.FindAnnotation<DistantPort>();
  return distant != nullptr ? distant->path : none;
}

PortPathPart SplitPortPath(std::string_view path) {
  const std::size_t begin = path.rfind('/') + 1;  // npos + 1 is 0
  const std::size_t end = path.find_first_of(".[", begin + 1);
  if (end == std::string_view::npos) return {std::string(path), {}};
  return {std::string(path.substr(0, end)), std::string(path.substr(path[end] == '.' ? end + 1 : end))};
}

Result<void> BringDistantPort(std::string_view path, const Port& to, ConnectOptions options) {
  if (!IsDistantPath(path)) return {};
  DistantPorts* const ports = DistantPorts::FindIn(to);
  if (ports == nullptr) {
    return Error{.message = "'" + std::string(path) + "' is a port of another application, and this one has no network",
                 .hint = "add <network/> to the application, and to the other one what it offers"};
  }
  PortPathPart split = SplitPortPath(path);
  if (!split.part.empty()) options.part = std::move(split.part);
  const auto made = ports->Make(split.path, to, options);
  return made ? Result<void>() : made.error();
}

}  // namespace runnel
