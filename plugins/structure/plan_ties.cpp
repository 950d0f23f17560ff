// Connections of a change set.

#include <memory>
#include <optional>

#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

Result<void> Plan::CheckLateTie(const std::string& from_path, const std::string& to,
                                const std::optional<ConnectOptions>& wanted) {
  const auto [from, part] = SplitPortPath(from_path);
  const LateConnection* const known = overlay_.FindLate(from, to);
  if (wanted.has_value() == (known != nullptr)) {
    return Error{.message = wanted ? "is to be connected to " + to + " already" : "is not connected to " + to,
                 .path = from};
  }
  std::optional<ConnectOptions> next = wanted;
  if (next && next->part.empty()) next->part = part;
  const std::optional<ConnectOptions> before = known != nullptr ? std::optional(known->options) : std::nullopt;
  const auto tie = [this, from = from, to](const std::optional<ConnectOptions>& options) -> Result<void> {
    LateConnections& all = LateConnections::Of(runtime_);
    if (options) return all.Note(from, to, *options);
    if (all.Remove(from, to)) return {};
    return Error{.message = "is not connected to " + to, .path = from};
  };
  if (wanted) {
    overlay_.ConnectLate(from, to, *next);
  } else {
    (void)overlay_.DisconnectLate(from, to);
  }
  auto is_done = std::make_shared<bool>(false);
  steps_.push_back({[=] {
                      auto tied = tie(next);
                      *is_done = tied.has_value();
                      return tied;
                    },
                    [=] {
                      if (*is_done) Must(tie(before));
                      *is_done = false;
                    },
                    [=, from = from](auto&) -> ChangeSet {
                      if (next) return {DisconnectPorts{from, to}};
                      return {ConnectPorts{from, to, *before}};
                    }});
  return {};
}

Result<void> Plan::TieAgain(const ConnectPorts& tie) {
  auto tied = CheckTie(tie.from, tie.to, tie.options);
  const auto to = overlay_.FindPort(tie.to, PathKind::kInput);
  if (tied || !to || !(tie.options.when_present || IsDistantPath(tie.from))) return tied;
  const auto from = overlay_.FindPortPart(tie.from, PathKind::kOutput);
  if (from && Port::CheckEnds(*from->port, **to, tie.options)) return tied;
  // It has been noted all the time where but an end of it had gone.
  if (overlay_.FindLate(SplitPortPath(tie.from).path, tie.to) != nullptr) return {};
  return CheckLateTie(tie.from, tie.to, tie.options);
}

Result<void> Plan::CheckTie(const std::string& from_path, const std::string& to_path,
                            const std::optional<ConnectOptions>& asked) {
  const auto found_to = overlay_.FindPort(to_path, PathKind::kInput);
  if (asked && found_to) {
    if (auto brought = BringDistantPort(from_path, **found_to, *asked); !brought) return brought;
  }
  const auto found_from = overlay_.FindPortPart(from_path, PathKind::kOutput);
  const bool are_there = found_from && found_to;
  const bool may_wait = asked && (asked->when_present || (found_to && IsDistantPath(from_path)));
  if (!are_there && may_wait && found_to && IsDistantPath(from_path)) {
    warnings_.push_back(
        {.message = "waits for " + from_path + ": " + found_from.error().message, .path = (*found_to)->path()});
  }
  if (!are_there && may_wait) return CheckLateTie(from_path, to_path, asked);
  if (!asked) {
    const std::string from = found_from ? found_from->port->path() : SplitPortPath(from_path).path;
    const LateConnection* const known = overlay_.FindLate(from, to_path);
    if (known != nullptr && known->waits_for) return CheckLateTie(from_path, to_path, asked);
  }
  if (!found_from) return found_from.error();
  if (!found_to) return found_to.error();
  const DistantPorts* const distant = asked && IsDistantPath(from_path) ? DistantPorts::FindIn(**found_to) : nullptr;
  if (distant != nullptr) {
    const DistantType told = distant->TypeOf(SplitPortPath(from_path).path);
    if (told.type == nullptr)
      warnings_.push_back({.message = "waits for " + from_path + ": " + told.why_not, .path = (*found_to)->path()});
  }
  std::optional<ConnectOptions> wanted = asked;
  if (wanted && !found_from->part.empty()) wanted->part = found_from->part;
  return CheckTie(*found_from->port, **found_to, wanted);
}

Result<void> Plan::CheckTie(Port& from, Port& to, const std::optional<ConnectOptions>& wanted, bool stays_cut) {
  auto possible = wanted ? overlay_.Connect(from, to, *wanted) : overlay_.Disconnect(from, to, stays_cut);
  if (!possible) return possible;
  Concern(from);
  Concern(to);
  const auto tie = [&from, &to, stays_cut](const std::optional<ConnectOptions>& options) {
    if (options && options->when_present) (void)LateConnections::Of(from.runtime());
    auto tied = options ? Port::Connect(from, to, *options) : Port::Disconnect(from, to);
    LateConnections* const late = LateConnections::FindIn(from.runtime());
    if (tied && !options && stays_cut && late != nullptr) late->Forget(from.path(), to.path());
    return tied;
  };
  struct Done {
    std::optional<ConnectOptions> before;  // of a connection that is cut
    bool is_done = false;
  };
  auto done = std::make_shared<Done>();
  steps_.push_back({[=, &from, &to] {
                      if (!wanted) done->before = from.OptionsTo(to);
                      auto tied = tie(wanted);
                      done->is_done = tied.has_value();
                      return tied;
                    },
                    [=] {
                      if (done->is_done) Must(tie(done->before));
                      done->is_done = false;
                    },
                    [=, &from, &to](auto&) -> ChangeSet {
                      if (wanted) return {DisconnectPorts{LastingPath(from), LastingPath(to)}};
                      return {ConnectPorts{LastingPath(from), LastingPath(to), from.OptionsTo(to)}};
                    }});
  return {};
}

}  // namespace runnel::internal
