#include "plugins/runtime_construction/port_search.h"

#include <algorithm>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"

namespace runnel {

namespace {

std::string Quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

bool Suits(const Port& port, ConnectionEnd end) {
  const bool sends = port.direction() == Port::Direction::kOutput;
  return port.is_proxy() || sends == (end == ConnectionEnd::kFrom);
}

bool HoldsPorts(const FrameworkElement& element) {
  return element.kind() == ElementKind::kPortGroup;
}

// The ports of a module, whatever groups they are in; of a group, its interface.
std::vector<Port*> PortsOf(const FrameworkElement& element) {
  std::vector<Port*> ports;
  for (FrameworkElement* child : element.children()) {
    if (auto* port = dynamic_cast<Port*>(child)) ports.push_back(port);
    if (!HoldsPorts(*child)) continue;
    for (FrameworkElement* inner : child->children()) {
      if (auto* port = dynamic_cast<Port*>(inner)) ports.push_back(port);
    }
  }
  return ports;
}

std::vector<std::string> NamesOf(const std::vector<Port*>& ports, ConnectionEnd end) {
  std::vector<std::string> names;
  for (const Port* port : ports) {
    if (Suits(*port, end)) names.push_back(port->name());
  }
  return names;
}

// What a person may have meant by a name that is not in `element`.
std::vector<std::string> ChildNames(const FrameworkElement& element) {
  std::vector<std::string> names;
  for (const FrameworkElement* child : element.children()) names.push_back(child->name());
  return names;
}

class Search {
 public:
  // Without a context, nothing is reported.
  Search(const PathUse& use, BuildContext* context) : use_(use), context_(context) {}

  // Goes along the path as far as it leads and returns the part that is not there, or "".
  std::string_view Walk() {
    at_ = IsAbsolutePath(use_.path) ? &use_.base.runtime().root() : &use_.base;
    parts_ = SplitPath(use_.path);
    for (const std::string_view part : parts_) {
      FrameworkElement* next = at_->FindChild(part);
      if (part == ".") next = at_;
      if (part == "..") next = at_->parent();
      if (next == nullptr) return part;
      at_ = next;
      ++walked_;
    }
    return {};
  }

  [[nodiscard]] FrameworkElement* at() const noexcept { return at_; }
  [[nodiscard]] bool only_the_last_is_left() const { return walked_ + 1 == parts_.size(); }

  void ReportMissing(std::string_view part, const std::vector<std::string>& candidates) {
    ExcuseModule();
    if (context_ == nullptr || context_->IsMissing(*at_, part)) return;
    Report({.message = "there is no " + Quoted(part) + " in " + at_->path(),
            .hint = NearestNameHint(part, candidates)});
  }
  void Report(Error error) {
    if (context_ != nullptr) context_->Report(std::move(error), use_.position, use_.base);
  }
  void ExcuseModule() {
    if (context_ == nullptr) return;
    for (const FrameworkElement* each = at_; each != nullptr; each = each->parent()) {
      if (each->kind() == ElementKind::kModule) context_->Excuse(*each);
    }
  }

 private:
  const PathUse& use_;
  BuildContext* const context_;
  FrameworkElement* at_ = nullptr;
  std::vector<std::string_view> parts_;
  std::size_t walked_ = 0;
};

// Of the ports called `name`, the one that suits; any, if none suits: connecting says why not.
// Nothing after reporting that several suit.
Port* Choose(const std::vector<Port*>& ports, std::string_view name, ConnectionEnd end,
             Search& search) {
  Port* chosen = nullptr;
  for (Port* port : ports) {
    if (port->name() != name) continue;
    if (chosen != nullptr && Suits(*chosen, end) && Suits(*port, end)) {
      search.ExcuseModule();
      search.Report({.message = Quoted(name) + " is more than one port of " + search.at()->path(),
                     .hint = "write " + chosen->path() + " or " + port->path()});
      return nullptr;
    }
    if (chosen == nullptr || Suits(*port, end)) chosen = port;
  }
  return chosen;
}

void ReportNoPort(const FrameworkElement& element, ConnectionEnd end, Search& search) {
  const std::vector<std::string> names = NamesOf(PortsOf(element), end);
  std::string hint = end == ConnectionEnd::kFrom ? "it has no outputs" : "it has no inputs";
  if (!names.empty()) hint = "write one of its ports after it, like " + Quoted(names.front());
  search.ExcuseModule();
  search.Report({.message = element.path() + " is not a port", .hint = std::move(hint)});
}

}  // namespace

FrameworkElement* SearchElement(const PathUse& use, BuildContext& context) {
  Search search(use, &context);
  const std::string_view missing = search.Walk();
  if (missing.empty()) return search.at();
  search.ReportMissing(missing, ChildNames(*search.at()));
  return nullptr;
}

namespace {

Port* PortOf(Search search, ConnectionEnd end) {
  const std::string_view missing = search.Walk();
  FrameworkElement& at = *search.at();
  if (missing.empty()) {
    auto* const port = dynamic_cast<Port*>(&at);
    if (port == nullptr) ReportNoPort(at, end, search);
    return port;
  }
  const std::vector<Port*> ports = PortsOf(at);
  const bool is_module = at.kind() == ElementKind::kModule;
  if (is_module && search.only_the_last_is_left()) {
    const bool is_known =
        std::ranges::any_of(ports, [&](const Port* port) { return port->name() == missing; });
    if (is_known) return Choose(ports, missing, end, search);
    search.ReportMissing(missing, NamesOf(ports, end));
  } else {
    search.ReportMissing(missing, ChildNames(at));
  }
  return nullptr;
}

}  // namespace

Port* SearchPort(const PathUse& use, ConnectionEnd end, BuildContext& context) {
  return PortOf(Search(use, &context), end);
}

Port* FindPort(const PathUse& use, ConnectionEnd end) { return PortOf(Search(use, nullptr), end); }

}  // namespace runnel
