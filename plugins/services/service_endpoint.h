#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/channel/subscribers.h"
#include "core/lockfree/bounded_queue.h"
#include "plugins/services/call.h"

namespace runnel {

class Port;

/// Where clients put their calls, and the service takes them out. Its address is the value that a service
/// publishes and its clients read, so that services are connected by what connects ports; it goes with the port's
/// channel to a module that takes the server's place, and the calls that wait go with it.
///
/// Ownership:  the service whose channel it is in. Clients look at it inside an epoch guard only.
/// Threads:    clients push from any thread; one at a time takes out.
struct ServiceEndpoint {
  explicit ServiceEndpoint(std::size_t most_calls) : queue(most_calls) {}

  /// The call that is served next; nullptr: none. Those before it end that nobody waits for any more, or that are from before
  /// a STOP.
  [[nodiscard]] CallBase* Take(Time now, const RobotStop& stop);
  /// All that wait end like that.
  void EndAll(CallStatus status, std::string_view why) noexcept {
    for (CallBase* call = nullptr; queue.TryPop(call);) End(*call, status, why);
  }
  void End(CallBase& call, CallStatus status, std::string_view why) noexcept {
    try {
      call.error = why;
    } catch (...) {  // the status alone says it
    }
    failed.fetch_add(1, std::memory_order_relaxed);
    call.Answer(status);
  }

  /// Somebody is to be woken when there is a call that can be served; `waker` lives until nobody is inside an epoch
  /// guard any more that began before it was taken back. Under the structure lock.
  void SetWaker(Waker* whom) noexcept {
    // acquire: pairs with the release in Wake(). Of both, which change the same word, one comes second: Wake() finds the
    // waker, or this finds the call.
    (void)waker.exchange(whom, std::memory_order_acq_rel);
    if (whom != nullptr && queue.size() > 0) whom->Wake();
  }
  /// There is something to do. Inside an epoch guard. Wait-free, but for waking a thread that sleeps.
  void Wake() noexcept {
    Waker* whom = nullptr;
    // A change, though of nothing. release: pairs with the acquire in SetWaker(): the call is in the queue.
    if (!waker.compare_exchange_strong(whom, nullptr, std::memory_order_acq_rel)) whom->Wake();
  }

  BoundedQueue<CallBase*> queue;
  std::atomic<Waker*> waker{nullptr};
  // relaxed, all: they inform.
  std::atomic<bool> is_faulted{false};
  std::atomic<std::uint64_t> answered{0};
  std::atomic<std::uint64_t> failed{0};
};

/// Whose address the port of a service publishes, or a client's reads; nullptr: none. Inside an epoch guard.
[[nodiscard]] ServiceEndpoint* EndpointAt(const Port& port);

/// Puts the call into the queue: kPending, or why not, and then the call is not under way. Inside an epoch guard, or
/// under the structure lock.
[[nodiscard]] CallStatus BeginCall(ServiceEndpoint* at, CallBase& call, Time now, Duration timeout) noexcept;

/// The value of the port by which a service is connected.
template <typename Signature>
struct ServiceLink {
  ServiceEndpoint* endpoint = nullptr;
};

/// "bool(double)"; `reply` nullptr: "void(double)".
[[nodiscard]] std::string SignatureName(const TypeInfo* reply, const std::vector<const TypeInfo*>& arguments);
template <typename Reply, typename... Arguments>
[[nodiscard]] std::string SignatureName(std::type_identity<Reply(Arguments...)>) {
  const TypeInfo* reply = nullptr;
  if constexpr (!std::is_void_v<Reply>) reply = &TypeOf<Reply>();
  return SignatureName(reply, {&TypeOf<std::remove_cvref_t<Arguments>>()...});
}

template <typename Signature>
void Describe(TypeBuilder<ServiceLink<Signature>>& type) {
  type.Name("service " + SignatureName(std::type_identity<Signature>()));
}

}  // namespace runnel
