#include "plugins/network_discovery/node_names.h"

#include <algorithm>

#include "core/base/printable.h"
#include "plugins/cdr_values/cdr_reader.h"

namespace runnel {

std::optional<NodesOfMember> ReadNodes(std::span<const std::byte> octets) {
  constexpr std::size_t kHeader = 4, kId = sizeof(WireId), kFill = 8;  // which follows an id up to Humble, and is 0
  NodesOfMember nodes;
  auto from = CdrReader::Begin(octets);
  if (!from || !from->GetPlain(nodes.member.data(), 1, kId)) return {};
  // From Iron on that is where the count of nodes is, and the size of the first one's name; without nodes there is less.
  const auto behind = octets.subspan(kHeader + kId);
  const bool has_fill = behind.size() > kFill && std::ranges::all_of(behind.first(kFill), [](std::byte each) { return each == std::byte{0}; });
  if (has_fill && !from->Skip(1, kFill)) return {};
  const auto count = from->GetCount(1);
  for (std::size_t i = 0; count && i < *count; ++i) {
    std::string name_space, name;
    if (!from->GetText(name_space) || !from->GetText(name)) return {};
    nodes.names += (i > 0 ? ", " : "") + Printable(name_space.ends_with('/') ? name_space + name : name_space + "/" + name);
    for (int lists = 0; lists < 2; ++lists) {  // of its readers, and of its writers
      const auto ids = from->GetCount(kId);
      if (!ids || !from->Skip(1, *ids * (has_fill ? kId + kFill : kId))) return {};
    }
  }
  return count ? std::optional(std::move(nodes)) : std::nullopt;
}

}  // namespace runnel
