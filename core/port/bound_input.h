#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "core/channel/channel_base.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/input_base.h"
#include "core/port/input_binding.h"

namespace runnel {

/// How an input that reads values of one type is bound to its sources: all of
/// it that does not depend on the type.
///
/// A binding is never changed; connecting replaces it as a whole, and readers
/// that still use the one before keep it by their guard.
class BoundInput : public InputBase {
 public:
  [[nodiscard]] std::uint64_t dropped() const noexcept override;
  [[nodiscard]] std::uint64_t publications() const noexcept override;
  /// How many queues that others have replaced still hold values, or may still get some. Any thread.
  [[nodiscard]] std::size_t replaced_queues() const noexcept;
  /// Whether somebody publishes to it, or has a value there. Any thread; wait-free.
  [[nodiscard]] bool is_bound() const noexcept {
    const EpochGuard guard;
    return !binding()->links.empty();
  }
  /// Whether values wait for Take(), since a connection has a queue or has had one. By the reader.
  [[nodiscard]] bool has_queue() const noexcept {
    const EpochGuard guard;
    return binding()->queue != nullptr || !binding()->older_queues.empty();
  }

 protected:
  using Link = internal::InputLink;
  using Binding = internal::InputBinding;

  // By reference, so that typed inputs move nothing themselves.
  BoundInput(FrameworkElement& group, std::string&& name, const TypeInfo& type, InputOptions&& options);
  ~BoundInput() override;
  /// By the destructor of typed inputs: they make queues while they are
  /// disconnected.
  void DisconnectForEver();

  /// An empty queue for values of the input's type.
  [[nodiscard]] virtual std::unique_ptr<InputQueueBase> MakeQueue(std::size_t capacity, OnFull on_full,
                                                                  Writers writers) const = 0;
  /// acquire: pairs with the release in Replace().
  [[nodiscard, gnu::always_inline]] const Binding* binding() const noexcept {
    return binding_.load(std::memory_order_acquire);
  }
  /// Has the sources' providers make values, if the binding pulls. Inside a
  /// guard.
  void PullInto(const Binding& binding) const noexcept;

 private:
  QueueSink* Bind(const std::vector<Source>& sources) override;
  void TellStops(const Subscribers& subscribers) override;
  void BindStops(const Binding& before, Binding& next, std::vector<internal::PassedStop> stops);
  void TakeOverBinding(InputBase& from) noexcept override;
  void Bound() override;

  std::shared_ptr<Link> KeepOrMakeLink(const Binding& before, ChannelBase& channel);
  [[nodiscard]] std::shared_ptr<InputQueueBase> KeepOrMakeQueue(const Binding& before, const Binding& next,
                                                                const ConnectOptions& options) const;
  static void KeepWaitingValues(const Binding& before, Binding& next);
  void Replace(const Binding* next);

  // Of an input that is not connected: there always is one, so that readers need not ask.
  static const Binding kUnbound;

  std::atomic<const Binding*> binding_{&kUnbound};
  // All three under the structure lock: bindings between Bind() and Bound(), sources that have just
  // been connected, and the links of the binding before, also while nothing is connected.
  std::vector<std::unique_ptr<const Binding>> replaced_;
  std::vector<ChannelBase*> fresh_;
  std::vector<std::shared_ptr<Link>> last_links_;
};

}  // namespace runnel
