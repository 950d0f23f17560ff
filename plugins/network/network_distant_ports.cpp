// What the thread of a network does for "//robot/pose.x" when others come and tell what they have.

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/element/runtime.h"
#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "plugins/network/network_link.h"
#include "plugins/network/network_ports.h"

namespace runnel {

namespace {

std::vector<LateConnection> Awaited(Runtime& runtime) {
  std::vector<LateConnection> awaited;
  const LateConnections* const late = LateConnections::FindIn(runtime);
  if (late == nullptr) return awaited;
  for (const LateConnection& each : late->all()) {
    if (each.waits_for && IsDistantPath(each.from)) awaited.push_back(each);
  }
  return awaited;
}

/// Outputs that have been taken out of the tree: destroyed when the lock is free again.
struct GoneOutputs {
  Runtime& runtime;
  std::vector<UnlistedElement> all = {};

  ~GoneOutputs() {
    std::erase_if(all, [](const UnlistedElement& each) { return !each; });
    runtime.Destroy(std::move(all));
  }
};

}  // namespace

void NetworkLink::FollowDistantPorts() {
  std::vector<std::unique_ptr<TakenPort>> before;  // to go without the lock
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    const NetworkPorts* const ports = NetworkPorts::Of(element_);
    if (ports == nullptr) return;
    bool is_any_due = !Awaited(runtime_).empty();
    for (const NetworkElement::Take& each : element_.takes()) {
      std::string why_not;
      const bool is_due = ports->OtherType(each, why_not).has_value();
      if (!why_not.empty()) Trouble(each.output->path(), {.message = "has values of another type there: " + why_not});
      is_any_due = is_any_due || is_due;
      const auto reader = std::ranges::find(taken_, each.output, [](const auto& one) { return &one->output(); });
      if (!is_due || reader == taken_.end()) continue;
      before.push_back(std::move(*reader));
      taken_.erase(reader);
    }
    if (!is_any_due) return;
  }
  before.clear();  // from now on nothing publishes there
  {
    GoneOutputs gone{runtime_};
    const ChangeScope changes(runtime_);
    NetworkPorts* const ports = NetworkPorts::Of(element_);
    if (ports == nullptr) return;  // the lock has been free
    const std::vector<NetworkElement::Take> takes = element_.takes();
    for (const NetworkElement::Take& each : takes) {
      const bool is_read = std::ranges::any_of(taken_, [&](const auto& one) { return &one->output() == each.output; });
      std::string why_not;
      const auto type = is_read ? std::nullopt : ports->OtherType(each, why_not);
      if (!type) continue;
      const std::string path = each.output->path();
      const auto renewed = ports->Renew(*each.output, *type, gone.all.emplace_back());
      if (!renewed) Trouble(path, renewed.error());
    }
    for (const LateConnection& each : Awaited(runtime_)) {
      if (const auto made = ports->MakeAwaited(each.from); !made) Trouble(each.to, made.error());
    }
    if (LateConnections* const late = LateConnections::FindIn(runtime_)) late->LookAgain();
  }
  const std::lock_guard lock(runtime_.structure_mutex());
  for (const LateConnection& each : Awaited(runtime_)) Trouble(each.to, {.message = "waits for " + each.SourceText() + ": " + *each.waits_for});
}

void NetworkLink::TellAwaited(std::string& text) const {
  for (const LateConnection& each : Awaited(runtime_)) text += "waits for " + each.SourceText() + " to " + each.to + ": " + *each.waits_for + "\n";
}

}  // namespace runnel
