#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/base/clock.h"
#include "core/base/ordered_mutex.h"
#include "core/base/result.h"
#include "plugins/mcap/mcap_reader.h"

namespace runnel {

/// The values of some channels of a recording in the order of their time, read chunk by chunk as they are
/// needed, and moved onto the clock of whoever plays them.
///
/// Threads:  any, but for the preparations. Locks, and reads from the file: for cycles without a deadline.
class PlayedValues {
 public:
  struct Value {
    Time time;       ///< when it is published, on the clock of who plays
    Time timestamp;  ///< when it was measured, likewise
    std::string json;
  };

  /// `from` and `to` on the recording's clock.
  PlayedValues(std::unique_ptr<McapReader> reader, std::optional<Duration> from, std::optional<Duration> to,
               bool loops);

  [[nodiscard]] McapReader& reader() noexcept { return *reader_; }
  /// From where to where is played, on the recording's clock.
  [[nodiscard]] Time start() const noexcept { return Time(Duration(start_)); }
  [[nodiscard]] Time end() const noexcept { return Time(Duration(end_)); }

  /// Before Start(): this channel's are wanted.
  void Want(std::uint16_t channel) { waiting_[channel]; }
  /// The first values are due at `now`: for each channel the newest from before the start, if there is one,
  /// and then those since.
  void Start(Time now);
  /// Takes the next value of the channel that is due at `now`; nullopt: none is, or nothing more comes.
  [[nodiscard]] std::optional<Value> Take(std::uint16_t channel, Time now);
  /// Everything has been taken, and it does not begin anew; or reading has failed.
  [[nodiscard]] bool is_over() const;
  void Fail(Error error);
  [[nodiscard]] std::optional<Error> failure() const;

 private:
  struct Waiting {
    std::int64_t time;
    std::uint64_t chunk;  // its place in the file
    std::int64_t timestamp;
    std::string json;
    // A port may publish several in one cycle, at one time: then as they were written.
    [[nodiscard]] auto order() const noexcept { return std::pair(time, chunk); }
  };

  // All under the mutex.
  void Read(std::int64_t until);
  void ReadChunk(const McapChunk& chunk);
  void Rewind();
  [[nodiscard]] bool HasEnded() const;

  const std::unique_ptr<McapReader> reader_;
  const bool loops_;
  std::int64_t start_ = 0;
  std::int64_t end_ = 0;

  mutable OrderedMutex mutex_{LockLevel::kLeaf};
  std::int64_t offset_ = 0;  // from the recording's clock to that of who plays
  std::size_t next_chunk_ = 0;
  std::map<std::uint16_t, std::deque<Waiting>> waiting_;
  std::map<std::uint16_t, Waiting> before_;  // newest of each channel from before the start
  bool has_begun_ = false;
  std::optional<Error> failure_;
};

}  // namespace runnel
