#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/lockfree/buffer_pool.h"

namespace runnel {

/// What reading an input found.
enum class Freshness {
  kNoData,  ///< nothing has ever been published, or nothing is connected
  kOld,     ///< the value that the last Read() returned already
  kNew,     ///< not read before through this input
};

/// What a full queue does with one more value. Whatever is lost is counted.
enum class OnFull {
  kDropOldest,  ///< makes room: a reader that lags sees the newest values
  kDropNewest,  ///< keeps what it has
  kRefuse,      ///< keeps what it has, and Publish() returns kRefused
};

/// How files, commands and messages write it: drop_oldest, drop_newest, refuse. In its order.
[[nodiscard]] const std::vector<std::string>& OnFullNames();

/// How one connection behaves.
struct ConnectOptions {
  std::size_t queue = 0;  ///< how many values may wait at the input; 0: only the latest counts
  OnFull on_full = OnFull::kDropOldest;
  bool pull = false;  ///< the input pulls, see Strategy::kPull; not with a queue
};

/// Who sees to it that a value comes.
enum class Strategy {
  kPush,  ///< the publisher, when it has one: reading takes what has been published
  kPull,  ///< the reader, when it wants one: reading first has the sources' providers make one
};

struct InputOptions {
  std::string description = {};
  bool required = false;  ///< an application in which nothing is connected to it is wrong
  bool trigger = false;   ///< new data here is what an event-driven thread waits for
  bool waits = false;     ///< its reader will call Wait(): prepares for that at once
  Strategy strategy = Strategy::kPush;
};

struct OutputOptions {
  std::string description = {};
  PoolOptions pool = {};  ///< for types that travel in buffers; others have none
  bool pullable = false;  ///< may have a provider; the provider's buffers are a second such pool
};

enum class PublishStatus {
  kPublished,
  kRefused,   ///< published, but a full queue that refuses did not take it
  kNoBuffer,  ///< not published: a pool of fixed size had no free buffer (an empty loan)
  kBusy,      ///< not published: a reader's pull is just publishing a newer value (pullable only)
};

}  // namespace runnel
