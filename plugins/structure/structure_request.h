#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/element/annotation.h"
#include "core/element/framework_element.h"
#include "core/element/runtime.h"

namespace runnel {

/// By which a module asks for changes of the structure around it: a driver that has found its devices, for one.
///
///     StructureRequest request{this};
///     …                                                     // in a cycle
///     if (device_is_new) request.Ask("create /robot/camera drivers/camera port=/dev/video2; connect …");
///     if (const auto* answer = request.answer(); answer != nullptr && !*answer) log().Warn("{}", answer->error().message);
///
/// The text is that of changes (change_text.h); all of it is done or nothing, between two cycles, by the
/// one who carries out the application's reactions, within 50 ms of the application's time. On a simulated clock it
/// is the same cycle in every run. It is told as what has happened, and no client's undo takes it back.
///
/// One request at a time: `state_` says whose turn it is, and with it the text and the answer go over.
///
/// Threads:     Ask() and answer() by the module's; the rest by who carries requests out.
/// Progress:    wait-free. Allocation: none, but in the constructor.
/// Ownership:   a member of the module, which may be deleted by its own request.
class StructureRequest {
 public:
  static constexpr std::size_t kLongest = 4000;

  explicit StructureRequest(FrameworkElement* element);
  ~StructureRequest();
  StructureRequest(const StructureRequest&) = delete;
  StructureRequest& operator=(const StructureRequest&) = delete;

  /// False, and nothing is asked for, while the request before has no answer yet, or if the text is longer than
  /// kLongest bytes. Lets go of the answer before.
  bool Ask(std::string_view changes) noexcept {
    // acquire: pairs with the release in Answer(): who carried the last one out is done with the text.
    if (changes.size() > kLongest || state_.load(std::memory_order_acquire) == State::kAsked) return false;
    std::ranges::copy(changes, text_.begin());
    length_ = changes.size();
    // release: pairs with the acquire in is_asked().
    state_.store(State::kAsked, std::memory_order_release);
    return true;
  }
  /// What has become of the last request; nullptr while there is no answer.
  [[nodiscard]] const Result<void>* answer() const noexcept {
    // acquire: pairs with the release in Answer(): the answer is there.
    return state_.load(std::memory_order_acquire) == State::kAnswered ? &answer_ : nullptr;
  }

  // For who carries requests out, all under the structure lock.

  [[nodiscard]] const FrameworkElement& element() const noexcept { return element_; }
  [[nodiscard]] bool is_asked() const noexcept {
    // acquire: pairs with the release in Ask(): the text is there.
    return state_.load(std::memory_order_acquire) == State::kAsked;
  }
  /// Precondition: is_asked().
  [[nodiscard]] std::string_view text() const noexcept { return {text_.data(), length_}; }
  void Answer(Result<void> answer) {
    answer_ = std::move(answer);
    state_.store(State::kAnswered, std::memory_order_release);
  }

 private:
  enum class State : std::uint8_t { kIdle, kAsked, kAnswered };

  FrameworkElement& element_;
  std::atomic<State> state_{State::kIdle};
  std::size_t length_ = 0;
  std::array<char, kLongest> text_;
  Result<void> answer_;
};

/// The requests of a runtime's modules, kept with its root. Under the structure lock.
class StructureRequests final : public Annotation {
 public:
  /// nullptr if no module has ever had one.
  [[nodiscard]] static StructureRequests* Of(Runtime& runtime) {
    return runtime.root().FindAnnotation<StructureRequests>();
  }

  [[nodiscard]] const std::vector<StructureRequest*>& all() const noexcept { return all_; }

 private:
  friend class StructureRequest;
  std::vector<StructureRequest*> all_;
};

inline StructureRequest::StructureRequest(FrameworkElement* element) : element_(*element) {
  Runtime& runtime = element_.runtime();
  const std::lock_guard lock(runtime.structure_mutex());
  runtime.root().FindOrAnnotate<StructureRequests>().all_.push_back(this);
}

inline StructureRequest::~StructureRequest() {
  Runtime& runtime = element_.runtime();
  const std::lock_guard lock(runtime.structure_mutex());
  std::erase(StructureRequests::Of(runtime)->all_, this);
}

}  // namespace runnel
