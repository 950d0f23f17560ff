#include "plugins/wire/wire.h"

#include <algorithm>

namespace runnel {

std::string OtherPolicies::Unmet(bool is_writer) const {
  const auto is_ours = [](const std::string& name) { return name.find_first_not_of('*') == std::string::npos; };
  std::string text;
  const auto add = [&](bool is_unmet, const std::string& what) {
    if (is_unmet) text += (text.empty() ? "" : ", ") + what;
  };
  const bool is_elsewhere = !partitions.empty() && std::ranges::none_of(partitions, is_ours);
  add(is_elsewhere, is_elsewhere ? "the partition '" + partitions.front() + "'" : "");
  // A writer has the first of those that it says, a reader takes any.
  const auto end = is_writer && !representations.empty() ? representations.begin() + 1 : representations.end();
  add(!representations.empty() && std::find(representations.begin(), end, 0) == end, "XCDR2");
  add(!is_writer && has_deadline, "a deadline");
  add(!is_writer && (liveliness > 0 || has_lease), "a liveliness");
  add(!is_writer && durability > 1, "values that outlive their writer (durability)");
  return text;
}

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

Error WithPermissionHint(Error error, bool has_keys, const WireEndpointOptions& options, bool is_writer) {
  const std::string tag = is_writer ? "publish>" : "subscribe>";
  if (!has_keys || !error.hint.empty()) return error;
  error.hint = "permissions.xml, signed anew, is to have <" + tag + "<topics><topic>" + options.topic +
               "</topic></topics></" + tag;
  return error;
}

std::string QosText(const WireQos& qos) {
  std::string text = qos.is_reliable ? "reliable" : "best effort";
  if (qos.is_latched) text += ", latched";
  if (qos.is_exclusive)
    text += qos.strength > 0 ? ", exclusive by strength " + std::to_string(qos.strength) : ", exclusive";
  return text + ", newest " + std::to_string(qos.depth);
}

Result<WireIdentity> WireWriter::WriteRelated(const std::shared_ptr<const Octets>&, std::int64_t, const WireIdentity&) {
  return Error{.message = "the network's engine cannot say to which other value one is related",
               .hint = "engine=\"fast\""};
}

}  // namespace runnel
