#pragma once

#include <string>
#include <vector>

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

enum class PublishStatus {
  kPublished,
  kRefused,   ///< published, but a full queue that refuses did not take it
  kNoBuffer,  ///< not published: a pool of fixed size had no free buffer (an empty loan)
  kBusy,      ///< not published: a reader's pull is just publishing a newer value (pullable only)
};

}  // namespace runnel
