#include "core/paths/late_connections.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/base/exception_text.h"
#include "core/base/retry.h"
#include "core/element/element_path.h"
#include "core/paths/distant_ports.h"

namespace runnel {

namespace {

// Without the group, which may be left out, and the group: "/a/laser/output/scan" is "/a/laser/scan" and "output".
std::pair<std::string, std::string> WithoutGroup(const std::string& path) {
  const std::size_t name = path.rfind('/');
  const std::size_t group = name == 0 || name == std::string::npos ? std::string::npos : path.rfind('/', name - 1);
  if (group == std::string::npos) return {path, ""};
  const std::string between = path.substr(group + 1, name - group - 1);
  const bool is_group = between == "output" || between == "input" || between == "parameter";
  return is_group ? std::pair(path.substr(0, group) + path.substr(name), between) : std::pair(path, std::string());
}

bool IsSame(const std::string& path, const std::string& other) {
  const auto [end, group] = WithoutGroup(path);
  const auto [other_end, other_group] = WithoutGroup(other);
  return end == other_end && (group == other_group || group.empty() || other_group.empty());
}

// As much of the path as `search` finds, by its whole path.
std::string WholePath(const PathSearch& search, std::string_view path) {
  for (std::size_t end = path.size(); end != std::string_view::npos && end > 0; end = path.rfind('/', end - 1)) {
    const auto found = search.Find(path.substr(0, end));
    const bool is_there = found && (*found)->parent() != nullptr;
    if (!is_there) continue;
    const auto* const port = dynamic_cast<const Port*>(*found);
    return (port != nullptr ? LastingPath(*port) : (*found)->path()) + std::string(path.substr(end));
  }
  return (path.starts_with('/') ? "" : "/") + std::string(path);
}

// The whole path of what is there and can be such an end.
std::optional<std::string> FindEnd(const PathSearch& search, std::string_view path, PathKind kind) {
  const auto found = search.Find(path, kind);
  const auto* const port = found ? dynamic_cast<const Port*>(*found) : nullptr;
  const bool is_output = port != nullptr && port->direction() == Port::Direction::kOutput;
  if (port != nullptr && (port->is_proxy() || is_output == (kind == PathKind::kOutput))) return LastingPath(*port);
  return found && (*found)->kind() == ElementKind::kParameter ? std::optional((*found)->path()) : std::nullopt;
}

// Whether an input is missing that a connection has to go with.
bool IsOver(Runtime& runtime, const LateConnection& late) {
  return late.is_of_its_input() && !PathSearch(runtime).FindPort(late.to, PathKind::kInput);
}

template <typename IsMeant>
std::vector<const LateConnection*> Waiting(Runtime& runtime, const IsMeant& is_meant) {
  std::vector<const LateConnection*> waiting;
  const LateConnections* const late = LateConnections::FindIn(runtime);
  if (late == nullptr) return waiting;
  for (const LateConnection& each : late->all()) {
    if (each.waits_for && (is_meant(each.from) || is_meant(each.to))) waiting.push_back(&each);
  }
  return waiting;
}

}  // namespace

bool LateConnection::is_of_its_input() const noexcept { return IsDistantPath(from) && !options.when_present; }

std::string LateConnection::SourceText() const { return from + options.PartText(); }

LateConnections& LateConnections::Of(Runtime& runtime) {
  return runtime.root().FindOrAnnotate<LateConnections>(runtime);
}

LateConnections* LateConnections::FindIn(Runtime& runtime) { return runtime.root().FindAnnotation<LateConnections>(); }

struct LateConnections::Ends {
  Port* from = nullptr;
  Port* to = nullptr;
  std::string missing = {};  // which is not there, and why
};

LateConnections::Ends LateConnections::FindEnds(const std::string& from, const std::string& to) const {
  Ends ends;
  const PathSearch search(runtime_);
  const auto find = [&](const std::string& path, PathKind kind) -> Port* {
    const auto found = search.FindPort(path, kind);
    if (found && (*found)->life_cycle() != LifeCycle::kDeleted) return *found;
    if (ends.missing.empty()) {
      const std::string why = found ? "" : found.error().message;
      ends.missing = IsDistantPath(path) && !found ? why : path + (found ? "" : ": " + why);
    }
    return nullptr;
  };
  ends.from = find(from, PathKind::kOutput);
  ends.to = find(to, PathKind::kInput);
  return ends;
}

// Lives as long as the root, and so as the runtime.
LateConnections::LateConnections(Runtime& runtime) : runtime_(runtime) { runtime.AddListener(*this); }

const LateConnection* LateConnections::Find(std::string_view from, std::string_view to) const {
  return FindLate(all_, PathSearch(runtime_), from, to);
}

LateConnection* LateConnections::FindOwn(std::string_view from, std::string_view to) {
  return const_cast<LateConnection*>(Find(from, to));
}

bool LateConnections::Awaits(const Port& input) {
  const LateConnections* const late = FindIn(input.runtime());
  return late != nullptr && std::ranges::any_of(late->all_, [&](const LateConnection& each) {
           return IsSame(each.to, LastingPath(input));
         });
}

Result<void> LateConnections::Add(const std::string& from, const std::string& to, ConnectOptions options) {
  options.when_present = options.when_present || !IsDistantPath(from);
  const Ends ends = FindEnds(from, to);
  if (ends.missing.empty()) return Port::Connect(*ends.from, *ends.to, options);  // notes itself
  return Note(from, to, std::move(options));
}

Result<void> LateConnections::Note(const std::string& from, const std::string& to, ConnectOptions options) {
  options.when_present = options.when_present || !IsDistantPath(from);
  if (Find(from, to) != nullptr) {
    return Error{.message = "is to be connected to " + to + " already", .path = from};
  }
  all_.push_back({IsDistantPath(from) ? from : EndPath(PathSearch(runtime_), from, PathKind::kOutput),
                  EndPath(PathSearch(runtime_), to, PathKind::kInput), std::move(options), FindEnds(from, to).missing});
  must_look_ = true;
  // So that viewers look again.
  runtime_.ForEachListener([](ElementListener&) {});
  return {};
}

void LateConnections::Forget(std::string_view from, std::string_view to) {
  const LateConnection* const found = Find(from, to);
  if (found == nullptr) return;
  all_.erase(all_.begin() + (found - all_.data()));
  runtime_.ForEachListener([](ElementListener&) {});
}

bool LateConnections::Remove(std::string_view from, std::string_view to) {
  const LateConnection* const found = Find(from, to);
  if (found == nullptr) return false;
  const Ends ends = FindEnds(found->from, found->to);
  const bool is_connected = ends.missing.empty() && ends.from->ConnectionTo(*ends.to) != nullptr;
  Forget(from, to);
  if (is_connected) (void)Port::Disconnect(*ends.from, *ends.to);
  return true;
}

void LateConnections::OnReady(FrameworkElement&) {
  must_look_ = true;
  if (!runtime_.is_in_change_scope()) LookAgain();
}

// With an application go the connections that are its own, also if it is one that could not be built.
void LateConnections::OnDeleted(FrameworkElement& element) {
  must_look_ = true;
  if (element.parent() == nullptr || element.parent()->parent() != nullptr) return;
  const std::string begin = element.path() + "/";
  std::erase_if(all_, [&](const LateConnection& each) {
    return each.to.starts_with(begin) && (each.from.starts_with(begin) || IsDistantPath(each.from));
  });
}

void LateConnections::OnConnected(FrameworkElement& from, FrameworkElement& to) {
  const auto& output = dynamic_cast<const Port&>(from);
  const auto& input = dynamic_cast<const Port&>(to);
  const std::string &path = LastingPath(output), &end = LastingPath(input);
  std::erase_if(cuts_, [&](const Cut& cut) { return cut.from == path && cut.to == end; });
  const Connection* const edge = output.ConnectionTo(input);
  LateConnection* const known = FindOwn(path, end);
  if (edge == nullptr || (known == nullptr && !edge->options.when_present)) return;
  if (known == nullptr) {
    all_.push_back({path, end, edge->options, {}});
  } else {
    if (!IsDistantPath(path)) known->from = path;
    known->to = end;
    known->options = edge->options;
    known->waits_for.reset();
    if (known->is_of_its_input()) all_.erase(all_.begin() + (known - all_.data()));
  }
}

void LateConnections::OnDisconnected(FrameworkElement& from, FrameworkElement& to) {
  const std::string& path = LastingPath(dynamic_cast<const Port&>(from));
  const std::string& end = LastingPath(dynamic_cast<const Port&>(to));
  if (FindOwn(path, end) == nullptr) return;
  cuts_.push_back({path, end, from.id(), to.id()});
  must_look_ = true;
  if (!runtime_.is_in_change_scope()) LookAgain();
}

void LateConnections::OnChangesEnd() {
  if (must_look_) Retry([this] { LookAgain(); });
}

// A connection that has been cut while both its ends stay is one that somebody does not want any more.
void LateConnections::LookAgain() {
  const ChangeScope all_at_once(runtime_);  // else it would look again at each input that it makes
  must_look_ = false;
  for (; !cuts_.empty(); cuts_.erase(cuts_.begin())) {
    const Cut& cut = cuts_.front();
    const Ends ends = FindEnds(cut.from, cut.to);
    const bool are_the_same = ends.missing.empty() && ends.from->id() == cut.from_id && ends.to->id() == cut.to_id;
    if (are_the_same && ends.from->ConnectionTo(*ends.to) == nullptr) {
      std::erase_if(all_, [&](const LateConnection& each) { return each.from == cut.from && each.to == cut.to; });
    } else if (LateConnection* const known = FindOwn(cut.from, cut.to)) {
      known->waits_for = ends.missing;
    }
  }
  std::erase_if(all_, [&](const LateConnection& each) { return IsOver(runtime_, each); });
  // By paths: connecting tells this listener, too, and may change the list.
  std::vector<std::pair<std::string, std::string>> waiting;
  for (const LateConnection& each : all_) {
    if (each.waits_for) waiting.emplace_back(each.from, each.to);
  }
  for (const auto& [from, to] : waiting) Try(from, to);
}

void LateConnections::Try(const std::string& from, const std::string& to) {
  LateConnection* const late = FindOwn(from, to);
  if (late == nullptr) return;
  const Ends ends = FindEnds(from, to);
  const std::optional<std::string> before = std::exchange(late->waits_for, ends.missing);
  if (!IsDistantPath(from)) late->from = FindEnd(PathSearch(runtime_), from, PathKind::kOutput).value_or(from);
  late->to = FindEnd(PathSearch(runtime_), to, PathKind::kInput).value_or(to);
  if (!ends.missing.empty()) {
    if (before != ends.missing) runtime_.ForEachListener([](ElementListener&) {});  // so that viewers look again
    return;
  }
  const ConnectOptions options = late->options;
  try {
    const auto connected = Port::Connect(*ends.from, *ends.to, options);
    LateConnection* const tried = FindOwn(from, to);
    if (tried == nullptr) return;
    tried->waits_for.reset();
    if (connected) return;
    const Error& error = connected.error();
    tried->waits_for = error.message + (error.hint.empty() ? "" : "; " + error.hint);
    if (before != tried->waits_for) runtime_.ForEachListener([](ElementListener&) {});
  } catch (...) {
    if (LateConnection* const tried = FindOwn(from, to)) tried->waits_for = DescribeException();
  }
}

std::vector<const LateConnection*> AwaitedBy(const Port& port) {
  return Waiting(port.runtime(), [&](const std::string& end) { return IsSame(end, LastingPath(port)); });
}

std::string EndPath(const PathSearch& search, std::string_view path, PathKind kind) {
  if (auto found = FindEnd(search, path, kind)) return *found;
  const std::size_t name = std::min(path.rfind('/'), path.size());
  return (name == 0 ? "" : WholePath(search, path.substr(0, name))) + std::string(path.substr(name));
}

const LateConnection* FindLate(const std::vector<LateConnection>& all, const PathSearch& search, std::string_view from,
                               std::string_view to) {
  if (all.empty()) return nullptr;
  // Of what is not there the application may have been left out, or not.
  const auto is_end = [&](std::string_view path, PathKind kind) {
    const auto there = FindEnd(search, path, kind);
    return [path, is_there = there.has_value(),
            end = there ? *there : EndPath(search, path, kind)](const std::string& noted) {
      return noted == path || IsSame(noted, end) || (!is_there && IsSame(noted, std::string(path)));
    };
  };
  const auto is_from = is_end(from, PathKind::kOutput), is_to = is_end(to, PathKind::kInput);
  const auto found = std::ranges::find_if(all, [&](const auto& each) { return is_from(each.from) && is_to(each.to); });
  return found == all.end() ? nullptr : &*found;
}

std::vector<LateConnection> AwaitedWith(const std::vector<LateConnection>& all, const FrameworkElement& element) {
  std::vector<LateConnection> awaited;
  if (all.empty()) return awaited;
  const auto* const port = dynamic_cast<const Port*>(&element);
  const std::string& path = port != nullptr ? LastingPath(*port) : element.path();
  const bool is_input = port != nullptr && port->direction() == Port::Direction::kInput;
  std::ranges::copy_if(all, std::back_inserter(awaited), [&](const LateConnection& each) {
    const bool goes_with_it = IsAtOrBelow(each.to, element.path()) || (is_input && IsSame(each.to, path));
    return goes_with_it && each.waits_for && each.is_of_its_input();
  });
  return awaited;
}

std::vector<const LateConnection*> AwaitedBelow(const FrameworkElement& element) {
  const bool is_root = element.parent() == nullptr;
  const std::string begin = is_root ? "/" : element.path() + "/";
  return Waiting(element.runtime(), [&](const std::string& end) { return end.starts_with(begin); });
}

}  // namespace runnel
