#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "plugins/wire/wire.h"

namespace runnel {

/// What a member says of itself, so that those who share this machine's memory with it know each other: same machine since
/// it was started, same network, same user. "shared_memory=0123456789abcdef;".
[[nodiscard]] std::string MemoryOfThisProcess();
/// What a member says besides.
[[nodiscard]] std::string WithoutMemory(std::string user_data);

/// Who reads which topic, and whether it shares this process's memory.
///
/// Threads: any.
class Neighbours {
 public:
  explicit Neighbours(std::string memory) : memory_(std::move(memory)) {}

  void Add(const WireMember& member);
  void RemoveMember(const WireId& id);
  void Add(const WireEndpoint& endpoint);
  void RemoveEndpoint(const WireId& id);

  /// Whether there are `matched` readers of the topic at least, and all that there are share the memory.
  [[nodiscard]] bool AllShare(const std::string& topic, std::size_t matched) const;
  /// Whether it is known of a writer that it is there.
  [[nodiscard]] bool IsThere(std::uint64_t writer) const;

 private:
  const std::string memory_;
  mutable std::mutex mutex_;
  std::set<WireId> sharing_;  // members
  std::map<WireId, WireEndpoint> endpoints_;
};

}  // namespace runnel
