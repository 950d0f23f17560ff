#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/port/port.h"
#include "plugins/services/call.h"
#include "plugins/services/cycle_work.h"
#include "plugins/services/service_endpoint.h"

namespace runnel {

struct ClientOptions {
  std::string description = {};
  bool required = false;                       ///< an application in which it is connected to no service is wrong
  std::size_t calls = 16;                      ///< how many may be under way at once
  Duration timeout = std::chrono::seconds(5);  ///< on the application's clock
  /// Of the arguments, in their order, for services elsewhere that know them by name (ServiceOptions::arguments).
  std::vector<std::string> arguments = {};
};

/// The part of a client that does not depend on the types of its calls.
class ClientBase : public CyclePart {
 public:
  /// Whether there is a service at the other end. Any thread.
  [[nodiscard]] bool is_connected() const noexcept { return endpoint() != nullptr; }
  [[nodiscard]] Port& port() noexcept { return *port_; }
  [[nodiscard]] const Port& port() const noexcept { return *port_; }
  /// By a thread of the program's own, for a client that is part of no module: calls the callbacks of what has been
  /// answered. Modules do it by themselves, before each Update().
  void Deliver() { BeforeUpdate(); }

  /// How the call stands now; gives it up if its time-out has passed, or its service has gone. Any thread.
  [[nodiscard]] CallStatus Poll(CallBase& call) const noexcept;
  /// Sleeps until the call has ended. Errors: throws ProgrammingError in a cycle, or inside an epoch guard.
  CallStatus Wait(CallBase& call) const;

 protected:
  ClientBase(const ClientOptions& options, std::unique_ptr<CallSlots> slots);
  ~ClientBase() = default;

  void Open(Port& port);
  void Close() noexcept;
  /// What the input reads: where calls go now.
  [[nodiscard]] virtual ServiceEndpoint* endpoint() const noexcept = 0;
  /// One that nobody uses, to be filled; nullptr: as many are under way as there is room for.
  [[nodiscard]] CallBase* Acquire() const noexcept { return slots_->Acquire(); }
  [[nodiscard]] CallStatus Begin(CallBase& call) noexcept;
  /// The cycle calls back when it has ended. By the thread of the cycle.
  void AwaitInCycle(CallBase& call) { awaited_.push_back(&call); }
  virtual void CallBack(CallBase& call, CallStatus status) = 0;

 private:
  [[nodiscard]] Time now() const noexcept;
  void BeforeUpdate() override {
    if (!awaited_.empty()) CallBackAll();
  }
  void SetWaker(Waker* waker) override { slots_->SetWaker(waker); }
  void CallBackAll();

  const Duration timeout_;
  std::unique_ptr<CallSlots> slots_;
  std::vector<CallBase*> awaited_;  // in the order of calling; as many as there are slots at most
  std::atomic<std::uint64_t> calls_{0};
  Port* port_ = nullptr;
  CycleWork* work_ = nullptr;
};

}  // namespace runnel
