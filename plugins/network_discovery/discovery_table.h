#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plugins/wire/wire.h"

namespace runnel {

/// On which each member of ROS 2 tells of its nodes.
inline constexpr const char* kNodesTopic = "ros_discovery_info";
inline constexpr const char* kNodesType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";

/// Who is in the network, with all that they write and read. Their texts are kept as Printable().
///
/// Threads: any.
class DiscoveryTable final : public WireDiscovery {
 public:
  /// `on_change` is called, without a lock, after each change. It throws nothing.
  explicit DiscoveryTable(std::function<void()> on_change) : on_change_(std::move(on_change)) {}

  void OnMember(const WireMember& member) override;
  void OnMemberGone(const WireId& id) override;
  void OnEndpoint(const WireEndpoint& endpoint) override;
  void OnEndpointGone(const WireId& id) override;
  void OnRefused(const std::string& why) override;
  void OnMissed() noexcept override;
  /// What a member that is there says on kNodesTopic, which may be anything.
  void OnNodes(std::span<const std::byte> octets);

  [[nodiscard]] std::vector<WireMember> members() const;
  /// Why some have not been let in, each reason once, the first few.
  [[nodiscard]] std::vector<std::string> refusals() const;
  /// Whether somebody has been there whom there was no memory to note: from then on not all may be known.
  [[nodiscard]] bool has_missed() const noexcept { return has_missed_.load(std::memory_order_relaxed); }
  /// Others' and own ones.
  [[nodiscard]] std::vector<WireEndpoint> endpoints() const;
  /// Of others, of the other direction.
  [[nodiscard]] std::vector<WireEndpoint> Partners(const std::string& topic, bool writers) const;
  [[nodiscard]] std::optional<WireEndpoint> FindWriter(std::uint64_t handle) const;
  /// Its name; of a member of ROS 2, which may all be called "/" or nothing, those of its nodes; "somebody" if it has none.
  [[nodiscard]] std::string NameOf(const WireId& member) const;
  /// Its name, if it says that it is an application of Runnel; else "". All nodes of ROS 2 may have one name.
  [[nodiscard]] std::string ApplicationName(const WireId& member) const;
  /// Whether it says that its time is simulated.
  [[nodiscard]] bool HasSimulatedTime(const WireId& member) const;

 private:
  template <typename Do>
  void Change(const Do& change);
  [[nodiscard]] WireMember FindMember(const WireId& id) const;  // without a name, if it has gone

  const std::function<void()> on_change_;
  mutable std::mutex mutex_;
  std::map<WireId, WireMember> members_;
  std::map<WireId, WireEndpoint> endpoints_;
  std::map<WireId, std::string> nodes_;  // their names, by their members
  std::vector<std::string> refusals_;
  std::atomic<bool> has_missed_{false};
};

/// What a member with simulated time says of itself, among other things.
inline constexpr const char* kSimulatedTime = "clock=simulated;";

/// What an application of Runnel says of itself.
inline constexpr const char* kIsApplication = "runnel=application;";

/// "commands=set,swap;": what one allows others, said by itself.
inline constexpr const char* kAllowedCommands = "commands=";

/// Whether a topic is one of those that applications talk to each other by, and no port's.
[[nodiscard]] bool IsInternalTopic(std::string_view topic);

/// Of what a reader and a writer of one topic have in common, what keeps them from being matched; "" if they are.
/// `reader_data` and the like are what both say of their types.
[[nodiscard]] std::string Misfit(const WireEndpointOptions& writer, const WireEndpointOptions& reader);

}  // namespace runnel
