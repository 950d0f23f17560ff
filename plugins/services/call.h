#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/channel/subscribers.h"
#include "core/element/robot_stop.h"
#include "core/lockfree/wake_event.h"
#include "core/types/type_of.h"
#include "plugins/services/callable.h"

namespace runnel {

/// Why a call is not served that IsFromBefore() a STOP.
inline constexpr const char* kCalledBeforeStop =
    "STOP was pressed or released after this was asked for; look why, then ask again";

/// One call on its way. The caller writes what is asked, and hands it over through the service's queue; the
/// service writes what comes of it, and gives it back by `state`.
///
///     kIdle ──caller──▶ kQueued ──service──▶ kAnswered ──▶ kReturned ──caller──▶ kQueued …
///
/// Nobody but the service touches it from kQueued to kAnswered, but for the atomic members; the service touches
/// nothing after kReturned. A caller that gives up leaves it to the service, and uses it again when it has been
/// returned. Never freed before that (RetireCalls()).
struct CallBase {
  enum class State : std::uint8_t { kIdle, kQueued, kAnswered, kReturned };

  /// The service: this has come of it. Wait-free, but for waking a thread that sleeps on it.
  void Answer(CallStatus outcome) noexcept {
    status = outcome;
    // release: pairs with the acquire in is_answered(): the reply is in place.
    state.store(State::kAnswered, std::memory_order_release);
    answered.Notify();
    WakeCaller();
    // release: pairs with the acquire in is_returned(): the service has let go.
    state.store(State::kReturned, std::memory_order_release);
  }
  [[nodiscard]] bool is_answered() const noexcept { return state.load(std::memory_order_acquire) >= State::kAnswered; }
  [[nodiscard]] bool is_returned() const noexcept {
    const State now = state.load(std::memory_order_acquire);
    return now == State::kReturned || now == State::kIdle;
  }

  /// The caller: it is asked for now.
  void NoteStop(const RobotStop& stop) noexcept;
  /// Whoever takes it out of a queue: STOP was pressed or released since, so it is not known what it would do now. Wait-free.
  [[nodiscard]] bool IsFromBefore(const RobotStop& stop) const noexcept;
  /// A caller that is run by triggers, and waits for it.
  void WakeCaller() noexcept;

  // The caller's, before it is handed over.
  std::uint64_t number = 0;
  Time called_at{};
  Time deadline{};
  const void* endpoint = nullptr;  // to compare with only
  std::int64_t stop_bar = StopSignal::kNever;
  std::uint64_t stop_requests = 0;
  // The service's.
  CallStatus status = CallStatus::kPending;
  std::string error;
  Time begun_at{};
  Time asked_to_end_at{};
  // Anybody's. relaxed: they inform.
  std::atomic<double> progress{0};
  std::atomic<const char*> doing{""};
  std::atomic<bool> is_given_up{false};  // the service should not begin, or end soon
  // Hand-overs.
  std::atomic<State> state{State::kIdle};
  std::atomic<bool> is_held{false};  // by a caller, who has not yet seen what came of it
  WakeEvent answered;
  std::atomic<Waker*> waker{nullptr};  // of the caller's cycle; changed under the structure lock
};

/// The calls that one client can have under way at once.
///
/// Threads: Acquire() and Release() from any.
class CallSlots {
 public:
  virtual ~CallSlots() = default;
  CallSlots(const CallSlots&) = delete;
  CallSlots& operator=(const CallSlots&) = delete;

  /// A call that nobody uses; nullptr if there is none.
  [[nodiscard]] CallBase* Acquire() noexcept;
  /// The caller has seen what came of it, or does not want to know.
  static void Release(CallBase& call) noexcept {
    // release: pairs with the acquire in Acquire(): the next caller writes after this one has read.
    call.is_held.store(false, std::memory_order_release);
  }
  [[nodiscard]] std::size_t size() const noexcept { return calls_.size(); }
  /// Whether no service and no caller has one of them.
  [[nodiscard]] bool is_quiet() const noexcept;
  /// Of those that somebody still waits for: services need not begin.
  void GiveUpAll() noexcept;
  /// Who is woken when one has been answered; nullptr: nobody. Under the structure lock.
  void SetWaker(Waker* waker) noexcept;

 protected:
  CallSlots() = default;
  std::vector<CallBase*> calls_;
};

/// Frees the calls, at once or, if services still have some of them, at a later call of this function. Locks.
void RetireCalls(std::unique_ptr<CallSlots> calls);

namespace internal {
template <std::size_t index, typename T>
struct ArgumentOf {
  T value{};
};
template <typename Indices, typename... T>
struct IndexedArguments;
template <std::size_t... index, typename... T>
struct IndexedArguments<std::index_sequence<index...>, T...> : ArgumentOf<index, T>... {};

template <typename Reply>
struct ReplyOf {
  using Type = Reply;
};
struct NoReply {};
template <>
struct ReplyOf<void> {
  using Type = NoReply;
};
}  // namespace internal

/// What is asked, each argument in its place.
template <typename... Arguments>
using ArgumentPack =
    internal::IndexedArguments<std::index_sequence_for<Arguments...>, std::remove_cvref_t<Arguments>...>;

/// Calls `use(argument...)` with all of them.
template <typename... Arguments, typename Use>
decltype(auto) WithArguments(ArgumentPack<Arguments...>& pack, Use&& use) {
  return [&]<std::size_t... index>(std::index_sequence<index...>)->decltype(auto) {
    return use(static_cast<internal::ArgumentOf<index, std::remove_cvref_t<Arguments>>&>(pack).value...);
  }
  (std::index_sequence_for<Arguments...>());
}

template <typename Reply>
class CallOutcome;

template <typename Signature>
struct Call;
template <typename Reply, typename... Arguments>
struct Call<Reply(Arguments...)> final : CallBase {
  ArgumentPack<Arguments...> arguments;
  typename internal::ReplyOf<Reply>::Type reply{};
  std::function<void(const CallOutcome<Reply>&)> callback;  // the caller's
};

template <typename Signature>
class CallSlotsOf final : public CallSlots {
 public:
  explicit CallSlotsOf(std::size_t count) : slots_(std::make_unique<Call<Signature>[]>(count)) {
    for (std::size_t i = 0; i < count; ++i) calls_.push_back(&slots_[i]);
  }

 private:
  const std::unique_ptr<Call<Signature>[]> slots_;
};

}  // namespace runnel
