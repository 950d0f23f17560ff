#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include <poll.h>

#include "plugins/wire_shared_memory/segment.h"

namespace runnel {

/// Hands out the segments of this process to those of the same user in the same network, who ask for them by name: over a
/// socket that is in no folder, and so gone with its process. Whoever asks is given a table besides, to hold values by, which
/// counts until the connection is closed: by the system if the process ends, however it does.
///
/// Ownership: of one thread, which sleeps. Threads: any.
class SegmentServer {
 public:
  /// Errors: of the system.
  static Result<std::unique_ptr<SegmentServer>> Start();
  ~SegmentServer();

  [[nodiscard]] const SegmentId& id() const noexcept { return id_; }
  /// Until it is withdrawn the segment must live.
  void Offer(const WrittenSegment& segment);
  void Withdraw(const WrittenSegment& segment);

 private:
  SegmentServer(FileDescriptor socket, const SegmentId& id);
  struct Offered {
    int descriptor;
    std::shared_ptr<SegmentHolders> holders;
  };
  struct Reader {
    FileDescriptor link;
    std::shared_ptr<SegmentHolders> holders;
    std::shared_ptr<const HoldTable> table;
  };
  void Run() noexcept;
  /// False: it is shut down.
  bool Serve();
  // Of those whose link is closed what they held is free.
  void LookAtReaders(const std::vector<pollfd>& seen);
  void Answer(FileDescriptor asking);

  const FileDescriptor socket_;
  const SegmentId id_;
  std::mutex mutex_;
  std::map<SegmentId, Offered> segments_;  // guarded by mutex_
  std::vector<Reader> readers_;            // the thread's own
  std::thread thread_;
};

/// The segment at whoever has it. Waits for the other process, half a second at most. Errors: it has gone; it belongs to
/// another user.
[[nodiscard]] Result<std::shared_ptr<ReadSegment>> FetchSegment(const SegmentPlace& place);

}  // namespace runnel
