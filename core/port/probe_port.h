#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "core/port/input_base.h"

namespace runnel {

class ProbeQueue;

/// An input that takes each value of the outputs connected to it, without knowing their type: for
/// recorders and bridges. What is connected to it delivers its newest value at once. Connections bring
/// no queue of their own: `capacity` values can wait, and what comes when it is full is not taken, and
/// counted. Publishers pay for it what a queue costs.
///
/// Threads:     Take() by one thread at a time; the rest from any. Connecting and publishing go on
///              meanwhile.
/// Allocation:  in the constructor and by connecting.
class ProbePort final : public InputBase {
 public:
  /// As large as that of an input that asks for as many.
  static constexpr std::size_t kCapacity = 128;

  /// Precondition: capacity > 0.
  ProbePort(FrameworkElement& group, std::string name, const TypeInfo& type, std::size_t capacity = kCapacity);
  ~ProbePort() override;

  /// Shows the oldest value that waits to `visit`, and lets it go; false if none does. What `visit` is
  /// shown is gone when it returns. What `visit` throws is thrown, and the value gone all the same.
  bool Take(const Visitor& visit);
  /// The number of the channel from which the value came that was taken last: what is set by hand has another one than the
  /// output, and one that takes an output's place has the same. For the same thread.
  [[nodiscard]] std::uint64_t last_source() const noexcept { return last_source_; }
  /// Whether values come from that channel alone now. Under the structure lock.
  [[nodiscard]] bool IsFedBy(std::uint64_t source) const noexcept {
    return bound_.size() == 1 && bound_.front() == source;
  }
  /// How many values wait, about.
  [[nodiscard]] std::size_t waiting() const noexcept;
  [[nodiscard]] std::size_t capacity() const noexcept;

  [[nodiscard]] std::uint64_t dropped() const noexcept override;

 private:
  /// Notes it, too.
  [[nodiscard]] bool IsNewer(std::uint64_t sequence, std::uint64_t source) noexcept;
  QueueSink* Bind(const std::vector<Source>& sources) override;
  void TakeOverBinding(InputBase& from) noexcept override;
  void Bound() override;
  [[nodiscard]] bool HasNew() const override;

  std::unique_ptr<ProbeQueue> queue_;
  // Under the structure lock: the numbers of the channels it is bound to, and those that are new.
  std::vector<std::uint64_t> bound_;
  std::vector<ChannelBase*> fresh_;
  // The reader's own: the number of the last value taken from each channel. A value may lie in the
  // queue twice just after connecting.
  std::map<std::uint64_t, std::uint64_t> taken_;
  std::uint64_t last_source_ = 0;
};

}  // namespace runnel
