// Several writers: who is heard, that both are, and whose clock is another one.

#include <set>

#include "plugins/network/network_link.h"

namespace runnel {

// Under one name is also who has been killed and started again: of such it is told once values of both come.
std::string NetworkLink::Masters(TakenPort& taken) const {
  const WireEndpointOptions endpoint = taken.endpoint();
  if (taken.options().is_exclusive || endpoint.qos.is_exclusive) return {};
  std::set<std::string> names;
  std::string all;
  for (const WireEndpoint& other : table_.Partners(endpoint.topic, true)) {
    if (!Misfit(other.options, endpoint).empty()) continue;
    const std::string name = table_.NameOf(other.participant);
    names.insert(name);
    all += (all.empty() ? "" : " and ") + name;
  }
  const bool come_in_turn = taken.AskWhetherTheyComeInTurn();
  return names.size() > 1 || come_in_turn ? all + " write it, and all of them are heard" : "";
}

void NetworkLink::TellMasters() {
  for (const auto& each : taken_) {
    const std::string masters = Masters(*each);
    if (masters.empty()) continue;
    const char* const exclusive = "say <take … exclusive=\"true\"/> if one is enough";
    Trouble(each->output().path(), {.message = masters, .hint = each->options().is_distant ? "end one of them" : exclusive});
  }
}

// Once of each: how far they are apart changes.
void NetworkLink::TellClocks() {
  for (const auto& each : taken_) {
    if (!each->options().keeps_stamps) continue;
    for (const WireEndpoint& other : table_.Partners(each->endpoint().topic, true)) {
      const Duration delay = each->least_delay(other.handle).value_or(Duration{});
      const bool is_old = delay > WriterClock::kMostOfNetworks && !each->endpoint().qos.is_latched;
      const bool is_ahead = -delay > WriterClock::kMostOfNetworks;
      if ((!is_old && !is_ahead) || !other_clocks_.insert(other.participant).second) continue;
      const std::string name = table_.NameOf(other.participant);
      const double seconds = ToSeconds(std::chrono::abs(delay));
      if (is_old) {
        element_.log().Warn("values of {} are {:.3f} s old when they come, by both clocks: if nothing holds them up, its clock is "
                            "behind this one's; synchronise the clocks (chrony, ptp4l)", name, seconds);
      } else {
        element_.log().Warn("the clock of {} is {:.3f} s ahead of this one's: ages of its values are counted from when the soonest "
                            "came; synchronise the clocks (chrony, ptp4l)", name, seconds);
      }
    }
  }
}

void NetworkLink::TellOwners() {
  for (const auto& each : taken_) {
    TakenPort::WriterInCharge owner = each->Owner();
    TakenPort::WriterInCharge& told = owners_[each->output().path()];
    if (owner.handle == told.handle && owner.name == told.name) continue;
    if (owner.name.empty()) {
      element_.log().Warn("{}: {} has it no more", each->output().path(), told.name);
    } else {
      element_.log().Info("{}: {} has it now{}", each->output().path(), owner.name, told.name.empty() ? "" : " instead of " + told.name);
    }
    told = std::move(owner);
  }
}

}  // namespace runnel
