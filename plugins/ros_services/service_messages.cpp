#include "plugins/ros_services/service_messages.h"

#include <algorithm>
#include <cstring>

#include "plugins/cdr_values/cdr_reader.h"
#include "plugins/cdr_values/cdr_writer.h"

namespace runnel {

namespace {

// Of eight octets each: what follows is aligned as without it.
constexpr std::size_t kIdSize = sizeof(std::uint64_t) + sizeof(CallId::number);

}  // namespace

Octets WithCallId(const CallId& id, std::span<const std::byte> message) {
  Octets octets;
  CdrWriter writer(octets);
  std::uint64_t client;
  std::memcpy(&client, id.client.data(), sizeof client);
  writer.Put(client);
  writer.Put(id.number);
  const auto rest = message.subspan(std::min(message.size(), CdrWriter::kHeader));
  octets.insert(octets.end(), rest.begin(), rest.end());
  return octets;
}

std::optional<ServiceMessage> SplitCallId(std::span<const std::byte> octets) {
  ServiceMessage split;
  auto reader = CdrReader::Begin(octets);
  std::uint64_t client = 0;
  if (!reader || !reader->Get(client) || !reader->Get(split.id.number)) return {};
  std::memcpy(split.id.client.data(), &client, sizeof client);
  const auto header = octets.first(CdrWriter::kHeader), rest = octets.subspan(CdrWriter::kHeader + kIdSize);
  split.message.assign(header.begin(), header.end());
  split.message.insert(split.message.end(), rest.begin(), rest.end());
  return split;
}

}  // namespace runnel
