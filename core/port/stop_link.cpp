#include "core/port/stop_link.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/conversion/number_conversion.h"
#include "core/element/runtime.h"
#include "core/lockfree/thread_epoch.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "core/types/type_of.h"

namespace runnel::internal {

namespace {

// Visits the numbers that the value is made of; false: a part of it is none.
bool ForEachNumber(const TypeInfo& type, void* value, const auto& visit) {
  const auto visit_part = [&](const TypeInfo& part, void* at) { return ForEachNumber(part, at, visit); };
  const ElementOperations& elements = type.elements();
  switch (type.kind()) {
    case TypeKind::kLeaf:
      if (!IsNumber(type) || &type == &TypeOf<bool>()) return false;
      visit(type, value);
      return true;
    case TypeKind::kStructure:
      return std::ranges::all_of(type.fields(),
                                 [&](const FieldInfo& field) { return visit_part(*field.type, field.address(value)); });
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      for (std::size_t i = 0; elements.is_fixed && i < elements.rows(value) * elements.columns(value); ++i) {
        if (!visit_part(*elements.type, elements.element(value, i))) return false;
      }
      return elements.is_fixed;
    default:
      return false;
  }
}

}  // namespace

constexpr std::size_t kInlinedBytes = 32;  // as kIsInlined
// Whoever has not read for longer than this does not move by what it has read.
constexpr Duration kFollows = std::chrono::milliseconds(500);

// relaxed, all of it: numbers of two values that two threads read at the same time may mix.
struct StopLink::Braking {
  static constexpr std::int64_t kNotBegun = std::numeric_limits<std::int64_t>::max();
  static constexpr std::int64_t kIsOver = std::numeric_limits<std::int64_t>::min() / 2;

  explicit Braking(std::size_t numbers) : last(numbers) {}

