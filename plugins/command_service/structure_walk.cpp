#include "plugins/command_service/structure_walk.h"

#include <chrono>
#include <utility>

namespace runnel {

namespace {

constexpr auto kHold = std::chrono::milliseconds(2);
constexpr int kMostRestarts = 20;
// Elements between two looks at the clock.
constexpr std::size_t kStride = 64;

}  // namespace

StructureWalk::Outcome StructureWalk::Continue(const std::function<void()>& begin, const Visitor& visit) {
  if (is_current()) return Outcome::kUnchanged;
  const auto until = std::chrono::steady_clock::now() + kHold;
  const std::uint64_t revision = runtime_.revision();
  const auto before = std::exchange(under_way_, std::nullopt);
  if (before != revision) {
    restarts_ = before ? restarts_ + 1 : 0;
    ahead_ = {&runtime_.root()};
    begin();
  }
  for (std::size_t i = 1; !ahead_.empty(); ++i) {
    FrameworkElement& element = *ahead_.back();
    ahead_.pop_back();
    const auto& children = element.children();
    if (visit(element)) ahead_.insert(ahead_.end(), children.rbegin(), children.rend());
    const bool is_late = i % kStride == 0 && std::chrono::steady_clock::now() >= until;
    if (!is_late || restarts_ > kMostRestarts || ahead_.empty()) continue;
    under_way_ = revision;
    return Outcome::kUnderWay;
  }
  restarts_ = 0;
  walked_ = revision;
  return Outcome::kSeen;
}

void StructureWalk::Forget() noexcept {
  seen_.reset();
  under_way_.reset();
}

}  // namespace runnel
