#include "core/element/runtime.h"

#include <algorithm>
#include <thread>

#include "core/base/retry.h"
#include "core/element/attempt.h"
#include "core/element/own_thread.h"
#include "core/lockfree/thread_epoch.h"

namespace runnel {

namespace internal {
extern thread_local std::uint64_t made_by_this_thread;
thread_local std::uint64_t changes_by_this_thread = 0;
}  // namespace internal

namespace {

// How long those wait who delete something whose thread does not end.
constexpr Duration kPatience = std::chrono::seconds(1);
constexpr Duration kLook = std::chrono::milliseconds(1);

Error Refuse(const FrameworkElement& element, std::string message, std::string hint = {}) {
  return Error{.message = std::move(message), .path = element.path(), .hint = std::move(hint)};
}

}  // namespace

Runtime::Runtime() : root_(FrameworkElement::RootTag{}, *this) {}

Runtime::~Runtime() {
  // Reverse order: what was made later may refer to what was made before.
  while (!root_.owned_.empty()) {
    if (!Delete(*root_.owned_.back())) root_.owned_.pop_back();
  }
  if (auto* const leaving = root_.FindAnnotation<Leaving>()) leaving->elements.clear();
}

bool OwnThread::AskToEnd(FrameworkElement& top, const Tell& tell) {
  bool have_ended = true;
  const auto ask = [&](FrameworkElement& each) {
    const auto* const own = each.FindAnnotation<OwnThread>();
    if (own == nullptr || !own->is_at_work()) return;
    own->ask_to_end();
    have_ended = false;
    if (tell) tell(each);
  };
  top.Visit(ask);
  if (const auto* const leaving = top.FindAnnotation<Leaving>()) {
    for (const UnlistedElement& each : leaving->elements) each->Visit(ask);
  }
  return have_ended;
}

std::unique_lock<OrderedMutex> Runtime::LockUnlessBeside(const FrameworkElement& element) {
  std::unique_lock lock(structure_mutex_);
  if (!element.IsInTree()) lock.unlock();
  return lock;
}

void Runtime::Adopt(std::unique_ptr<FrameworkElement> element) {
  const auto lock = LockUnlessBeside(*element->parent_);
  FrameworkElement& parent = *element->parent_;
  parent.owned_.push_back(std::move(element));
}

FrameworkElement* Runtime::Adopt(UnlistedElement&& element) {
  FrameworkElement* const adopted = element.get();
  Adopt(std::move(element.element_));
  return adopted;
}

Result<void> Runtime::Construct(FrameworkElement& element) {
  Runtime& runtime = element.runtime();
  const auto lock = runtime.LockUnlessBeside(element);
  Result<void> result;
  // What is made on the way comes later in the same visit.
  element.Visit([&](FrameworkElement& each) {
    if (!result || each.is_whole_ || each.life_cycle_ != LifeCycle::kConstructed) return;
    const std::uint64_t made_before = internal::made_by_this_thread;
    result = Attempt([&] { return each.Construct(); });
    each.is_whole_ = true;
    each.has_constructed_ = internal::made_by_this_thread != made_before;
    if (result) return;
    result = result.error().WithPath(each.path());
  });
  return result;
}

Result<void> Runtime::MakeReady(FrameworkElement& element) {
  const std::lock_guard lock(structure_mutex_);
  if (auto prepared = PrepareAll(element); !prepared) return prepared;
  if (!element.IsInTree()) return {};
  ForEachListener([&](ElementListener& listener) { listener.OnReady(element); });
  return {};
}

Result<void> Runtime::Prepare(UnlistedElement& element) { return PrepareAll(*element); }

Result<void> Runtime::PrepareAll(FrameworkElement& element) {
  std::vector<FrameworkElement*> prepared;
  Result<void> result = Construct(element);
  if (!result) return result;
  element.Visit([&](FrameworkElement& each) {
    if (!result || each.life_cycle_ != LifeCycle::kConstructed) return;
    result = Attempt([&] { return each.Prepare(); });
    prepared.push_back(&each);
  });
  if (!result) return result.error().WithPath(prepared.back()->path());
  for (FrameworkElement* each : prepared) each->life_cycle_ = LifeCycle::kReady;
  return {};
}

Result<FrameworkElement*> Runtime::List(UnlistedElement&& element, const FrameworkElement* place) {
  const std::lock_guard lock(structure_mutex_);
  FrameworkElement* const listed = element.get();
  auto& owned = listed->parent_->owned_;
  owned.emplace_back();  // a place for it, so that what fails has changed nothing
  try {
    listed->JoinParent(place);
  } catch (const ElementError& error) {
    owned.pop_back();
    return error.error();
  } catch (...) {
    owned.pop_back();
    throw;
  }
  owned.back() = std::move(element.element_);
  listed->Visit([](FrameworkElement& each) {
    if (each.life_cycle_ == LifeCycle::kDeleted) each.life_cycle_ = LifeCycle::kReady;
  });
  if (listed->life_cycle_ == LifeCycle::kReady) {
    ForEachListener([&](ElementListener& listener) { listener.OnReady(*listed); });
  }
  return listed;
}

Result<UnlistedElement> Runtime::Unlist(FrameworkElement& element) {
  const std::lock_guard lock(structure_mutex_);
  FrameworkElement* const parent = element.parent_;
  if (parent == nullptr) return Refuse(element, "the root cannot be deleted");
  if (element.life_cycle_ == LifeCycle::kDeleted) {
    return Refuse(element, "is being deleted already");
  }
  const auto place_of = [&](auto& owned) {
    return std::ranges::find_if(owned, [&](auto& each) { return each.get() == &element; });
  };
  if (place_of(parent->owned_) == parent->owned_.end()) {
    return Refuse(element, "a part of another element cannot be deleted by itself", "delete " + parent->path());
  }
  element.Visit([](FrameworkElement& each) { each.life_cycle_ = LifeCycle::kDeleted; });
  // All are told, since nobody could tell some of them that it is there again.
  ForEachListener([&](ElementListener& listener) { Retry([&] { listener.OnDeleted(element); }); });
  element.LeaveParent();
  // Anew, since what listeners did may have moved it.
  const auto place = place_of(parent->owned_);
  UnlistedElement taken(std::move(*place));
  parent->owned_.erase(place);
  return taken;
}

void Runtime::Destroy(UnlistedElement element) { DestroyAll(&element, element ? 1 : 0); }

void Runtime::Destroy(std::vector<UnlistedElement> elements) { DestroyAll(elements.data(), elements.size()); }

// Without allocating: what fails between leaving the tree and being destroyed could be told to nobody.
void Runtime::DestroyAll(UnlistedElement* elements, std::size_t count) {
  if (count == 0) return;
  {
    const std::lock_guard lock(structure_mutex_);
    for (std::size_t i = 0; i < count; ++i) {
      elements[i]->Visit([](FrameworkElement& below) { below.Detach(); });
    }
  }
  // No thread finds the element anew; wait for those that have found it before. The lock is free
  // meanwhile, so that a cycle that needs it can come to its end.
  WaitForReaders();
  const Time latest = SteadyClock().Now() + kPatience;
  for (; count > 0; elements[--count] = {}) {
    UnlistedElement& last = elements[count - 1];
    while (!OwnThread::AskToEnd(*last) && SteadyClock().Now() < latest) std::this_thread::sleep_for(kLook);
    if (OwnThread::AskToEnd(*last)) continue;
    const std::lock_guard lock(structure_mutex_);
    root_.FindOrAnnotate<Leaving>().elements.push_back(std::move(last));
  }
  std::list<UnlistedElement> ended;  // goes without the lock
  const std::lock_guard lock(structure_mutex_);
  auto* const leaving = root_.FindAnnotation<Leaving>();
  if (leaving == nullptr) return;
  for (auto at = leaving->elements.begin(); at != leaving->elements.end();) {
    const auto each = at++;
    if (OwnThread::AskToEnd(**each)) ended.splice(ended.end(), leaving->elements, each);
  }
}

Result<void> Runtime::Delete(FrameworkElement& element) {
  if (EpochGuard::HeldByThisThread()) {
    return Refuse(element, "an element cannot be deleted from within a cycle", "ask another thread to do it");
  }
  if (structure_mutex_.HeldByThisThread()) {
    return Refuse(element, "an element cannot be deleted under the structure lock",
                  "a cycle that has to end first may be waiting for the lock");
  }
  UnlistedElement taken;
  {
    const ChangeScope all_that_goes_with_it(*this);
    auto unlisted = Unlist(element);
    if (!unlisted) return unlisted.error();
    taken = std::move(*unlisted);
    taken->Visit([](FrameworkElement& each) { each.Detach(); });
  }
  Destroy(std::move(taken));
  return {};
}

ChangeScope::ChangeScope(Runtime& runtime) : runtime_(runtime), lock_(runtime.structure_mutex()) {
  ++runtime_.change_scopes_;
}

// Still a scope while the listeners act: what they change themselves belongs to it.
ChangeScope::~ChangeScope() {
  if (runtime_.change_scopes_ == 1) {
    runtime_.ForEachListener([](ElementListener& listener) { listener.OnChangesEnd(); });
  }
  --runtime_.change_scopes_;
}

void Runtime::AddListener(ElementListener& listener) {
  const std::lock_guard lock(structure_mutex_);
  listeners_.push_back(&listener);
}

void Runtime::RemoveListener(ElementListener& listener) {
  const std::lock_guard lock(structure_mutex_);
  std::erase(listeners_, &listener);
}

std::unique_lock<OrderedMutex> TryStructureLock(Runtime& runtime, Duration patience) {
  std::unique_lock lock(runtime.structure_mutex(), std::try_to_lock);
  for (const Time latest = SteadyClock().Now() + patience; !lock && SteadyClock().Now() < latest;
       (void)lock.try_lock()) {
    std::this_thread::sleep_for(std::min<Duration>(patience / 10, std::chrono::milliseconds(1)));
  }
  return lock;
}

}  // namespace runnel
