#include "plugins/command_service/hand_settings.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "core/paths/path_search.h"
#include "core/types/duration_text.h"
#include "plugins/structure/value_by_hand.h"

namespace runnel {

namespace {

// Between two looks at the application's clock, which may pass faster than the machine's.
constexpr Duration kShortestLook = std::chrono::milliseconds(1);
constexpr Duration kLongestLook = std::chrono::milliseconds(10);

Error At(const Port& port, std::string message) {
  return {.message = std::move(message), .path = port.path()};
}

// What a person has set there, what a rule has, and a block.
bool Free(Port& port) {
  const bool was_by_person = port.Release();
  const bool was_by_rule = port.Release(Port::Setter::kRule);
  return port.Unblock() || was_by_person || was_by_rule;
}

Result<void> CheckRequest(const PublishRequest& request) {
  if (request.rate && (*request.rate <= 0 || *request.rate > PublishRequest::kFastestRate)) {
    return Error{.message = "the rate must be above 0 and at most 1000 Hz"};
  }
  if (request.deadline && (*request.deadline < PublishRequest::kShortestDeadline ||
                           *request.deadline > PublishRequest::kLongestDeadline)) {
    return Error{.message = "the deadline must be from " +
                            DurationText(PublishRequest::kShortestDeadline) + " to " +
                            DurationText(PublishRequest::kLongestDeadline)};
  }
  if (request.lease.size() > PublishRequest::kLongestLease) {
    return Error{.message = "the name of the lease is too long"};
  }
  return {};
}

}  // namespace

Result<std::string> SetPortByHand(Runtime& runtime, const std::string& path,
                                  const std::string& value) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = PathSearch(runtime).FindPort(path, PathKind::kElement);
  if (!found) return found.error();
  const auto made = ValueOf(**found, value);
  if (!made) return made.error();
  if (auto published = PublishByHand(**found, made->get()); !published) return published.error();
  return (*found)->path();
}

Result<std::string> ReleasePort(Runtime& runtime, const std::string& path) {
  const std::lock_guard lock(runtime.structure_mutex());
  if (!path.empty()) {
    const auto found = PathSearch(runtime).FindPort(path, PathKind::kElement);
    if (!found) return found.error();
    if (Free(**found)) return (*found)->path();
    return At(**found, "is not set by hand");
  }
  std::string released;
  runtime.root().Visit([&](FrameworkElement& element) {
    auto* const port = dynamic_cast<Port*>(&element);
    if (port != nullptr && Free(*port)) released += (released.empty() ? "" : ", ") + port->path();
  });
  if (released.empty()) return Error{.message = "no port is set by hand"};
  return released;
}

HandSettings::HandSettings(Runtime& runtime, CommandWorker& worker, ApplicationLog& log,
                           const Clock* watched_clock)
    : runtime_(runtime),
      log_(log),
      clock_(watched_clock != nullptr ? *watched_clock : machine_clock_),
      watches_(watched_clock == nullptr),
      tasks_(worker) {}

HandSettings::~HandSettings() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  has_changed_.notify_all();
  if (watch_.joinable()) watch_.join();
}

std::vector<std::pair<std::string, HandState>> HandSettings::All() const {
  if (const std::unique_lock structure(runtime_.structure_mutex(), std::try_to_lock); structure) {
    const std::lock_guard lock(mutex_);
    told_.clear();
    runtime_.root().Visit([&](FrameworkElement& element) {
      const auto* const port = dynamic_cast<const Port*>(&element);
      if (port == nullptr) return;
      if (port->is_blocked()) {
        told_.emplace_back(port->path(), HandState::kStopped);
      } else if (port->is_set_by_hand()) {
        told_.emplace_back(port->path(), leases_.StateOf(port->path()).value_or(HandState::kSet));
      }
    });
  }
  const std::lock_guard lock(mutex_);
  return told_;
}

Result<std::string> HandSettings::Block(const BlockRequest& request) {
  const std::lock_guard structure(runtime_.structure_mutex());
  const auto found = PathSearch(runtime_).FindPort(request.port, PathKind::kElement);
  if (!found) return found.error();
  if (auto blocked = (*found)->Block(); !blocked) return blocked.error();
  std::string path = (*found)->path();
  const std::lock_guard lock(mutex_);
  last_.erase(path);
  leases_.Forget(path);
  (*found)->Release();
  return path;
}

