#include "plugins/genom_execution/request.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace runnel::genom_execution {

Request::Request(const ComponentTable& component, const ServiceTable& service)
    : service_(service),
      data_(service.make != nullptr ? service.make() : nullptr),
      outcome_(component.largest_detail) {}

Request::~Request() {
  if (data_ != nullptr && service_.destroy != nullptr) service_.destroy(data_);
}

void Outcome::Fail(Event exception, const void* detail, std::size_t size) noexcept {
  Fail(exception);
  detail_size_ = std::min(size, detail_.size());
  if (detail_size_ > 0) std::memcpy(detail_.data(), detail, detail_size_);
}

std::array<const char*, 2> Outcome::word_names() const noexcept {
  return {exception_ == kBadTransition ? "from" : exception_ == kInterrupted ? "by" : "what", "to"};
}

std::string Outcome::Text(const ComponentTable& component) const {
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

}  // namespace runnel::genom_execution
