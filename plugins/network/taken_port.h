#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/port/port.h"
#include "plugins/network/network_options.h"
#include "plugins/network/offered_port.h"
#include "plugins/network_discovery/value_form.h"
#include "plugins/network_discovery/writer_clock.h"

namespace runnel {

/// An output of this application that publishes what comes from the network: made with the application, whether
/// anybody writes there or not, so that it can be connected and watched as any other. Each value is published by the
/// thread that it comes in by, in a cycle of its own, and stands in the output's buffer at once.
///
/// Ownership:   of the reader. The output must outlive it.
/// Threads:     Follow() and the destructor by the network's thread; values by threads of the engine, one at a time.
class TakenPort {
 public:
  /// `table` must outlive it.
  TakenPort(Port& output, TakeOptions options, std::shared_ptr<const ValueForm> form, ClockOffset clock,
            const DiscoveryTable& table);

  [[nodiscard]] Port& output() const noexcept { return output_; }
  [[nodiscard]] const TakeOptions& options() const noexcept { return options_; }
  /// Any thread.
  [[nodiscard]] WireEndpointOptions endpoint() const {
    const std::lock_guard lock(mutex_);
    return endpoint_;
  }

  /// Nothing if there is no reader.
  [[nodiscard]] std::optional<WireId> id() const { return reader_ ? std::optional(reader_->id()) : std::nullopt; }

  /// Whether somebody here wants its values. Under the structure lock, by the network's thread.
  void NoteConnections() { is_connected_ = !output_.outgoing().empty(); }
  [[nodiscard]] bool is_connected() const noexcept { return is_connected_; }
  /// Asks for what the writers that are there offer, if nobody has said what is to be asked for; leaves out those whose
  /// values are of another kind. Errors: of the engine.
  Result<void> Follow(WireParticipant& participant);
  /// Nothing comes any more.
  void End() noexcept { reader_.reset(); }

  [[nodiscard]] std::size_t matched() const noexcept { return matched_->load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t taken() const noexcept { return taken_.load(std::memory_order_relaxed); }
  /// Values that could not be read.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }
  /// Whether there is something new to be told: an error, or that values of two come in turn.
  [[nodiscard]] bool has_news() const {
    const std::lock_guard lock(mutex_);
    return error_.has_value() || (come_in_turn_ && !is_turn_told_);
  }
  /// Why the last of them could not, once.
  [[nodiscard]] std::optional<Error> TakeError();
  /// Of those who write to who listens to one only, the one whose value came last, or that has been chosen here.
  struct WriterInCharge {
    std::uint64_t handle = 0;  ///< 0: none
    std::string name = {};     ///< "planner (strength 5)"; "" if there is none
  };
  [[nodiscard]] WriterInCharge Owner() const;
  /// Of writers without a strength, who all match, the one that an exclusive take listens to; 0: none, or the engine chooses.
  [[nodiscard]] std::uint64_t chosen() const;
  /// Whether values of two writers come in turn, who are both heard.
  [[nodiscard]] bool they_come_in_turn() const {
    const std::lock_guard lock(mutex_);
    return come_in_turn_;
  }
  /// That has been told by the log; whoever only shows it leaves that to do.
  void NoteTurnIsTold() {
    const std::lock_guard lock(mutex_);
    is_turn_told_ = come_in_turn_;
  }
  /// By how much the clock of a writer is behind this one's at least, as far as is known (arrival after sending).
  [[nodiscard]] std::optional<Duration> least_delay(std::uint64_t writer) const;

 private:
  /// Stamps may stand still or go back, so that one alone does not tell whether a value has come before.
  struct Delivered {
    std::int64_t stamp = 0;
    std::size_t hash = 0;  // of its octets, or of the ends of them
    bool operator==(const Delivered&) const = default;
  };
  /// What is known of who writes.
  struct Writer {
    std::uint64_t handle = 0;
    WireId id = {};
    bool fits = true;                 // by its type
    bool has_simulated_time = false;  // which says nothing here
    std::string application = {};     // of Runnel that has it; else ""
    WriterClock clock = {};
    Time came = {};                        // when its last value did, on the machine's clock
    std::size_t kept = 0;                  // values, at most, that it delivers again; 0: it is not latched
    std::deque<Delivered> delivered = {};  // the last of them, in their order; the last one of who is not latched
    bool is_passed_over = false;           // the reader has not asked for what it keeps
    std::deque<Delivered> before = {};     // of those, by the reader of before, or before the link was lost
  };
  [[nodiscard]] Writer& Find(std::uint64_t handle, bool looks_again = false);
  void Take(const WireSample& sample) noexcept;
  [[nodiscard]] bool ChoosesItself() const noexcept { return options_.is_exclusive && !endpoint_.qos.is_exclusive; }
  [[nodiscard]] bool IsHeard(std::uint64_t writer);
  void ForgetGone(const std::vector<WireEndpoint>& writers);
  void MarkAsDelivered();
  [[nodiscard]] static bool HasComeBefore(Writer& writer, const Delivered& value);
  [[nodiscard]] WireQos WantedQos(const std::vector<WireEndpoint>& writers);
  void Refuse(Error error);

  Port& output_;
  const TakeOptions options_;
  const std::shared_ptr<const ValueForm> form_;
  const ClockOffset clock_;
  const DiscoveryTable& table_;
  WireEndpointOptions endpoint_;  // changed by the network's thread, under mutex_
  bool is_connected_ = false;
  const std::shared_ptr<std::atomic<std::size_t>> matched_ = std::make_shared<std::atomic<std::size_t>>(0);
  std::atomic<std::uint64_t> taken_{0};
  std::atomic<std::uint64_t> refused_{0};
  mutable std::mutex mutex_;
  std::vector<Writer> writers_;         // that values have come of; guarded by mutex_
  std::deque<Writer> gone_;             // likewise: of those that are not there now the last first
  std::uint64_t last_writer_ = 0;       // likewise
  std::uint64_t writer_before_ = 0;     // likewise: before the last one, another one
  bool come_in_turn_ = false;           // likewise
  bool is_turn_told_ = false;           // likewise
  std::uint64_t chosen_ = 0;            // likewise
  Time chosen_came_{};                  // likewise: the last value of that
  std::optional<Error> error_;          // likewise
  std::unique_ptr<WireReader> reader_;  // goes first: as long as it is there, values come that use all of this
};

}  // namespace runnel
