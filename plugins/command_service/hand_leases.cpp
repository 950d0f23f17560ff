#include <algorithm>
#include <array>

#include "core/types/duration_text.h"
#include "plugins/command_service/hand_settings.h"

namespace runnel {

namespace {

constexpr std::size_t kRemembered = 256;
constexpr const char* kTakeHoldAgain = "let go, and take hold again";

}  // namespace

const char* HandStateName(HandState state) noexcept {
  static constexpr std::array kNames{"set", "driven", "lost", "stopped"};
  return kNames[static_cast<std::size_t>(state)];
}

void EndedLeases::Add(std::list<std::string>& lease) noexcept {
  const std::lock_guard lock(mutex_);
  leases_.splice(leases_.end(), lease);
  if (leases_.size() > kRemembered) leases_.pop_front();
}

bool EndedLeases::Has(const std::string& lease) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::find(leases_, lease) != leases_.end();
}

Result<void> HandHold::Check(const Request& request, Time now) const {
  if (!request.lease.empty()) {
    if (ended_->Has(request.lease)) return Error{.message = "this hold has ended", .hint = kTakeHoldAgain};
    if (state_ == HandState::kDriven && !Has(request.lease)) {
      return Error{.message = "somebody else drives it"};
    }
    // Who holds a button through STOP and release does not mean what it does afterwards.
    if (state_ == HandState::kDriven && request.deadline && stops_ != request.stops) {
      return Error{.message = "STOP has ended this hold", .hint = kTakeHoldAgain};
    }
  }
  if (request.deadline && now - request.received > *request.deadline) {
    return Error{.message = "the value has waited for longer than its deadline of " + DurationText(*request.deadline),
                 .hint = kTakeHoldAgain};
  }
  return {};
}

bool HandHold::Note(const Request& request) {
  const bool goes_on = state_ == HandState::kDriven && request.deadline && !request.lease.empty() && Has(request.lease);
  std::list<std::string> lease;
  if (!request.lease.empty()) lease.push_back(request.lease);
  if (!goes_on) EndLease();
  if (!goes_on) began_ = SteadyClock().Now();
  stops_ = request.stops;
  state_ = request.deadline ? HandState::kDriven : HandState::kSet;
  lease_.swap(lease);
  deadline_ = request.deadline.value_or(Duration::zero());
  due_ = request.received + deadline_;
  has_failed = false;
  return goes_on;
}

void HandHold::NoteLost() {
  EndLease();
  state_ = HandState::kLost;
  number = 0;
}

void HandHold::EndLease() noexcept {
  if (state_ == HandState::kDriven) ended_->Add(lease_);
}

}  // namespace runnel
