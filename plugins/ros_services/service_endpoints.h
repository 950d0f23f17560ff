#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plugins/network_discovery/discovery_table.h"
#include "plugins/network_discovery/writer_clock.h"
#include "plugins/ros_services/service_form.h"
#include "plugins/wire/wire.h"

namespace runnel {

/// Which call a request or a reply belongs to: who calls, and its how manyth call it is.
struct CallId {
  WireId client = {};  ///< of rmw_cyclonedds only the first eight octets
  std::int64_t number = 0;
  std::uint64_t writer = 0;  ///< WireEndpoint::handle of who has sent it, which may be another one when it comes again

  friend bool operator==(const CallId& a, const CallId& b) { return a.client == b.client && a.number == b.number; }
};

/// A request or a reply: which one, and the message as it is without that.
struct ServiceMessage {
  CallId id;
  Octets message;
  Time sent{};  ///< at the earliest, on this machine's steady clock (WriterClock::sent())
};

/// As rmw_cyclonedds has it: the call stands in front of the message. `message`: with the encapsulation, of this machine's order
/// of octets.
[[nodiscard]] Octets WithCallId(const CallId& id, std::span<const std::byte> message);
/// Nothing if the octets, which may be anything, are too short.
[[nodiscard]] std::optional<ServiceMessage> SplitCallId(std::span<const std::byte> octets);

/// How requests and replies say which call they belong to. Nodes of the two do not understand one another.
enum class ServiceDialect {
  kInFront,  ///< in front of the message: rmw_cyclonedds
  kBeside,   ///< beside it, by identities of values (WireEngine::has_identities): rmw_fastrtps
};

/// A service as the wire has it.
struct ServiceTopics {
  std::string service = {};  ///< "/save_map"
  ServiceType request = {};
  ServiceType response = {};
  std::uint32_t depth = 10;  ///< newest requests and replies that are kept
  ServiceDialect dialect = ServiceDialect::kInFront;
  bool is_latched = false;                ///< what is said before the other end has come is heard by it, too
  const DiscoveryTable* table = nullptr;  ///< of who calls; must outlive the ends. nullptr: no server waits for readers

  friend bool operator==(const ServiceTopics&, const ServiceTopics&) = default;
};

/// Two endpoints of one service, of which one sends and the other takes.
///
/// Ownership:  the participant must outlive it.
/// Threads:    one at a time, but for what is told, by threads of the engine; ids and figures any.
class ServiceEndpoints {
 public:
  enum class Side { kServer, kClient };

  /// `on_news` is called when something has come, or somebody has come or gone. `identity`: what nobody else has. Errors:
  /// of the engine.
  static Result<std::unique_ptr<ServiceEndpoints>> Start(Side side, const ServiceTopics& topics,
                                                         WireParticipant& participant, std::uint32_t identity,
                                                         std::function<void()> on_news);

  [[nodiscard]] const ServiceTopics& topics() const noexcept { return topics_; }
  /// Of a client: sends a request; the how manyth of its calls it is.
  Result<std::int64_t> Request(std::span<const std::byte> message);
  /// Of a server. An answer whose reader is not matched yet, as of a client that has just come, is kept for it, for 10 s at
  /// most: SendKept() sends it.
  Result<void> Reply(const CallId& id, std::span<const std::byte> message);
  /// The next request, or reply to this client.
  [[nodiscard]] std::optional<ServiceMessage> Take();
  /// Has `use` called for each that waits now, but for none that comes meanwhile, so that whoever asks, or answers, without end
  /// keeps nobody waiting; then SendKept().
  template <typename Use>
  void TakeWaiting(const Use& use) {
    for (std::size_t left = waiting(); left > 0; --left) {
      if (const auto message = Take()) use(*message);
    }
    SendKept();
  }
  /// How many have come and not been taken.
  [[nodiscard]] std::size_t waiting();
  /// The answers whose readers have been matched meanwhile.
  void SendKept();
  /// Somebody at the other end both takes and sends.
  [[nodiscard]] bool is_matched() const noexcept {
    return readers_.load(std::memory_order_relaxed) > 0 && writers_.load(std::memory_order_relaxed) > 0;
  }
  [[nodiscard]] const WireId& reader_id() const noexcept { return reader_->id(); }
  [[nodiscard]] const WireId& writer_id() const noexcept { return writer_->id(); }
  /// Of more than 128, or ServiceTopics::depth, that wait to be taken the newest are left out and counted, as is what there is no
  /// memory for.
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  ServiceEndpoints(Side side, ServiceTopics topics, std::function<void()> on_news)
      : side_(side), topics_(std::move(topics)), on_news_(std::move(on_news)) {}
  [[nodiscard]] std::optional<ServiceMessage> Read(const WireSample& sample);
  [[nodiscard]] bool IsAwaited(const CallId& id) const;
  [[nodiscard]] bool IsForThis(const CallId& id) const noexcept;
  void Keep(ServiceMessage message);
  Result<std::int64_t> Send(const CallId& id, std::span<const std::byte> message);

  static constexpr std::size_t kMostMessages = 128;
  const Side side_;
  const ServiceTopics topics_;
  const std::function<void()> on_news_;
  std::mutex mutex_;
  std::deque<ServiceMessage> messages_;  // that have come, until somebody takes them; guarded by mutex_
  std::atomic<std::uint64_t> lost_{0};
  std::map<std::uint64_t, WriterClock> clocks_;  // of those that write, by their handles; the engine's thread's own
  std::atomic<std::size_t> readers_{0};
  std::atomic<std::size_t> writers_{0};
  WireId client_{};  // by which a client finds its replies among those of others
  std::int64_t made_ = 0;
  struct KeptReply {
    CallId id;
    Octets message;
    Time since;
  };
  std::vector<KeptReply> kept_;  // whose readers are not matched yet; the thread's own
  std::unique_ptr<WireWriter> writer_;
  std::unique_ptr<WireReader> reader_;
};

}  // namespace runnel
