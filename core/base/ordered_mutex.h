#pragma once

#include <mutex>
#include <thread>

namespace runnel {

/// The order in which locks may be taken: a thread that holds one may only take later ones.
/// Breaking the order is a deadlock waiting for its day, so it fails at once (after FINROC's lock
/// levels).
enum class LockLevel : int {
  kScheduler = 10,  ///< starting and stopping threads
  kEditor = 15,     ///< change sets, one after the other
  kStructure = 20,  ///< the tree of elements and its connections
  kRegistry = 30,   ///< types, modules, plugins
  kLeaf = 100,      ///< nothing else is locked while one of these is held
};

/// A recursive mutex that checks the order of locks in every build.
///
/// Threads:  any. Errors: a broken order throws ProgrammingError before anything is locked.
class OrderedMutex {
 public:
  explicit OrderedMutex(LockLevel level) noexcept : level_(level) {}

  void lock();
  /// False if another thread has it.
  [[nodiscard]] bool try_lock();
  void unlock();
  /// True if the calling thread holds it.
  [[nodiscard]] bool HeldByThisThread() const noexcept;

 private:
  void CheckOrder() const;
  void Locked() noexcept;

  const LockLevel level_;
  std::recursive_mutex mutex_;
  OrderedMutex* outer_ = nullptr;  // the lock that this thread took before, guarded by mutex_
  int depth_ = 0;                  // guarded by mutex_
};

}  // namespace runnel
