// Values that are set by hand (Port::PublishByHand()).

#include <mutex>
#include <utility>

#include "core/element/runtime.h"
#include "core/port/port.h"
#include "core/port/port_extras.h"

namespace runnel {

// So that viewers look again.
static void TellOfChange(Runtime& runtime) {
  runtime.ForEachListener([](ElementListener&) {});
}

Port* Port::by_hand() const noexcept { return extras_ ? extras_->by_hand.get() : nullptr; }

internal::PortExtras& Port::Extras() {
  if (!extras_) extras_ = std::make_unique<internal::PortExtras>();
  return *extras_;
}

Result<void> Port::PublishByHand(const Fill& fill) {
  const std::lock_guard lock(runtime().structure_mutex());
  const Fill fill_within = [&](void* value) -> Result<void> {
    if (auto filled = fill(value); !filled) return filled;
    return internal::CheckWithin(*this, limits(), value);
  };
  if (Port* const known = by_hand()) {
    const auto published = known->PublishFilled(fill_within);
    return published ? Result<void>() : published.error();
  }
  auto channel = internal::MakeChannelFor(type_);
  if (!channel) return CannotPublish("only a module can make values of its type");
  auto output = std::make_unique<internal::StandIn>(*this, std::move(channel));
  if (auto published = output->PublishFilled(fill_within); !published) return published.error();
  Extras().by_hand = std::move(output);
  try {
    RebindSinks();
    PruneConversions();
  } catch (...) {
    Release();
    throw;
  }
  TellOfChange(runtime());
  return {};
}

bool Port::Release() {
  const std::lock_guard lock(runtime().structure_mutex());
  if (!is_set_by_hand()) return false;
  auto released = std::move(extras_->by_hand);
  try {
    RebindSinks();
    PruneConversions();
  } catch (...) {  // some are still bound to it
    extras_->by_hand = std::move(released);
    throw;
  }
  internal::DeleteLater(std::move(released));
  TellOfChange(runtime());
  return true;
}

}  // namespace runnel
