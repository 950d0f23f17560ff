#pragma once

#include <array>
#include <cstddef>
#include <string>
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
  void Fail(Event exception, const void* detail, std::size_t size) noexcept;

  [[nodiscard]] bool is_success() const noexcept { return exception_ == nullptr; }
  [[nodiscard]] Event exception() const noexcept { return exception_; }
  [[nodiscard]] const void* detail() const noexcept { return detail_size_ > 0 ? detail_.data() : nullptr; }
  [[nodiscard]] std::size_t detail_size() const noexcept { return detail_size_; }
  [[nodiscard]] const std::array<const char*, 2>& words() const noexcept { return words_; }
  /// "bad_transition {from: go, to: ::courier::halt}". Allocates.
  [[nodiscard]] std::string Text(const ComponentTable& component) const;

 private:
  Event exception_ = nullptr;
  std::array<const char*, 2> words_{};
  std::vector<std::byte> detail_;
  std::size_t detail_size_ = 0;
};

}  // namespace runnel::genom_execution
