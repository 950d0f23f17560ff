#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "plugins/network/network_element.h"
#include "plugins/ros_services/offered_service.h"
#include "plugins/ros_services/taken_service.h"

namespace runnel {

class DiscoveryTable;
class WakeEvent;

/// The services of an application in the network: those that it offers, and those elsewhere that it calls.
///
/// Threads: all by the network's thread; but Forget() and Text(), under the structure lock.
class NetworkServices {
 public:
  NetworkServices(NetworkElement& element, const DiscoveryTable& table, std::shared_ptr<WakeEvent> wake)
      : element_(element), table_(table), wake_(std::move(wake)) {}

  /// Of the engine; before Follow().
  void set_dialect(ServiceDialect dialect) noexcept { dialect_ = dialect; }
  /// The structure has changed, or who is there. What cannot be is told to `trouble`.
  template <typename Trouble>
  void Follow(WireParticipant& participant, const Trouble& trouble) {
    AddNew();
    for (const auto& each : offered_) {
      const auto followed = each->Follow(participant, [this](std::uint64_t writer) { return IsThere(writer); });
      if (!followed) trouble(each->options().port, followed.error());
      if (const auto error = each->TakeError()) trouble(each->options().port, *error);
    }
    for (const auto& each : taken_) {
      if (const auto followed = each->Follow(participant); !followed) trouble(each->path(), followed.error());
      if (const auto error = each->TakeError()) trouble(each->path(), *error);
    }
  }
  void Forget(const FrameworkElement& element) noexcept;
  /// Calls that are under way end. Before the participant goes.
  void End() noexcept;
  /// When it wants to be called again though nothing wakes.
  std::optional<Time> Work(Time now);
  /// Of its endpoints.
  void AddIds(std::vector<WireId>& readers, std::vector<WireId>& writers) const;
  [[nodiscard]] std::string Text() const;

 private:
  void AddNew();
  [[nodiscard]] bool IsThere(std::uint64_t writer) const;

  NetworkElement& element_;
  const DiscoveryTable& table_;
  const std::shared_ptr<WakeEvent> wake_;
  ServiceDialect dialect_ = ServiceDialect::kInFront;
  std::uint32_t made_ = 0;
  // Changed by the thread, under the structure lock.
  std::vector<std::unique_ptr<OfferedService>> offered_;
  std::vector<std::unique_ptr<TakenService>> taken_;
};

}  // namespace runnel
