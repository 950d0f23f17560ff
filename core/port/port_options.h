#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/channel/channel_options.h"
#include "core/lockfree/buffer_pool.h"
#include "core/port/driving_kind.h"
#include "core/types/any_value.h"

namespace runnel {

/// How one connection behaves.
struct ConnectOptions {
  static constexpr std::size_t kLongestQueue = 1'000'000;  ///< its memory is taken at once

  std::size_t queue = 0;  ///< how many values may wait at the input; 0: only the latest counts
  OnFull on_full = OnFull::kDropOldest;
  bool pull = false;  ///< the input pulls, see Strategy::kPull; not with a queue
  /// Made as soon as both ends are there, and again after one went; LateConnections sees to it.
  bool when_present = false;
  /// In a loop of modules, this is the connection by which values come one cycle late.
  bool late = false;
  std::string part = {};     ///< of the values at `from`: "x", "ranges[0]"; "" for all of them
  std::string convert = {};  ///< the name of a conversion; "" for the usual one, if one is needed

  /// As it stands behind the path of the port: ".x", "[0]", "".
  [[nodiscard]] std::string PartText() const { return (part.empty() || part.front() == '[' ? "" : ".") + part; }
};

/// Who sees to it that a value comes.
enum class Strategy {
  kPush,  ///< the publisher, when it has one: reading takes what has been published
  kPull,  ///< the reader, when it wants one: reading first has the sources' providers make one
};

/// What an input does with a number that is out of its bounds. Counted in any case.
enum class OutOfBounds {
  kDiscard,  ///< the value before stays
  kClamp,    ///< takes the nearest that is in the bounds
  kDefault,  ///< takes the default value
};

/// How files, commands and messages write it: discard, clamp, default. In its order.
[[nodiscard]] const std::vector<std::string>& OutOfBoundsNames();

/// Which values an input takes, and what it reads when there is none.
struct InputLimits {
  AnyValue default_value = {};         ///< of the input's type: read while nothing is connected or has come
  std::optional<double> minimum = {};  ///< of numbers only
  std::optional<double> maximum = {};
  OutOfBounds out_of_bounds = OutOfBounds::kDiscard;

  [[nodiscard]] bool has_bounds() const noexcept { return minimum || maximum; }
  [[nodiscard]] bool has_some() const noexcept { return has_bounds() || default_value; }
};

/// "0.1 .. 5", "0 ..", ".. 5"; "" for none.
[[nodiscard]] std::string BoundsText(const InputLimits& limits);

/// Whether what is read at an input grows old.
enum class Ageing {
  kUnspecified,
  kTimesOut,         ///< a measurement, or what was made of one: what is published by it is as old as it is
  kSetOnce,          ///< a goal, a map, a mode: it holds until there is another
  kWhileSourceRuns,  ///< a wish, a stimulation: its last word holds as long as the module runs that has said it
  kPassedOn,         ///< each value goes on with its own stamp: whoever reads it there sees how old it is
};

struct InputOptions {
  std::string description = {};
  bool required = false;  ///< an application in which nothing is connected to it is wrong
  bool trigger = false;   ///< new data here is what an event-driven thread waits for
  bool waits = false;     ///< its reader will call Wait(): prepares for that at once
  Strategy strategy = Strategy::kPush;
  std::string unit = {};  ///< SI, of numbers: what comes from a connection in another unit is converted
  InputLimits limits = {};
  /// Something moves by what is read here: readers find the safe value while the robot is stopped (RobotStop).
  bool drives = false;
  /// What it says. Unspecified: as its units say; of numbers without units it has to be said.
  DrivingKind command = DrivingKind::kUnspecified;
  /// Of the input's type; without one, zero of a velocity, or the default value of the limits.
  AnyValue safe_value = {};
  /// How long it takes from the value read last to the safe one when the robot is stopped; 0: the safe one at once. Of
  /// types that are made of numbers alone.
  Duration brake{};
  Ageing ageing = Ageing::kUnspecified;
};

struct OutputOptions {
  std::string description = {};
  PoolOptions pool = {};  ///< for types that travel in buffers; others have none
  bool pullable = false;  ///< may have a provider; the provider's buffers are a second such pool
  std::string unit = {};  ///< SI, of numbers
};

}  // namespace runnel
