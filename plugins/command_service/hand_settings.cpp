#include "plugins/command_service/hand_settings.h"

#include <algorithm>
#include <limits>

#include "core/element/attempt.h"
#include "core/paths/path_search.h"
#include "core/port/port_extras.h"
#include "core/port/stand_in.h"
#include "core/types/duration_text.h"
#include "plugins/structure/value_by_hand.h"

namespace runnel {

namespace {

// Between two looks at the application's clock, which may pass faster than the machine's.
constexpr Duration kShortestLook = std::chrono::milliseconds(1);
constexpr Duration kLongestLook = std::chrono::milliseconds(10);

Error At(const Port& port, std::string message) { return {.message = std::move(message), .path = port.path()}; }

// What a person has set there, what a rule has, and a block.
bool Free(Port& port) {
  const bool was_by_person = port.Release();
  if (port.Unblock() || was_by_person) return true;
  return port.Release(Port::Setter::kRule);  // asked for by itself; a rule keeps what it has set under a person's value
}

// Nothing else keeps anything there.
HandHold& HoldOf(const HandSlot& slot) { return static_cast<HandHold&>(*slot.hold); }

bool HasChangedSince(const Port& port, Time asked) {
  if (port.is_blocked() && port.blocked_since() > asked) return true;
  const auto slot = HandSlot::Find(port);
  if (!slot) return false;
  const std::lock_guard lock(slot->mutex);
  return slot->hold && HoldOf(*slot).began() > asked;
}

HandState StateOf(const Port& port) {
  const auto slot = HandSlot::Find(port);
  if (!slot) return HandState::kSet;
  const std::lock_guard lock(slot->mutex);
  return slot->hold ? HoldOf(*slot).state() : HandState::kSet;
}

Result<AnyValue> SafeAnyValueOf(const Port& port) {
  const auto safe = SafeValueOf(port);
  if (!safe || port.stop() != nullptr) return safe;
  if (auto good = internal::CheckWithin(port, port.limits(), safe->get()); !good) {
    return At(port, "has no safe value for the end of a deadline; declare a default");
  }
  return safe;
}

Result<void> CheckRequest(const PublishRequest& request) {
  // Written so that NaN is refused, too.
  if (request.rate &&
      !(*request.rate >= PublishRequest::kSlowestRate && *request.rate <= PublishRequest::kFastestRate)) {
    return Error{.message = "the rate must be from 0.001 to 1000 Hz"};
  }
  if (request.deadline &&
      (*request.deadline < PublishRequest::kShortestDeadline || *request.deadline > PublishRequest::kLongestDeadline)) {
    return Error{.message = "the deadline must be from " + DurationText(PublishRequest::kShortestDeadline) + " to " +
                            DurationText(PublishRequest::kLongestDeadline)};
  }
  if (request.lease.size() > PublishRequest::kLongestLease) {
    return Error{.message = "the name of the lease is too long"};
  }
  return {};
}

}  // namespace

Result<std::string> SetPortByHand(Runtime& runtime, const std::string& path, const std::string& value) {
  const RobotStop::AsOf as_of = runtime.robot_stop().AsOfNow();
  const std::lock_guard lock(runtime.structure_mutex());
  if (auto known = runtime.robot_stop().CheckIsKnown(as_of); !known) return known.error();
  const auto found = PathSearch(runtime).FindPort(path, PathKind::kElement);
  if (!found) return found.error();
  const auto made = ValueOf(**found, value);
  if (!made) return made.error();
  std::string at = (*found)->path();  // before it is done
  if (auto published = PublishByHand(**found, made->get()); !published) return published.error();
  return at;
}

Result<std::string> ReleasePort(Runtime& runtime, const std::string& path, RobotStop::AsOf as_of) {
  if (path.empty()) return Error{.message = "'release' needs the name of what is released"};
  if (!as_of.requests) as_of = runtime.robot_stop().AsOfNow(as_of.asked);
  const std::lock_guard lock(runtime.structure_mutex());
  if (auto known = runtime.robot_stop().CheckIsKnown(as_of); !known) return known.error();
  const auto found = PathSearch(runtime).FindPort(path, PathKind::kElement);
  if (!found) return found.error();
  if (as_of.asked && HasChangedSince(**found, *as_of.asked)) {
    return At(**found, "was blocked or set by hand after this was asked for; look why, then ask again");
  }
  std::string at = (*found)->path();  // before it is done
  if (Free(**found)) return at;
  return At(**found, "is not set by hand");
}

HandSettings::HandSettings(Runtime& runtime, CommandWorker& worker, ApplicationLog& log, const Clock* watched_clock)
    : runtime_(runtime),
      log_(log),
      clock_(watched_clock != nullptr ? *watched_clock : machine_clock_),
      watches_(watched_clock == nullptr),
      lookout_([this] { return LookAtDeadlines(); }),
      tasks_(worker) {}

std::vector<std::pair<std::string, HandState>> HandSettings::All() const {
  if (const std::unique_lock structure(runtime_.structure_mutex(), std::try_to_lock); structure) {
    std::vector<std::pair<std::string, HandState>> found;  // `mutex_` comes after those of the slots
    runtime_.root().VisitAll<const Port>([&](const Port& port) {
      if (port.is_blocked()) {
        found.emplace_back(port.path(), HandState::kStopped);
      } else if (port.is_set_by_hand()) {
        found.emplace_back(port.path(), StateOf(port));
      }
    });
    const std::lock_guard lock(mutex_);
    told_ = std::move(found);
  }
  const std::lock_guard lock(mutex_);
  return told_;
}

Result<std::string> HandSettings::Block(const BlockRequest& request) {
  const std::lock_guard structure(runtime_.structure_mutex());
  const auto found = PathSearch(runtime_).FindPort(request.port, PathKind::kElement);
  if (!found) return found.error();
  std::string at = (*found)->path();
  if (auto blocked = (*found)->Block(); !blocked) return blocked.error();
  (*found)->Release();  // whoever drove it lets go first
  return at;
}

Result<HandSettings::Published> HandSettings::Publish(const PublishRequest& request, RobotStop::AsOf as_of) {
  if (!as_of.requests) as_of = runtime_.robot_stop().AsOfNow(as_of.asked);  // a STOP of meanwhile counts, too
  if (auto good = CheckRequest(request); !good) return good.error();
  const HandHold::Request wish{request.lease, request.deadline, request.received.value_or(Now()),
                               as_of.requests.value_or(0)};
  const std::lock_guard structure(runtime_.structure_mutex());
  const auto found = PathSearch(runtime_).FindPort(request.port, PathKind::kElement);
  if (!found) return found.error();
  Port& port = **found;
  if (port.is_blocked()) {
    return Error{.message = "is blocked", .path = port.path(), .hint = "release it first"};
  }
  const auto made = ValueOf(port, request.value);
  if (!made) return made.error();
  const AnyValue& value = *made;
  if (auto good = internal::CheckWithin(port, port.limits(), value.get()); !good) return good.error();
  // Who asks for a deadline is told at once if nothing could be done when it has passed.
  AnyValue safe;
  if (request.deadline) {
    const auto rest = SafeAnyValueOf(port);
    if (!rest) return rest.error();
    safe = *rest;
  }
  Published published{port.path()};
  const Slot slot = HandSlot::Of(port);
  const auto fill = internal::FillWith(value);
  std::uint64_t number = 0;
  // Under the slot's mutex: noted first, so that nothing that is thrown leaves a value without its deadline, or one that is
  // not published again.
  auto done = port.PublishByHand([&](void* to) -> Result<void> {
    if (auto counts = runtime_.robot_stop().CheckIsKnown(as_of); !counts) return At(port, counts.error().message);
    if (!slot->hold) slot->hold = std::make_unique<HandHold>(ended_);
    HandHold& hold = HoldOf(*slot);
    if (auto allowed = hold.Check(wish, Now()); !allowed) return allowed.error().WithPath(published.port);
    published.goes_on = hold.Note(wish);
    hold.safe_value = safe;
    hold.is_renewed = true;
    hold.path = published.port;
    hold.number = number = ++count_;
    if (request.deadline) WatchOver(slot);
    auto filled = fill(to);
    if (filled && request.rate) PublishAgainAndAgain(slot, value, number, *request.rate, as_of);
    return filled;
  });
  if (!done) {
    const std::lock_guard lock(slot->mutex);
    if (slot->stand_in == nullptr) slot->hold.reset();
    return done.error();
  }
  return published;
}

// By the worker, which no thread of a cycle waits for, and without the structure lock.
void HandSettings::PublishAgainAndAgain(Slot slot, AnyValue value, std::uint64_t number, double rate,
                                        RobotStop::AsOf as_of) {
  const Duration period = FromSeconds(1 / rate);
  tasks_.PostSteps([this, slot = std::move(slot), value = std::move(value), number, period, as_of = std::move(as_of),
                    due = runtime_.clock().Now() + period]() mutable -> std::optional<Duration> {
    const Time now = runtime_.clock().Now();
    const std::lock_guard lock(slot->mutex);
    if (!slot->hold || HoldOf(*slot).number != number) return {};  // released, or set anew
    if (!runtime_.robot_stop().CheckIsKnown(as_of)) {
      log_.Add(ApplicationLog::Kind::kWarning,
               HoldOf(*slot).path + ": its value is not published again, since STOP was pressed or released");
      return {};
    }
    if (now >= due) {
      if (!slot->Publish(value)) return {};
      due = std::max(due + period, now);
    }
    return std::clamp(due - now, kShortestLook, kLongestLook);
  });
}

void HandSettings::EndLease(const std::string& lease) {
  std::list<std::string> ended{lease};
  ended_->Add(ended);
  if (watches_) lookout_.Ask();
}

// Under the slot's mutex.
void HandSettings::WatchOver(const Slot& slot) {
  {
    const std::lock_guard lock(mutex_);
    if (std::ranges::find(driven_, slot) == driven_.end()) driven_.push_back(slot);
  }
  if (watches_) lookout_.Ask();
}

std::optional<Time> HandSettings::LookAtDeadlines() {
  std::optional<Time> next;
  for (std::size_t i = std::numeric_limits<std::size_t>::max();;) {
    Slot slot;
    {
      const std::lock_guard lock(mutex_);
      i = std::min(i, driven_.size());
      if (i-- == 0) return next;
      slot = driven_[i];
    }
    if (const auto due = LookAt(slot); due && (!next || *due < *next)) next = due;
  }
}

// When to look again. A value that has just come in time counts: it is published under the same mutex.
std::optional<Time> HandSettings::LookAt(const Slot& slot) {
  const std::lock_guard lock(slot->mutex);
  HandHold* const hold = slot->hold ? &HoldOf(*slot) : nullptr;
  const auto due = hold != nullptr && slot->stand_in != nullptr ? hold->due() : std::nullopt;
  if (!due) {
    const std::lock_guard list(mutex_);
    std::erase(driven_, slot);
    return {};
  }
  if (*due > Now()) return due;
  // Whatever is thrown, the other slots' deadlines are looked at, and this one is tried again.
  try {
    if (const auto at_rest = slot->Publish(hold->safe_value); at_rest) {
      const std::string why =
          hold->has_left() ? "who drove it has left" : "nobody has been heard of for " + DurationText(hold->deadline());
      hold->NoteLost();
      log_.Add(ApplicationLog::Kind::kWarning, hold->path + ": " + why + "; it is at rest until it is released");
    } else {
      TellFailure(*hold, at_rest.error());
    }
  } catch (...) {
    TellFailure(*hold, CaughtError());
  }
  return Now() + kShortestLook;
}

// Once for each deadline: it is tried a thousand times a second.
void HandSettings::TellFailure(HandHold& hold, const Error& error) {
  if (std::exchange(hold.has_failed, true)) return;
  try {
    log_.Add(ApplicationLog::Kind::kWarning, hold.path +
                                                 ": nobody has been heard of, and it cannot be given its safe value (" +
                                                 error.message + "); this is tried again");
  } catch (...) {
    hold.has_failed = false;  // told at the next try
  }
}

}  // namespace runnel
