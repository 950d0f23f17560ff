#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/base/clock.h"
#include "core/base/ordered_mutex.h"
#include "core/element/framework_element.h"
#include "core/element/robot_stop.h"
#include "core/element/unlisted_element.h"

namespace runnel {

/// Told of every change of the structure, in the order of the changes. Schedulers, network links
/// and viewers live on it.
///
/// Threads:  called under the structure lock, by the thread that makes the change. A listener may
///           change the structure itself, but not delete, and must not wait for another thread that
///           does.
/// Errors:   must not throw.
class ElementListener {
 public:
  virtual ~ElementListener() = default;

  /// The element and all below it have become ready: they are complete and configured.
  virtual void OnReady(FrameworkElement& /*element*/) {}
  /// The element and all below it are about to be deleted; they are still whole, and marked
  /// deleted. If it throws, for lack of memory, it is called again.
  virtual void OnDeleted(FrameworkElement& /*element*/) {}
  /// Ports: data now flows, or no longer flows, from one to the other.
  virtual void OnConnected(FrameworkElement& /*from*/, FrameworkElement& /*to*/) {}
  virtual void OnDisconnected(FrameworkElement& /*from*/, FrameworkElement& /*to*/) {}

  /// Whoever has made the changes told of since the last call has made all that belong together
  /// (ChangeScope), and is about to let go of the structure lock. Not called for a change that is
  /// made in no scope: that one stands by itself.
  virtual void OnChangesEnd() {}
};

namespace internal {
extern thread_local std::uint64_t changes_by_this_thread;
}

/// The root of one tree of elements, with the lock that guards its structure. There may be several
/// in a process; they know nothing of each other.
///
/// Ownership:  owns every element made by Create(), and deletes them in reverse order.
/// Threads:    Create, MakeReady, Delete and the listener functions lock by themselves. Whoever
///             makes several changes that belong together, or looks at the tree, holds
///             structure_mutex().
class Runtime {
 public:
  Runtime();
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  [[nodiscard]] FrameworkElement& root() noexcept { return root_; }
  [[nodiscard]] OrderedMutex& structure_mutex() noexcept { return structure_mutex_; }
  /// Any thread.
  [[nodiscard]] RobotStop& robot_stop() noexcept { return robot_stop_; }

  /// Makes a T from Placement{parent, name} and the further arguments; the parent owns it. Throws
  /// what T's constructor throws, ElementError among it, and then nothing has changed.
  template <std::derived_from<FrameworkElement> T, typename... Arguments>
  T& Create(FrameworkElement& parent, std::string name, Arguments&&... arguments) {
    const auto lock = LockUnlessBeside(parent);
    auto element = std::make_unique<T>(Placement{parent, std::move(name)}, std::forward<Arguments>(arguments)...);
    T& reference = *element;
    Adopt(std::move(element));
    return reference;
  }
  /// Gives an element that was made otherwise (by a plugin's factory) to its parent.
  void Adopt(std::unique_ptr<FrameworkElement> element);
  FrameworkElement* Adopt(UnlistedElement&& element);

  /// Calls Construct() of the element and all below for which that has not been done, parents first, so that
  /// all ports are there: who connects ports before MakeReady() calls it when the parameters are set. Locks, unless the
  /// element is beside the tree, so that a slow module keeps nobody waiting; so do Create() and Prepare().
  /// Errors: what an element says, with its path; the element is to be deleted then.
  static Result<void> Construct(FrameworkElement& element);
  /// Calls Prepare() of the element and all below that are not ready yet, parents first, and Construct() before if
  /// that has not been done; if all
  /// succeed they are ready and the listeners told, else none is. Exceptions become errors.
  Result<void> MakeReady(FrameworkElement& element);

  /// Takes the element and all below it out, waits until no thread can see them, and destroys them.
  /// Errors: from within Update() (the thread would wait for itself); an element that is a member
  /// of another object; the root.
  Result<void> Delete(FrameworkElement& element);

