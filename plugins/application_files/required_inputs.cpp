#include "plugins/application_files/required_inputs.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/element/source_place.h"
#include "core/paths/late_connections.h"
#include "core/port/port.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

constexpr std::size_t kMostOutputsNamed = 3;

std::string Hint(const Port& input, FrameworkElement& application) {
  std::vector<std::string> outputs;
  application.Visit([&](FrameworkElement& element) {
    const auto* const port = dynamic_cast<const Port*>(&element);
    if (port == nullptr || port->is_proxy()) return;
    if (port->direction() != Port::Direction::kOutput || &port->type() != &input.type()) return;
    if (outputs.size() < kMostOutputsNamed) outputs.push_back(port->path());
  });
  const std::string type = input.type().name();
  if (outputs.empty()) return "the application has no output of type " + type;
  std::string hint = "connect it to an output of type " + type + ", like ";
  for (std::size_t i = 0; i < outputs.size(); ++i) hint += (i > 0 ? ", " : "") + outputs[i];
  return hint;
}

}  // namespace

void CheckRequiredInputs(FrameworkElement& application, BuildContext& context) {
  std::vector<Port*> unconnected;
  application.Visit([&](FrameworkElement& element) {
    auto* const port = dynamic_cast<Port*>(&element);
    if (port == nullptr || !port->is_required() || !port->Sources().empty()) return;
    if (LateConnections::Awaits(*port)) return;
    if (context.IsUnfedUnnoticed(*port)) unconnected.push_back(port);
  });
  for (Port* port : unconnected) {
    context.Report({.message = "nothing is connected to this input, which its module requires",
                    .hint = Hint(*port, application)},
                   FindSourcePlace(*port), *port);
  }
}

}  // namespace runnel
