#include "core/port/stop_link.h"

#include <utility>

#include "core/base/check.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/stand_in.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"

namespace runnel::internal {

StopLink::StopLink(PassedStop stop, std::unique_ptr<ChannelBase> channel, const Clock& clock)
    : stop_(std::move(stop)), channel_(std::move(channel)), clock_(clock) {
  Publish();
  const auto look = [this] {
    if (stop_.stop->in_force()) Publish();
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
  return own.type().is_transparent() &&
         ToText(own.type(), own.get()) == ToText(own.type(), stop.safe_value.get());
}

void StopLink::End() noexcept {
  robot_ = {};
  block_ = {};
}

void StopLink::Publish() {
  const std::lock_guard lock(publisher_);
  const EpochGuard guard;
  const Time now = clock_.Now();
  const auto published = channel_->PublishFilled(
      [](void* context, void* value) {
        return FillWith(static_cast<const PassedStop*>(context)->safe_value)(value).has_value();
      },
      const_cast<PassedStop*>(&stop_), ValueTimes::Of(now));
  RUNNEL_CHECK(published, "a safe value can be copied");
}

}  // namespace runnel::internal