  /// Calls Construct() and Prepare() as MakeReady() does, for an element beside the tree.
  static Result<void> Prepare(UnlistedElement& element);
  /// Puts the element where it belongs, before the child `place` of its parent (nullptr: after all).
  /// If it has been prepared, or has been in the tree before, it is ready then, and the listeners are
  /// told. Errors: its name is taken, its parent is being deleted. The caller keeps the element then, and
  /// also if this throws for lack of memory.
  Result<FrameworkElement*> List(UnlistedElement&& element, const FrameworkElement* place = nullptr);
  /// Takes the element and all below it out of the tree as they are, for Destroy() or for List()
  /// again; the listeners are told that it is deleted. Its connections stay: cut them, or have another
  /// element take them over, before. Errors: as Delete(), but for those of waiting.
  Result<UnlistedElement> Unlist(FrameworkElement& element);
  /// Cuts what still ties the element to others, waits until no thread can see it, and destroys it.
  /// Precondition: not within a cycle, and not under the structure lock.
  void Destroy(UnlistedElement element);
  /// The same for several, with one wait for all of them; in reverse order.
  void Destroy(std::vector<UnlistedElement> elements);

  /// The listener must outlive the runtime or be removed. Locks.
  void AddListener(ElementListener& listener);
  void RemoveListener(ElementListener& listener);
  /// Calls `notify` for each listener, under the lock. For those who change the structure: the
  /// ports.
  template <typename Notify>
  void ForEachListener(Notify&& notify) {
    const std::lock_guard lock(structure_mutex_);
    NoteChange();
    for (std::size_t i = 0; i < listeners_.size(); ++i) notify(*listeners_[i]);
  }

  /// Whether a ChangeScope is open: listeners that do much for each change wait for its end. Under
  /// the structure lock.
  [[nodiscard]] bool is_in_change_scope() const noexcept { return change_scopes_ > 0; }

  /// Grows with each change that listeners are told of, and where an element goes out of the tree without
  /// anybody having been told: a port that was destroyed with the object that it is a member of. Under the
  /// structure lock.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  /// Stays the same for the calling thread while no other thread changes the structure. Under the structure lock.
  [[nodiscard]] std::uint64_t revision_by_others() const noexcept {
    return revision_ - internal::changes_by_this_thread;
  }

  /// The time outside of cycles. The steady clock unless another is set before anything runs; the
  /// clock must outlive the runtime.
  [[nodiscard]] const Clock& clock() const noexcept { return *clock_; }
  void set_clock(const Clock& clock) noexcept { clock_ = &clock; }

 private:
  friend class FrameworkElement;
  // Nobody else sees what is beside the tree.
  std::unique_lock<OrderedMutex> LockUnlessBeside(const FrameworkElement& element);
  static Result<void> PrepareAll(FrameworkElement& element);
  void DestroyAll(UnlistedElement* elements, std::size_t count);
  friend class ChangeScope;
  std::uint64_t NextId() noexcept { return next_id_++; }
  void NoteChange() noexcept {
    ++revision_;
    ++internal::changes_by_this_thread;
  }

  OrderedMutex structure_mutex_{LockLevel::kStructure};
  SteadyClock steady_clock_;
  const Clock* clock_ = &steady_clock_;
  std::uint64_t next_id_ = 1;
  std::uint64_t revision_ = 0;
  std::vector<ElementListener*> listeners_;
  int change_scopes_ = 0;
  RobotStop robot_stop_{*this};
  FrameworkElement root_;
};

/// While one lives, the changes that its thread makes belong together: listeners act on all of them
/// at once when the outermost ends. So ten thousand connections cost one new schedule and not ten
/// thousand, and no cycle sees some of them only.
///
///     const ChangeScope changes(runtime);
///     … Create, MakeReady, Connect, Disconnect, AssignThread …
///
/// Threads:  holds the structure lock from its beginning to its end, so nothing can be deleted
///           meanwhile. May be nested. Do not hold it for long: others who change the structure
///           wait.
class ChangeScope {
 public:
  explicit ChangeScope(Runtime& runtime);
  ~ChangeScope();
  ChangeScope(const ChangeScope&) = delete;
  ChangeScope& operator=(const ChangeScope&) = delete;

 private:
  Runtime& runtime_;
  const std::lock_guard<OrderedMutex> lock_;
};

/// For who can do without the structure lock, and must not wait for long: others have it for a moment again and again, so it
/// is tried for so long. Threads: any that may sleep.
[[nodiscard]] std::unique_lock<OrderedMutex> TryStructureLock(Runtime& runtime, Duration patience);

}  // namespace runnel
