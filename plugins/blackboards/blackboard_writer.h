#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "core/port/input.h"
#include "plugins/blackboards/changes.h"
#include "plugins/services/client.h"

namespace runnel {

/// Reads a blackboard of another module and changes it.
///
///     BlackboardWriter<std::vector<float>> map{this, "map"};
///     …
///     auto transaction = map.Begin();                    // the value as it is now; nothing is locked
///     if (transaction && transaction.value()[7] < 0.5f) transaction.change().push_back({7, 0.5f});
///     transaction.Commit([this](const auto& outcome) { … });
///
/// Connected twice: `NAME` to read, `NAME_changes` to change. What has come of a commit is told in this module's cycle:
/// applied, with the new revision; or not, since somebody else has committed in between, and then one begins anew with
/// what there is now.
///
/// Threads: the module's cycle. Allocation: none, but for growing changes.
template <typename T, typename Change = typename UsualChange<T>::Type>
class BlackboardWriter final {
 public:
  using Changes = Client<CommitReply(CommitRequest<Change>)>;
  using Outcome = typename Changes::Outcome;

  /// What was read when it began, and what shall change. Dropped without a commit, nothing changes. One at a time.
  class Transaction {
   public:
    Transaction(Transaction&&) = delete;
    /// Whether there is a value.
    explicit operator bool() const noexcept { return read_.has_value(); }
    [[nodiscard]] const T& value() const { return *read_; }
    [[nodiscard]] std::uint64_t revision() const { return read_ ? read_.sequence() : 0; }
    [[nodiscard]] Change& change() noexcept { return writer_.request_.change; }

    /// Only if nobody else has committed since. Of the callback: Client::Call().
    template <typename Callback>
    CallStatus Commit(const Callback& callback) {
      writer_.request_.revision = revision();
      return writer_.changes_.Call(callback, writer_.request_);
    }
    /// One way, and whatever the revision is when its turn has come.
    CallStatus CommitAnyway() {
      writer_.request_.revision = 0;
      return writer_.changes_.Send(writer_.request_);
    }

   private:
    friend class BlackboardWriter;
    explicit Transaction(BlackboardWriter& writer) : writer_(writer), read_(writer.value_.Read()) {
      // A list keeps its memory.
      if constexpr (requires { change().clear(); }) {
        change().clear();
      } else {
        change() = Change{};
      }
    }

    BlackboardWriter& writer_;
    const Lease<T> read_;
  };

  template <typename Owner>
  BlackboardWriter(Owner* owner, std::string name, ClientOptions options = {})
      : value_(owner, name, {.description = options.description, .required = options.required}),
        changes_(owner, name + "_changes", std::move(options)) {}

  [[nodiscard]] Transaction Begin() { return Transaction(*this); }
  [[nodiscard]] Input<T>& value() noexcept { return value_; }
  [[nodiscard]] Changes& changes() noexcept { return changes_; }

 private:
  Input<T> value_;
  Changes changes_;
  CommitRequest<Change> request_;
};

}  // namespace runnel
