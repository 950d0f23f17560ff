#include "plugins/scheduling/internal/cut_report.h"

#include <algorithm>
#include <utility>

#include "core/port/port.h"

namespace runnel::internal {

void ReportCuts(const RunningOrder& order, std::vector<Error>& warnings) {
  for (const Dependency* cut : order.Cuts()) {
    std::vector<PortPair> connections = cut->connections;
    std::ranges::sort(connections, {}, [](const PortPair& each) {
      return std::pair(each.to->id(), each.from->id());
    });
    for (const auto& [from, to] : connections) {
      warnings.push_back(
          {.message = "the data flow runs in a loop, which is cut here: " + to->path() +
                      " reads what " + from->path() + " published one cycle before",
           .path = from->path(),
           .hint = "nothing needs to be done if one cycle of delay is meant to be there"});
    }
  }
}

}  // namespace runnel::internal
