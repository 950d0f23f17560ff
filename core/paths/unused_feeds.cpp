#include "core/paths/unused_feeds.h"

#include <algorithm>
#include <mutex>
#include <new>
#include <utility>

#include "core/paths/late_connections.h"

namespace runnel {

void UnusedFeeds::NoteNew(Port& feed) {
  feed.runtime().root().FindOrAnnotate<UnusedFeeds>().new_.push_back(feed.parent()->id());
}

UnusedFeeds::Cleanup::~Cleanup() {
  std::vector<UnlistedElement> unused;
  try {
    const ChangeScope all_at_once(runtime_);
    auto* const feeds = runtime_.root().FindAnnotation<UnusedFeeds>();
    if (feeds == nullptr || feeds->new_.empty()) return;
    std::vector<FrameworkElement*> found;
    runtime_.root().VisitAll<Port>([&](const Port& port) {
      const bool is_new = std::ranges::count(feeds->new_, port.parent()->id()) > 0;
      if (is_new && port.Sources().empty() && !LateConnections::Awaits(port)) found.push_back(port.parent());
    });
    unused.reserve(found.size());
    for (FrameworkElement* const each : found) {
      if (auto unlisted = runtime_.Unlist(*each)) unused.push_back(std::move(*unlisted));
    }
    feeds->new_.clear();
  } catch (const std::bad_alloc&) {  // as said
  }
  runtime_.Destroy(std::move(unused));
}

}  // namespace runnel
