#include "core/paths/new_feeds.h"

#include <algorithm>
#include <new>
#include <utility>

#include "core/paths/late_connections.h"

namespace runnel {

thread_local NewFeeds* NewFeeds::current_ = nullptr;

void NewFeeds::Note(const Port& feed) {
  if (current_ != nullptr) current_->made_.push_back(feed.parent()->id());
}

NewFeeds::~NewFeeds() {
  current_ = outer_;
  if (made_.empty()) return;
  std::vector<UnlistedElement> unused;
  try {
    const ChangeScope all_at_once(runtime_);
    std::vector<FrameworkElement*> found;
    runtime_.root().VisitAll<Port>([&](const Port& port) {
      const bool is_used = !port.Sources().empty() || port.is_blocked() || port.is_set_by_hand();
      if (std::ranges::count(made_, port.parent()->id()) == 0 || is_used || LateConnections::Awaits(port)) return;
      found.push_back(port.parent());
    });
    unused.reserve(found.size());
    for (FrameworkElement* const each : found) {
      if (auto unlisted = runtime_.Unlist(*each)) unused.push_back(std::move(*unlisted));
    }
  } catch (const std::bad_alloc&) {  // they stay, and set nothing
  }
  runtime_.Destroy(std::move(unused));
}

}  // namespace runnel
