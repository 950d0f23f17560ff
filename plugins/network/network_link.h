#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/base/clock.h"
#include "core/element/runtime.h"
#include "core/lockfree/wake_event.h"
#include "plugins/network/network_element.h"
#include "plugins/network/offered_port.h"
#include "plugins/network/taken_port.h"
#include "plugins/network_discovery/discovery_table.h"
#include "plugins/network_discovery/structure_topic.h"
#include "plugins/ros_services/offered_service.h"
#include "plugins/ros_services/ros_node.h"
#include "plugins/ros_services/taken_service.h"

namespace runnel {

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
      const auto followed =
          each->Follow(participant, [this](std::uint64_t writer) { return table_.FindWriter(writer).has_value(); });
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

  NetworkElement& element_;
  const DiscoveryTable& table_;
  const std::shared_ptr<WakeEvent> wake_;
  ServiceDialect dialect_ = ServiceDialect::kInFront;
  std::uint32_t made_ = 0;
  // Changed by the thread, under the structure lock.
  std::vector<std::unique_ptr<OfferedService>> offered_;
  std::vector<std::unique_ptr<TakenService>> taken_;
};

/// An application in the network: sends what is offered, takes what is to be taken, and follows both as the structure
/// and those who are there change.
///
/// Ownership:  of engine endpoints and one thread. Application, element and engine must outlive it.
/// Threads:    Start() and destroying outside of cycles, real-time threads and the structure lock; the rest any.
/// Errors:     at the start, told by Start(); later, by the log of the element, once for as long as they last.
class NetworkLink final : private ElementListener {
 public:
  /// `structure` says what others are told of the application, under the structure lock; optional.
  static Result<std::unique_ptr<NetworkLink>> Start(FrameworkElement& application, NetworkElement& element,
                                                    WireEngine& engine, bool is_simulated,
                                                    std::function<std::string()> structure = {}, RosHooks hooks = {});
  ~NetworkLink() override;

  // For what else goes on in the network.
  [[nodiscard]] WireParticipant& participant() noexcept { return *participant_; }
  [[nodiscard]] const DiscoveryTable& table() const noexcept { return table_; }

  /// What `runnel network` shows.
  [[nodiscard]] std::string Text() const;
  /// The same, as the page's protocol has it. Under the structure lock.
  [[nodiscard]] std::string Picture();
  /// What `runnel ls //base/laser` shows: nothing if it has not come yet. Errors: that application has no such element, with
  /// the nearest name.
  [[nodiscard]] Result<std::optional<std::string>> StructureOf(const std::string& path);

 private:
  NetworkLink(FrameworkElement& application, NetworkElement& element, ClockOffset clock);
  struct Wanted;

  void OnReady(FrameworkElement& /*element*/) override { LookAgain(); }
  void OnDeleted(FrameworkElement& element) override;
  void OnConnected(FrameworkElement& from, FrameworkElement& to) override;
  void OnDisconnected(FrameworkElement& from, FrameworkElement& to) override;

  void LookAgain() noexcept;
  // Under the structure lock.
  void NoteRenamed(const std::string& from) noexcept;
  // By the thread.
  void Run() noexcept;
  void SendAll();
  void Follow();
  [[nodiscard]] std::vector<Wanted> FindOffers();
  /// Whether somebody offers what is, or was, at that path, as that topic.
  [[nodiscard]] bool IsMeant(const std::string& path, const OfferOptions& as) const;
  void MakeOffer(const Wanted& wanted);
  void FollowTakes();
  void FollowDistantPorts();
  void TellAwaited(std::string& text) const;
  void FollowNodes();
  void TellNode();
  void TellStructure();
  void TellTroubles();
  void TellMissing();
  void TellMembers();
  [[nodiscard]] bool IsStranger(const WireMember& member) const;
  void TellOwners();
  /// Who write what goes to one input, and are all heard, of which nobody has said that it is meant; "" if that is not so.
  [[nodiscard]] std::string Masters(const TakenPort& taken) const;
  void TellMasters();
  void TellClocks();
  /// Who is at the other end of an endpoint, and why somebody who is there is not.
  struct Partner {
    std::vector<std::string> names = {};
    std::string misfit = {};
  };
  [[nodiscard]] Partner PartnerOf(const WireEndpointOptions& mine, bool is_writer) const;
  void Trouble(const std::string& of, const Error& error);

  FrameworkElement& application_;
  Runtime& runtime_;
  NetworkElement& element_;
  const ClockOffset clock_;
  const std::shared_ptr<WakeEvent> wake_ = std::make_shared<WakeEvent>();
  std::atomic<bool> must_look_{true};
  std::atomic<bool> ends_{false};
  DiscoveryTable table_;
  std::unique_ptr<FrameworkElement> beside_;  // below which the inputs are that values are sent from
  std::unique_ptr<WireParticipant> participant_;
  std::function<std::string()> structure_;
  std::unique_ptr<StructureTopic> structure_topic_;
  std::unique_ptr<RosNode> node_;      // nullptr: none is wanted
  std::unique_ptr<WireReader> nodes_;  // of others, as they say; nullptr until one is there
  NetworkServices services_{element_, table_, wake_};
  // Changed by the thread, under the structure lock.
  std::vector<std::unique_ptr<OfferedPort>> offered_;
  std::vector<std::unique_ptr<TakenPort>> taken_;
  // The thread's own.
  std::uint64_t made_ = 0;
  const Time began_ = SteadyClock().Now();
  Time next_look_{};                                 // for what has gone wrong
  Time follows_from_{};                              // not before, as something has failed
  std::map<std::string, std::string> troubles_;      // by whom they are, as they have been told
  std::map<std::string, std::string> new_troubles_;  // as they are now
  std::map<WireId, std::string> members_;
  std::map<WireId, Time> strangers_;                         // since when they are there
  std::map<std::string, Time> missing_;                      // topics that who should write them does not: since when
  bool is_missing_young_ = false;                            // some of them are to be looked at again soon
  std::set<WireId> other_clocks_;                            // of members whose clock is another one, as has been told
  std::map<std::string, TakenPort::WriterInCharge> owners_;  // of outputs that listen to one writer only
  std::thread thread_;
};

}  // namespace runnel
