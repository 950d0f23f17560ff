#include "plugins/command_service/hand_leases.h"

#include <algorithm>

#include "core/types/duration_text.h"

namespace runnel {

namespace {

constexpr std::size_t kRemembered = 256;
constexpr const char* kTakeHoldAgain = "let go, and take hold again";

}  // namespace

const char* HandStateName(HandState state) noexcept {
  switch (state) {
    case HandState::kSet: return "set";
    case HandState::kDriven: return "driven";
    case HandState::kLost: return "lost";
    case HandState::kStopped: return "stopped";
  }
  return "";
}

Result<void> HandLeases::Check(const std::string& port, const Request& request, Time now) const {
  const auto found = holds_.find(port);
  const Hold* const hold = found == holds_.end() ? nullptr : &found->second;
  if (!request.lease.empty()) {
    if (std::ranges::find(ended_, request.lease) != ended_.end()) {
      return Error{.message = "this hold has ended", .path = port, .hint = kTakeHoldAgain};
    }
    if (hold != nullptr && hold->state == HandState::kDriven && hold->lease != request.lease) {
      return Error{.message = "somebody else drives it", .path = port};
    }
  }
  if (request.deadline && now - request.received > *request.deadline) {
    return Error{.message = "the value has waited for longer than its deadline of " +
                            DurationText(*request.deadline),
                 .path = port,
                 .hint = kTakeHoldAgain};
  }
  return {};
}

bool HandLeases::Note(const std::string& port, const Request& request) {
  const auto found = holds_.find(port);
  bool goes_on = false;
  if (found != holds_.end()) {
    const Hold& before = found->second;
    goes_on = before.state == HandState::kDriven && request.deadline &&
              !request.lease.empty() && before.lease == request.lease;
    if (!goes_on) EndLeaseOf(before);
  }
  Hold hold{.state = HandState::kSet, .lease = request.lease};
  if (request.deadline) {
    hold.state = HandState::kDriven;
    hold.deadline = *request.deadline;
    hold.due = request.received + *request.deadline;
  }
  holds_.insert_or_assign(port, std::move(hold));
  return goes_on;
}

void HandLeases::Forget(const std::string& port) {
  const auto found = holds_.find(port);
  if (found == holds_.end()) return;
  EndLeaseOf(found->second);
  holds_.erase(found);
}

void HandLeases::ForgetAll() {
  for (const auto& [port, hold] : holds_) EndLeaseOf(hold);
  holds_.clear();
}

std::vector<std::pair<std::string, Duration>> HandLeases::Expire(Time now) {
  std::vector<std::pair<std::string, Duration>> lost;
  for (auto& [port, hold] : holds_) {
    if (hold.state != HandState::kDriven || hold.due > now) continue;
    EndLeaseOf(hold);
    hold.state = HandState::kLost;
    lost.emplace_back(port, hold.deadline);
  }
  return lost;
}

std::optional<Time> HandLeases::next() const {
  std::optional<Time> next;
  for (const auto& [port, hold] : holds_) {
    if (hold.state == HandState::kDriven && (!next || hold.due < *next)) next = hold.due;
  }
  return next;
}

std::optional<HandState> HandLeases::StateOf(const std::string& port) const {
  const auto found = holds_.find(port);
  return found == holds_.end() ? std::nullopt : std::optional(found->second.state);
}

std::vector<std::pair<std::string, HandState>> HandLeases::All() const {
  std::vector<std::pair<std::string, HandState>> all;
  for (const auto& [port, hold] : holds_) all.emplace_back(port, hold.state);
  return all;
}

void HandLeases::EndLeaseOf(const Hold& hold) {
  if (hold.state != HandState::kDriven || hold.lease.empty()) return;
  ended_.push_back(hold.lease);
  if (ended_.size() > kRemembered) ended_.pop_front();
}

}  // namespace runnel
