#include "plugins/wire/wire.h"

namespace runnel {

std::string QosMisfit(const WireQos& offered, const WireQos& asked) {
  if (asked.is_reliable && !offered.is_reliable) {
    return "the writer sends at best effort, and the reader asks for reliable values";
  }
  if (asked.is_latched && !offered.is_latched) {
    return "the writer keeps nothing for who comes late, and the reader asks for it (latched)";
  }
  if (asked.is_exclusive != offered.is_exclusive) {
    return offered.is_exclusive ? "the writer wants to be the only one that counts, and the reader takes all"
                                : "the reader takes the strongest only, and the writer says no strength";
  }
  return {};
}

std::string QosText(const WireQos& qos) {
  std::string text = qos.is_reliable ? "reliable" : "best effort";
  if (qos.is_latched) text += ", latched";
  if (qos.is_exclusive) text += qos.strength > 0 ? ", exclusive by strength " + std::to_string(qos.strength) : ", exclusive";
  return text + ", newest " + std::to_string(qos.depth);
}

Result<WireIdentity> WireWriter::WriteRelated(const std::shared_ptr<const Octets>&, std::int64_t, const WireIdentity&) {
  return Error{.message = "the network's engine cannot say to which other value one is related", .hint = "engine=\"fast\""};
}

}  // namespace runnel
