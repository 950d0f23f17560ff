#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/genom_execution/component_table.h"

namespace runnel::genom_execution {

/// How a request, or a permanent activity, has ended. Allocates in its constructor only.
class Outcome {
 public:
  explicit Outcome(std::size_t largest_detail) : detail_(largest_detail) {}

  /// Without an exception.
  void Succeed() noexcept { Fail(nullptr); }
  /// With an exception of the engine. The words live as long as the component, as its names do.
  void Fail(Event exception, const char* first = nullptr, const char* second = nullptr) noexcept {
    exception_ = exception;
    words_ = {first, second};
    detail_size_ = 0;
  }
  /// With one of the component.
  void Fail(Event exception, const void* detail, std::size_t size) noexcept {
    Fail(exception);
    detail_size_ = std::min(size, detail_.size());
    if (detail_size_ > 0) std::memcpy(detail_.data(), detail, detail_size_);
  }

  [[nodiscard]] bool is_success() const noexcept { return exception_ == nullptr; }
  [[nodiscard]] Event exception() const noexcept { return exception_; }
  [[nodiscard]] const void* detail() const noexcept { return detail_size_ > 0 ? detail_.data() : nullptr; }
  /// Of one of the engine: what it has with it, nullptr for nothing, and what that is called.
  [[nodiscard]] const std::array<const char*, 2>& words() const noexcept { return words_; }
  [[nodiscard]] std::array<const char*, 2> word_names() const noexcept {
    return {exception_ == kBadTransition ? "from" : exception_ == kInterrupted ? "by" : "what", "to"};
  }
  /// "bad_transition {from: go, to: ::courier::halt}". Allocates.
  [[nodiscard]] std::string Text(const ComponentTable& component) const {
    if (is_success()) return "";
    for (const ExceptionTable& each : component.exceptions) {
      if (each.exception != exception_) continue;
      if (each.detail_text == nullptr || detail_size_ == 0) return each.name;
      return std::string(each.name) + " " + each.detail_text(detail_.data());
    }
    std::string_view name = exception_;
    if (name.starts_with("::genom::")) name.remove_prefix(9);
    std::string text(name);
    const auto names = word_names();
    if (words_[0] != nullptr) text += std::string(" {") + names[0] + ": " + words_[0];
    if (words_[1] != nullptr) text += std::string(", ") + names[1] + ": " + words_[1];
    if (words_[0] != nullptr) text += "}";
    return text;
  }

 private:
  Event exception_ = nullptr;
  std::array<const char*, 2> words_{};
  std::vector<std::byte> detail_;
  std::size_t detail_size_ = 0;
};

/// One request of a service, with room for its parameters, its locals and what comes of it. Made outside of cycles, and
/// used again and again: fill data(), Engine::Send(), and when it is done look at outcome() and data().
///
/// Ownership:  its maker's; not to be destroyed, nor touched but by state(), while it is under way.
class Request {
 public:
  enum class State : std::uint8_t {
    kIdle,      ///< its maker's
    kSent,      ///< waits for the control task
    kAccepted,  ///< of an activity: validated; it may be waiting for others to end
    kDone       ///< its maker's again
  };

  Request(const ComponentTable& component, const ServiceTable& service)
      : service_(service),
        outcome_(component.largest_detail),
        data_(service.make != nullptr ? service.make() : nullptr) {}
  ~Request() {
    if (data_ != nullptr && service_.destroy != nullptr) service_.destroy(data_);
  }

  [[nodiscard]] const ServiceTable& service() const noexcept { return service_; }
  [[nodiscard]] void* data() noexcept { return data_; }
  // acquire: pairs with the release in Engine: what was written is there.
  [[nodiscard]] State state() const noexcept { return state_.load(std::memory_order_acquire); }
  /// Of the activity, once it is accepted; 0 for others.
  [[nodiscard]] std::uint32_t id() const noexcept { return id_.load(std::memory_order_relaxed); }
  /// Name of the state that the activity is in, to look at; "" if it is in none.
  [[nodiscard]] const char* doing() const noexcept { return doing_.load(std::memory_order_relaxed); }
  [[nodiscard]] const Outcome& outcome() const noexcept { return outcome_; }

  /// Called when it is accepted, and when it is done, by the thread that runs the control task: no lock, no wait. The
  /// request's maker may have destroyed it by then; `client` outlives that call.
  void (*on_change)(void* client) = nullptr;
  void* client = nullptr;
  /// Of the standard service abort_activity.
  std::uint32_t abort_id = 0;

 private:
  friend class ControlTask;
  friend class Engine;
  friend class ExecutionTask;

  void Set(State state) {
    // Read first: whoever sees that it is done may destroy it.
    const auto tell = on_change;
    void* const whom = client;
    // release: pairs with the acquire in state().
    state_.store(state, std::memory_order_release);
    if (tell != nullptr && state != State::kSent) tell(whom);
  }

  const ServiceTable& service_;
  Outcome outcome_;  // first: what may find no memory once data_ is there would leave that behind
  void* data_;
  std::atomic<State> state_{State::kIdle};
  std::atomic<std::uint32_t> id_{0};
  std::atomic<const char*> doing_{""};
};

}  // namespace runnel::genom_execution
