#include "plugins/ros_services/service_messages.h"

#include "plugins/cdr_values/cdr_reader.h"
#include "plugins/cdr_values/cdr_writer.h"

namespace runnel {

namespace {

// Of eight octets each: what follows is aligned as without it.
constexpr std::size_t kIdSize = sizeof(CallId::client) + sizeof(CallId::number);

}  // namespace

Octets WithCallId(const CallId& id, std::span<const std::byte> message) {
  Octets octets;
  CdrWriter writer(octets);
  writer.Put(id.client);
  writer.Put(id.number);
  const auto rest = message.subspan(std::min(message.size(), CdrWriter::kHeader));
  octets.insert(octets.end(), rest.begin(), rest.end());
  return octets;
}

std::optional<ServiceMessage> SplitCallId(std::span<const std::byte> octets) {
  ServiceMessage split;
  auto reader = CdrReader::Begin(octets);
  if (!reader || !reader->Get(split.id.client) || !reader->Get(split.id.number)) return {};
  const auto header = octets.first(CdrWriter::kHeader), rest = octets.subspan(CdrWriter::kHeader + kIdSize);
  split.message.assign(header.begin(), header.end());
  split.message.insert(split.message.end(), rest.begin(), rest.end());
  return split;
}

}  // namespace runnel
