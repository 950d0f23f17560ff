#include "plugins/structure/structure_request.h"

#include <algorithm>
#include <mutex>

#include "core/element/runtime.h"

namespace runnel {

StructureRequest::StructureRequest(FrameworkElement* element) : element_(*element) {
  Runtime& runtime = element_.runtime();
  const std::lock_guard lock(runtime.structure_mutex());
  runtime.root().FindOrAnnotate<StructureRequests>().all_.push_back(this);
}

StructureRequest::~StructureRequest() {
  Runtime& runtime = element_.runtime();
  const std::lock_guard lock(runtime.structure_mutex());
  std::erase(StructureRequests::Of(runtime)->all_, this);
}

bool StructureRequest::Ask(std::string_view changes) noexcept {
  // acquire: pairs with the release in Answer(): who carried the last one out is done with the text.
  if (changes.size() > kLongest || state_.load(std::memory_order_acquire) == State::kAsked) return false;
  std::ranges::copy(changes, text_.begin());
  length_ = changes.size();
  // release: pairs with the acquire in is_asked().
  state_.store(State::kAsked, std::memory_order_release);
  return true;
}

StructureRequests* StructureRequests::Of(Runtime& runtime) {
  return runtime.root().FindAnnotation<StructureRequests>();
}

}  // namespace runnel
