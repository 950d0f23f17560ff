// Two masters: who is heard, and that both are.

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

void NetworkLink::TellOwners() {
  for (const auto& each : taken_) {
    const std::string owner = each->Owner();
    std::string& told = owners_[each->output().path()];
    if (owner == told) continue;
    if (owner.empty()) {
      element_.log().Warn("{}: {} has it no more", each->output().path(), told);
    } else {
      element_.log().Info("{}: {} has it now{}", each->output().path(), owner, told.empty() ? "" : " instead of " + told);
    }
    told = owner;
  }
}

}  // namespace runnel
