#pragma once

namespace runnel {

/// Told by publishers that new data has come. Implemented by executors of event-driven modules.
///
/// Threads:  Wake() is called by any publishing thread, inside its cycle: it must neither block nor
///           allocate. After it has been taken off an input, wait for readers (WaitForReaders())
///           before destroying it.
class Waker {
 public:
  virtual void Wake() noexcept = 0;

 protected:
  ~Waker() = default;
};

}  // namespace runnel