  std::vector<std::atomic<double>> last;     // what was read, and came from no stop
  std::atomic<std::int64_t> last_stamp{0};   // ns, of what was read
  std::atomic<std::int64_t> last_read{0};    // ns, when it was
  std::atomic<std::int64_t> begun{kIsOver};  // ns
  std::atomic<double> rest{0};               // at the last read
  std::atomic<std::uint64_t> changes{0};     // of it
  std::atomic<bool> is_possible{true};
};

StopLink::StopLink(PassedStop stop, std::unique_ptr<ChannelBase> channel, const Runtime& runtime)
    : stop_(std::move(stop)),
      channel_(std::move(channel)),
      runtime_(runtime),
      braking_(stop_.stop->brake() > Duration{} ? MakeBraking(stop_.safe_value, *channel_) : nullptr) {
  Publish();
  const auto look = [this, seen = std::make_shared<std::atomic<std::int64_t>>(stop_.stop->bar())] {
    if (braking_) (void)Rest(runtime_.clock().Now());
    // Also if it has been released meanwhile, or just counts from now on; not by the release of what was told.
    const std::int64_t bar = stop_.stop->bar();
    const std::int64_t before = seen->exchange(bar);
    if (bar == StopSignal::kInForce || (before != StopSignal::kInForce && bar != before)) Publish();
  };
  if (stop_.stop->robot()) robot_ = stop_.stop->robot()->Listen(look);
  block_ = stop_.stop->block()->Listen(look);
  // A press between the two has published; one from before has to be told of.
  if (!stop_.stop->in_force()) link_.taken = 1;
}

StopLink::~StopLink() { End(); }

bool StopLink::Is(const PassedStop& stop) const {
  const AnyValue& own = stop_.safe_value;
  if (stop_.stop != stop.stop || &own.type() != &stop.safe_value.type()) return false;
  if (own.get() == stop.safe_value.get()) return true;
  return own.type().is_transparent() && ToText(own.type(), own.get()) == ToText(own.type(), stop.safe_value.get());
}

std::unique_ptr<StopLink::Braking> StopLink::MakeBraking(const AnyValue& safe_value, const ChannelBase& channel) {
  std::size_t numbers = 0;
  const auto count = [&](const TypeInfo&, void*) { ++numbers; };
  const bool is_of_numbers = ForEachNumber(safe_value.type(), ForLooking(safe_value.get()), count);
  // Larger ones are read where they lie, and cannot be changed there.
  const bool is_inlined = channel.gives_copies() && safe_value.type().size() <= kInlinedBytes;
  return is_of_numbers && is_inlined ? std::make_unique<Braking>(numbers) : nullptr;
}

bool StopLink::CanBrake(const AnyValue& safe_value, const ChannelBase& channel) {
  return MakeBraking(safe_value, channel) != nullptr;
}

bool StopLink::is_braking() const noexcept { return braking_ && braking_->rest.load(std::memory_order_relaxed) > 0; }

// How much of the way is left: 1 to 0. A release ends it.
double StopLink::Rest(Time now) noexcept {
  const std::int64_t time = now.time_since_epoch().count();
  std::int64_t since = Braking::kNotBegun;
  if (!stop_.stop->in_force()) {
    braking_->begun.store(Braking::kIsOver, std::memory_order_relaxed);
    return 0;
  }
  const bool follows = time - braking_->last_read.load(std::memory_order_relaxed) <= kFollows.count();
  const std::int64_t begun = follows ? time : Braking::kIsOver;
  if (braking_->begun.compare_exchange_strong(since, begun, std::memory_order_relaxed)) return follows ? 1 : 0;
  const double whole = static_cast<double>(stop_.stop->brake().count());
  return std::clamp(1 - static_cast<double>(time - since) / whole, 0.0, 1.0);
}

void StopLink::Brake(void* value, Publication& publication) noexcept {
  // Within a cycle there is one value on the way: a module that takes whatever is new would go on until it stands.
  const Cycle* const cycle = CurrentCycle();
  const Time now = cycle != nullptr ? cycle->now : runtime_.clock().Now();
  const double rest = Rest(now);
  if (braking_->rest.exchange(rest, std::memory_order_relaxed) != rest) {
    braking_->changes.fetch_add(1, std::memory_order_relaxed);
  }
  publication.sequence += braking_->changes.load(std::memory_order_relaxed);
  if (rest == 0) return;
  // What was old when it was read last has not become a fresh command by the STOP.
  const std::int64_t time = now.time_since_epoch().count();
  publication.timestamp =
      braking_->last_stamp.load(std::memory_order_relaxed) + time - braking_->begun.load(std::memory_order_relaxed);
  publication.publication_time = time;
  std::size_t i = 0;
  (void)ForEachNumber(stop_.safe_value.type(), value, [&](const TypeInfo& type, void* number) {
    const double safe = NumberIn(type, number);
    const double last = braking_->last[i++].load(std::memory_order_relaxed);
    if (std::isfinite(last)) SetNumber(type, number, safe + (last - safe) * rest);
  });
}

void StopLink::NoteRead(const void* value, ValueTimes times) noexcept {
  if (!braking_ || !stop_.stop->LetsPass(times)) return;
  std::size_t i = 0;
  (void)ForEachNumber(stop_.safe_value.type(), ForLooking(value), [&](const TypeInfo& type, void* number) {
    braking_->last[i++].store(NumberIn(type, number), std::memory_order_relaxed);
  });
  braking_->last_stamp.store(times.timestamp.time_since_epoch().count(), std::memory_order_relaxed);
  braking_->last_read.store(runtime_.clock().Now().time_since_epoch().count(), std::memory_order_relaxed);
  const bool is_possible = braking_->is_possible.load(std::memory_order_relaxed);
  braking_->begun.store(is_possible ? Braking::kNotBegun : Braking::kIsOver, std::memory_order_relaxed);
}

void StopLink::SetSubscribers(const Subscribers& subscribers, bool has_queue) {
  channel_->SetSubscribers(subscribers);
  if (!braking_) return;
  const bool is_possible = subscribers.empty() && !has_queue;
  braking_->is_possible.store(is_possible, std::memory_order_relaxed);
  if (!is_possible) braking_->begun.store(Braking::kIsOver, std::memory_order_relaxed);
}

std::uint64_t StopLink::publications() const noexcept {
  return channel_->publications() + (braking_ ? braking_->changes.load(std::memory_order_relaxed) : 0);
}

void StopLink::End() noexcept {
  robot_ = {};
  block_ = {};
}

void StopLink::Publish() {
  const std::lock_guard lock(publisher_);
  const EpochGuard guard;
  const Time now = runtime_.clock().Now();
  const auto published = channel_->PublishFilled(
      [](void* context, void* value) {
        const AnyValue& safe = static_cast<const PassedStop*>(context)->safe_value;
        return CopyValue(safe.type(), safe.get(), value);
      },
      const_cast<PassedStop*>(&stop_), ValueTimes::Of(now));
  RUNNEL_CHECK(published, "a safe value can be copied");
}

}  // namespace runnel::internal
