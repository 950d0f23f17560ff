// Values that are set by hand (Port::PublishByHand()).

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/retry.h"
#include "core/element/runtime.h"
#include "core/port/driving_ports.h"
#include "core/port/parameter_input.h"
#include "core/port/port.h"
#include "core/port/port_extras.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {
std::size_t SlotOf(Port::Setter setter) noexcept { return static_cast<std::size_t>(setter); }

// Whether what comes to the port has gone on while the value by hand was there.
bool HasPublishedSince(const Port& port, const Port& held) {
  std::optional<Time> set;
  bool has_published = false;
  held.VisitLatest([&](const void*, ValueTimes times) { set = times.publication_time; });
  for (const Port* source : port.Sources()) {
    source->VisitLatest([&](const void*, ValueTimes times) {
      has_published = has_published || (set && times.publication_time > *set);
    });
  }
  return has_published;
}
}  // namespace

// So that viewers look again.
void Port::TellOfChange() {
  runtime().ForEachListener([](ElementListener&) {});
}

Port* Port::by_hand() const noexcept {
  if (!extras_) return nullptr;
  const auto& [person, rule] = extras_->by_hand;
  return person ? person.get() : rule.get();
}

bool Port::is_set_by_hand(Setter setter) const noexcept { return extras_ && extras_->by_hand[SlotOf(setter)]; }

std::optional<Port::HandValue> Port::ValueByHand(Setter setter) const {
  if (!is_set_by_hand(setter) || !type_.is_transparent()) return {};
  const std::shared_ptr<void> copy = type_.Make();
  std::optional<HandValue> found;
  extras_->by_hand[SlotOf(setter)]->VisitLatest([&](const void* value, ValueTimes times) {
    if (copy != nullptr && CopyValue(type_, value, copy.get()))
      found = HandValue{AnyValue(type_, copy), times.timestamp};
  });
  if (const auto slot = setter == Setter::kPerson ? HandSlot::Find(*this) : nullptr; slot && found) {
    // Whoever takes the value elsewhere, an undo, takes no person along who is heard of: it is at rest there.
    const std::lock_guard publisher(slot->mutex);
    found->is_at_rest = slot->hold && slot->hold->safe_value;
    if (found->is_at_rest) found->value = slot->hold->safe_value;
  }
  return found;
}

std::shared_ptr<HandSlot> HandSlot::Find(const Port& port) { return port.extras_ ? port.extras_->hand_slot : nullptr; }

std::shared_ptr<HandSlot> HandSlot::Of(Port& port) {
  auto& slot = port.Extras().hand_slot;
  if (!slot) slot = std::make_shared<HandSlot>();
  return slot;
}

Result<void> HandSlot::Publish(const AnyValue& value) const {
  if (stand_in == nullptr) return {};
  const auto published = stand_in->PublishFilled(internal::FillWith(value));
  return published ? Result<void>() : published.error();
}

internal::PortExtras& Port::Extras() {
  if (!extras_) extras_ = std::make_unique<internal::PortExtras>();
  return *extras_;
}

Result<void> Port::PublishByHand(const Fill& fill, Setter setter, std::optional<Time> timestamp) {
  const std::lock_guard lock(runtime().structure_mutex());
  if (auto may = CheckMayBeSet(*this); !may) return may;
  if (auto read = internal::CheckHasItsPlace(*this); !read) return read;
  const Fill fill_within = [&](void* value) -> Result<void> {
    if (auto filled = fill(value); !filled) return filled;
    return internal::CheckWithin(*this, limits(), value);
  };
  // Whoever watches a deadline publishes there without the structure lock.
  const auto slot = setter == Setter::kPerson ? HandSlot::Of(*this) : nullptr;
  std::unique_lock publisher = slot ? std::unique_lock(slot->mutex) : std::unique_lock<std::mutex>();
  if (slot && slot->hold) slot->hold->is_renewed = false;
  if (is_set_by_hand(setter)) {
    const auto published = extras_->by_hand[SlotOf(setter)]->PublishFilled(fill_within, timestamp);
    if (!published) return published.error();
    if (slot && slot->hold && !slot->hold->is_renewed) slot->hold.reset();
    return {};
  }
  auto channel = internal::MakeChannelFor(type_);
  if (!channel) return CannotPublish("only a module can make values of its type");
  auto output = std::make_unique<internal::StandIn>(*this, std::move(channel));
  if (auto published = output->PublishFilled(fill_within, timestamp); !published) return published.error();
  auto& place = Extras().by_hand[SlotOf(setter)];
  place = std::move(output);
  if (slot) {
    slot->stand_in = place.get();
    publisher.unlock();
  }
  try {
    RebindSinks();
    PruneConversions();
  } catch (...) {
    Retry([&] { Release(setter); });
    throw;
  }
  TellOfChange();
  return {};
}

bool Port::Release(Setter setter) {
  const std::lock_guard lock(runtime().structure_mutex());
  if (!is_set_by_hand(setter)) return false;
  const Port& held = *extras_->by_hand[SlotOf(setter)];
  // What is ramped before it has not driven. Nor does what a ramp, or anybody before what a person has set, has made
  // meanwhile. Else, who releases for a rule has seen that what comes is new. A position goes on at once to what is wished:
  // its safe value would be a motion, too.
  const bool is_ramped = BeginMotionAnew() && (setter == Setter::kPerson || HasPublishedSince(*this, held));
  const Setter other = setter == Setter::kPerson ? Setter::kRule : Setter::kPerson;
  const bool is_alone = !is_set_by_hand(other) && life_cycle() != LifeCycle::kDeleted;
  // What is published at this very moment counts, as also where the clock stands; a ramp may not have begun anew by then.
  const auto now = [&] { return runtime().clock().Now() - Duration(is_ramped ? 0 : 1); };
  std::vector<const Port*> held_on;
  const auto stops = internal::FindStopsOfVelocities(*this, held_on);
  if (is_set_by_hand(other)) held_on.push_back(this);
  const bool bars =
      life_cycle() != LifeCycle::kDeleted && (is_ramped || setter == Setter::kPerson);  // its clock may be gone
  const std::optional<Time> passed_over = bars ? now() : extras_->passed_over;
  for (const Port* each : held_on) each->extras_->passed_over = std::max(each->extras_->passed_over, passed_over);
  if (is_alone && passed_over) {
    for (const auto& each : stops) each->block()->Bar([&] { return bars ? now() : *passed_over; });
    extras_->passed_over.reset();
  }
  auto released = std::move(extras_->by_hand[SlotOf(setter)]);
  const auto slot = setter == Setter::kPerson ? HandSlot::Find(*this) : nullptr;
  try {
    RebindSinks();
    PruneConversions();
  } catch (...) {  // some are still bound to it
    extras_->by_hand[SlotOf(setter)] = std::move(released);
    Retry([&] { RebindSinks(); });
    throw;
  }
  if (slot) {
    const std::lock_guard publisher(slot->mutex);
    slot->stand_in = nullptr;
    slot->hold.reset();
  }
  internal::DeleteLater(std::move(released));
  TellOfChange();
  return true;
}

}  // namespace runnel