Result<HandSettings::Published> HandSettings::Publish(const PublishRequest& request) {
  if (auto good = CheckRequest(request); !good) return good.error();
  const HandLeases::Request wish{request.lease, request.deadline, request.received.value_or(Now())};
  const std::lock_guard structure(runtime_.structure_mutex());
  const auto found = PathSearch(runtime_).FindPort(request.port, PathKind::kElement);
  if (!found) return found.error();
  Port& port = **found;
  if (port.is_blocked()) {
    return Error{.message = "is blocked", .path = port.path(), .hint = "release it first"};
  }
  const auto value = ValueOf(port, request.value);
  if (!value) return value.error();
  // Who asks for a deadline is told at once if nothing could be done when it has passed.
  if (request.deadline) {
    if (const auto safe = SafeValueOf(port); !safe) return safe.error();
  }
  Published published{port.path()};
  const std::lock_guard lock(mutex_);
  if (!port.is_set_by_hand()) leases_.Forget(published.port);  // released by others, or another port
  if (auto allowed = leases_.Check(published.port, wish, Now()); !allowed) return allowed.error();
  if (auto done = PublishByHand(port, value->get()); !done) return done.error();
  published.goes_on = leases_.Note(published.port, wish);
  const std::uint64_t number = last_[published.port] = ++count_;
  if (request.rate) PublishAgainAndAgain({published.port, *value}, number, *request.rate);
  if (request.deadline && watches_ && !watch_.joinable()) {
    watch_ = std::thread([this] { Watch(); });
  }
  if (request.deadline) has_changed_.notify_all();
  return published;
}

void HandSettings::PublishAgainAndAgain(HandSet set, std::uint64_t number, double rate) {
  const Duration period = FromSeconds(1 / rate);
  tasks_.PostSteps([this, set = std::move(set), number, period,
                    due = runtime_.clock().Now() + period]() mutable -> std::optional<Duration> {
    const Time now = runtime_.clock().Now();
    if (now < due) {
      const std::lock_guard lock(mutex_);
      if (!IsLast(set.path, number)) return {};
    } else {
      const std::lock_guard structure(runtime_.structure_mutex());
      const std::lock_guard lock(mutex_);
      if (!IsLast(set.path, number)) return {};
      const auto found = PathSearch(runtime_).FindPort(set.path, PathKind::kElement);
      if (!found || !(*found)->is_set_by_hand()) return {};  // released, or gone
      if (!PublishByHand(**found, set.value.get())) return {};
      due = std::max(due + period, now);
    }
    return std::clamp(due - now, kShortestLook, kLongestLook);
  });
}

bool HandSettings::IsLast(const std::string& port, std::uint64_t number) const {
  const auto last = last_.find(port);
  return last != last_.end() && last->second == number;
}

Result<std::string> HandSettings::Release(const ReleaseRequest& request) {
  if (request.port.empty()) return Error{.message = "'release' needs the name of what is released"};
  const std::lock_guard structure(runtime_.structure_mutex());
  auto released = ReleasePort(runtime_, request.port);
  if (!released) return released;
  const std::lock_guard lock(mutex_);
  last_.erase(*released);
  leases_.Forget(*released);
  return released;
}

void HandSettings::Watch() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    const auto next = leases_.next();
    if (!next) {
      has_changed_.wait(lock);
    } else if (const Duration left = *next - Now(); left > Duration::zero()) {
      has_changed_.wait_for(lock, left);
    } else {
      lock.unlock();
      LookAtDeadlines();
      lock.lock();
    }
  }
}

// The structure lock first: what is published by hand is so under it, and a value that has just come in time counts.
void HandSettings::LookAtDeadlines() {
  const std::lock_guard structure(runtime_.structure_mutex());
  const std::lock_guard lock(mutex_);
  for (const auto& [path, deadline] : leases_.Expire(Now())) {
    last_.erase(path);
    const auto found = PathSearch(runtime_).FindPort(path, PathKind::kElement);
    if (!found || !(*found)->is_set_by_hand()) {
      leases_.Forget(path);
      continue;
    }
    std::string text = path + ": nobody has been heard of for " + DurationText(deadline) + "; ";
    const auto safe = SafeValueOf(**found);
    if (safe && PublishByHand(**found, safe->get())) {
      text += "it is at rest until it is released";
    } else {  // what is published must do
      (*found)->Release();
      leases_.Forget(path);
      text += "it has no safe value, and is released";
    }
    log_.Add(ApplicationLog::Kind::kWarning, std::move(text));
  }
}

}  // namespace runnel
