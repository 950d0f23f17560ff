#include "core/paths/new_feeds.h"

#include <algorithm>
#include <new>
#include <utility>

#include "core/lockfree/thread_epoch.h"
#include "core/paths/late_connections.h"

namespace runnel {

thread_local NewFeeds* NewFeeds::current_ = nullptr;

void NewFeeds::Note(const Port& feed) {
  if (current_ != nullptr && &current_->runtime_ == &feed.runtime()) current_->made_.push_back(feed.parent()->id());
}

NewFeeds::~NewFeeds() {
  current_ = outer_;
  // Where nothing can be deleted, they stay, and set nothing.
  if (made_.empty() || EpochGuard::HeldByThisThread() || runtime_.structure_mutex().HeldByThisThread()) return;
  std::vector<UnlistedElement> unused;
  try {
    const ChangeScope all_at_once(runtime_);
    std::vector<FrameworkElement*> found;
    runtime_.root().VisitAll<Port>([&](const Port& port) {
      if (std::ranges::count(made_, port.parent()->id()) == 0) return;
      const bool is_used = !port.incoming().empty() || !port.outgoing().empty() || LateConnections::Awaits(port);
      if (!is_used) found.push_back(port.parent());
    });
    unused.reserve(found.size());
    for (FrameworkElement* const each : found) {
      if (auto unlisted = runtime_.Unlist(*each)) unused.push_back(std::move(*unlisted));
    }
  } catch (const std::bad_alloc&) {  // so, too
  }
  runtime_.Destroy(std::move(unused));
}

}  // namespace runnel
