#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "core/port/output.h"
#include "core/port/port_owner.h"
#include "plugins/blackboards/changes.h"
#include "plugins/services/service.h"

namespace runnel {

struct BlackboardOptions {
  std::string description = {};
  std::size_t queue = 64;    ///< how many change sets may wait
  std::size_t journal = 16;  ///< so many are kept, by which buffers that were read are brought up to date
  PoolOptions pool = {};
};

/// A value that several modules read and change: a map, a list of objects. One module owns it.
///
///     Blackboard<std::vector<float>> map{this, "map"};
///
/// Read by ordinary inputs that are connected to its port, without a copy and without ever waiting; the number of what
/// they read, `Lease::sequence()`, is its revision. Changed by the owner (Write()), and by those who are connected to
/// the service NAME_changes (BlackboardWriter): their change sets wait in a bounded queue, and are applied one after
/// the other in the owner's cycle, each a publication of its own. Nobody holds the value while he thinks, so nobody can
/// keep it when he dies.
///
/// A commit does not copy the value: the buffer that nobody reads any more is brought up to date by the change sets
/// since it was published, as long as the journal has them; else, and after a Write(), it is copied once.
///
/// Threads:     the owner's cycle.
/// Allocation:  none by commits, once buffers and journal have grown to what changes need.
/// Life:        a swap hands value, revision and waiting changes over to the blackboard of the same name.
template <typename T, typename Change = typename UsualChange<T>::Type>
class Blackboard final {
 public:
  /// Write access for the owner: what is in it is committed at its end, unless it is discarded, or ends by an
  /// exception. Empty if the pool is of fixed size and exhausted.
  class Access {
   public:
    Access(Access&&) = delete;
    ~Access() noexcept(false) {
      if (!loan_) return;
      const bool is_thrown = std::uncaught_exceptions() > exceptions_;
      if (is_discarded_ || is_thrown) {
        try {
          board_.PublishAsItWas(std::move(loan_));
        } catch (...) {  // nobody has seen the buffer, and it is copied before it is used again
          if (!is_thrown) throw;
        }
      } else {
        board_.journal_begin_ = board_.revision() + 2;  // buffers of before are copied
        board_.Publish(std::move(loan_));
      }
    }
    explicit operator bool() const noexcept { return loan_.has_value(); }
    T& operator*() { return *loan_; }
    T* operator->() { return &*loan_; }
    void Discard() noexcept { is_discarded_ = true; }

   private:
    friend class Blackboard;
    explicit Access(Blackboard& board) : board_(board), loan_(board.UpToDate()) {}

    Blackboard& board_;
    Loan<T> loan_;
    bool is_discarded_ = false;
    const int exceptions_ = std::uncaught_exceptions();
  };

  template <typename Owner>
  Blackboard(Owner* owner, std::string name, T initial = {}, BlackboardOptions options = {})
      : value_(owner, name, {.description = options.description, .pool = options.pool}),
        changes_(static_cast<PortOwner*>(owner)->OutputGroup(), *this, name + "_changes", &Blackboard::Commit,
                 {.description = "changes " + name, .arguments = {}, .queue = options.queue}),
        journal_(options.journal) {
    known_.reserve(kKnown);
    auto loan = value_.Loan();
    *loan = std::move(initial);
    Publish(std::move(loan));
  }

  /// Grows with each commit, and goes on after a swap.
  [[nodiscard]] std::uint64_t revision() const noexcept { return value_.publications(); }
  [[nodiscard]] Access Write() { return Access(*this); }
  /// Looks at the newest value.
  template <typename Use>
  void Look(Use&& use) const {
    value_.VisitLatest([&use](const void* value, ValueTimes) { use(*static_cast<const T*>(value)); });
  }
  /// One change set, by the owner. Errors: those of Apply(); the value is as it was then.
  Result<void> CommitChange(const Change& change) {
    const auto committed = Commit({.revision = 0, .change = change});
    if (!committed) return committed.error();
    return {};
  }
  [[nodiscard]] Output<T>& port() noexcept { return value_; }
  [[nodiscard]] Service<CommitReply(CommitRequest<Change>)>& changes() noexcept { return changes_; }

 private:
  static constexpr std::size_t kKnown = 64;
  struct Known {
    const T* buffer;
    std::uint64_t revision;
  };

  Result<CommitReply> Commit(const CommitRequest<Change>& request) {
    if (request.revision != 0 && request.revision != revision()) return CommitReply{false, revision()};
    auto loan = UpToDate();
    if (!loan) return Error{.message = "no buffer is free: readers hold all of them"};
    Result<void> applied;
    try {
      applied = Apply(*loan, request.change);
      // Of what is thrown half-way nothing may stay in the journal.
      if (applied && !journal_.empty()) journal_[(revision() + 1) % journal_.size()] = request.change;
    } catch (...) {
      PublishAsItWas(std::move(loan));
      throw;
    }
    if (!applied) {
      PublishAsItWas(std::move(loan));
      return applied.error();
    }
    Publish(std::move(loan));
    return CommitReply{true, revision()};
  }

  // A buffer with what the newest value has.
  Loan<T> UpToDate() {
    ForgetOthersPast();
    auto loan = value_.Loan();
    if (!loan) return loan;
    const std::uint64_t now = revision();
    const auto known = std::ranges::find(known_, &*loan, &Known::buffer);
    const std::uint64_t had = known != known_.end() ? known->revision : 0;
    if (had > 0) known_.erase(known);  // what throws half-way leaves a buffer of which nothing is known
    const bool is_in_journal = had > 0 && had + 1 >= journal_begin_ && now - had <= journal_.size();
    if (!is_in_journal || !Replay(*loan, had + 1, now)) CopyNewest(*loan);
    return loan;
  }
  bool Replay(T& value, std::uint64_t from, std::uint64_t to) {
    for (; from <= to; ++from) {
      if (!Apply(value, journal_[from % journal_.size()])) return false;
    }
    return true;
  }
  void CopyNewest(T& value) {
    value_.VisitLatest([&value](const void* newest, ValueTimes) { value = *static_cast<const T*>(newest); });
  }
  // A swap has exchanged the channel: what is known of buffers is of the other one's.
  void ForgetOthersPast() {
    const T* newest = nullptr;
    value_.VisitLatest([&newest](const void* value, ValueTimes) { newest = static_cast<const T*>(value); });
    if (newest == newest_ && revision() == published_) return;
    known_.clear();
    journal_begin_ = revision() + 1;
  }
  void Publish(Loan<T>&& loan) {
    newest_ = &*loan;
    if constexpr (!kIsInlined<T>) {
      const auto known = std::ranges::find(known_, newest_, &Known::buffer);
      if (known != known_.end()) {
        known->revision = revision() + 1;
      } else {
        known_.push_back({newest_, revision() + 1});
      }
    }
    value_.Publish(std::move(loan));
    published_ = revision();
  }
  // Half changed: it becomes the newest again, as one more publication, since whoever comes by a swap could not tell
  // the buffer from one that has not been touched.
  void PublishAsItWas(Loan<T>&& loan) {
    journal_begin_ = revision() + 2;  // whatever comes of it
    CopyNewest(*loan);
    Publish(std::move(loan));
  }

  Output<T> value_;
  Service<CommitReply(CommitRequest<Change>)> changes_;
  std::vector<Change> journal_;      // what led to a revision, at its place modulo the size
  std::uint64_t journal_begin_ = 2;  // the first revision in it
  std::vector<Known> known_;         // the revisions that buffers have
  const T* newest_ = nullptr;
  std::uint64_t published_ = 0;
};

}  // namespace runnel
