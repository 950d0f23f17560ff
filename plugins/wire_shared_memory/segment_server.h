#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "plugins/wire_shared_memory/segment.h"

namespace runnel {

/// Hands out the segments of this process to those of the same user in the same network, who ask for them by name: over a
/// socket that is in no folder, and so gone with its process.
///
/// Ownership: of one thread, which sleeps. Threads: any.
class SegmentServer {
 public:
  /// Errors: of the system.
  static Result<std::unique_ptr<SegmentServer>> Start();
  ~SegmentServer();
  SegmentServer(const SegmentServer&) = delete;
  SegmentServer& operator=(const SegmentServer&) = delete;

  [[nodiscard]] const SegmentId& id() const noexcept { return id_; }
  /// Until it is withdrawn the segment must live.
  void Offer(const WrittenSegment& segment);
  void Withdraw(const WrittenSegment& segment);

 private:
  SegmentServer(Descriptor socket, const SegmentId& id);
  void Run() noexcept;
  void Answer(const Descriptor& asking);

  const Descriptor socket_;
  const SegmentId id_;
  std::mutex mutex_;
  std::map<SegmentId, int> segments_;  // guarded by mutex_
  std::thread thread_;
};

/// The segment at whoever has it. Waits for the other process, half a second at most. Errors: it has gone; it belongs to
/// another user.
[[nodiscard]] Result<std::unique_ptr<ReadSegment>> FetchSegment(const SegmentPlace& place);

}  // namespace runnel
