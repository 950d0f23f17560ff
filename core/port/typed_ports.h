#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/port/input.h"

namespace runnel {

class TypeInfo;

/// Values of one type, each held in a place of its own until it is dropped or another is put there: leases, of those
/// who know the type by its TypeInfo only.
///
/// Threads:     one at a time: the one that reads the inputs and publishes by the outputs. Ports are of the type.
/// Allocation:  none.
class HeldValues {
 public:
  virtual ~HeldValues() = default;

  /// Puts the newest value of the input into the place; false if the input had given it out before, or has none.
  virtual bool Read(Port& input, std::size_t place) noexcept = 0;
  /// Puts the next value that the input has not given out into the place: the oldest in its queue, if a connection has
  /// one, else the newest, as Read(). False if there is none, and then the place keeps what it has.
  virtual bool Next(Port& input, std::size_t place) noexcept = 0;
  /// Publishes what is in the place, without copying it (Output::Forward()). Errors: an empty place throws
  /// ProgrammingError.
  virtual PublishStatus Forward(Port& output, std::size_t place) = 0;
  virtual void Drop(std::size_t place) noexcept = 0;
  /// nullptr: the place is empty.
  [[nodiscard]] virtual const void* Find(std::size_t place) const noexcept = 0;
  /// Precondition: the place is not empty.
  [[nodiscard]] virtual ValueTimes times(std::size_t place) const = 0;
};

/// Ports for values of one type, made and used by those who know the type by its TypeInfo only: modules that pass on
/// whatever comes.
///
///     const TypedPorts* const ports = FindTypedPorts(*FindType("RangeScan"));
///     input = ports->MakeInput(InputGroup(), "in1");
///     output = ports->MakeOutput(OutputGroup(), "out");
///     held = ports->MakeHeldValues(1);
///     …
///     if (held->Read(*input, 0)) held->Forward(*output, 0);
class TypedPorts {
 public:
  [[nodiscard]] virtual std::unique_ptr<Port> MakeInput(FrameworkElement& group, std::string name,
                                                        InputOptions options = {}) const = 0;
  /// nullptr if only a module can make values of the type, which has no default constructor.
  [[nodiscard]] virtual std::unique_ptr<Port> MakeOutput(FrameworkElement& group, std::string name,
                                                         OutputOptions options = {}) const = 0;
  [[nodiscard]] virtual std::unique_ptr<HeldValues> MakeHeldValues(std::size_t places) const = 0;
  /// What an output and its readers share, without the output; nullptr as MakeOutput().
  [[nodiscard]] virtual std::unique_ptr<ChannelBase> MakeChannel() const = 0;

 protected:
  ~TypedPorts() = default;
};

/// nullptr until a first port of the type has been made, by whichever module. Any thread; locks.
[[nodiscard]] const TypedPorts* FindTypedPorts(const TypeInfo& type);

namespace internal {

void AddTypedPorts(const TypeInfo& type, const TypedPorts& ports);

template <typename T>
class HeldValuesOf final : public HeldValues {
 public:
  explicit HeldValuesOf(std::size_t places) : leases_(places) {}

  bool Read(Port& input, std::size_t place) noexcept override {
    leases_[place] = static_cast<Input<T>&>(input).Read();
    return leases_[place].is_new();
  }
  bool Next(Port& input, std::size_t place) noexcept override {
    auto& typed = static_cast<Input<T>&>(input);
    auto next = typed.has_queue() ? typed.Take() : typed.Read();
    if (!next.is_new()) return false;
    leases_[place] = std::move(next);
    return true;
  }
  PublishStatus Forward(Port& output, std::size_t place) override {
    return static_cast<Output<T>&>(output).Forward(leases_[place]);
  }
  void Drop(std::size_t place) noexcept override { leases_[place] = {}; }
  [[nodiscard]] const void* Find(std::size_t place) const noexcept override {
    return leases_[place].has_value() ? &*leases_[place] : nullptr;
  }
  [[nodiscard]] ValueTimes times(std::size_t place) const override { return leases_[place].times(); }

 private:
  std::vector<Lease<T>> leases_;
};

template <typename T>
class TypedPortsOf final : public TypedPorts {
 public:
  [[nodiscard]] std::unique_ptr<Port> MakeInput(FrameworkElement& group, std::string name,
                                                InputOptions options) const override {
    return std::make_unique<Input<T>>(group, std::move(name), std::move(options));
  }
  [[nodiscard]] std::unique_ptr<Port> MakeOutput(FrameworkElement& group, std::string name,
                                                 OutputOptions options) const override {
    if constexpr (std::is_default_constructible_v<T>) {
      return std::make_unique<Output<T>>(group, std::move(name), std::move(options));
    } else {
      return nullptr;
    }
  }
  [[nodiscard]] std::unique_ptr<ChannelBase> MakeChannel() const override { return Channel<T>::Make(); }
  [[nodiscard]] std::unique_ptr<HeldValues> MakeHeldValues(std::size_t places) const override {
    return std::make_unique<HeldValuesOf<T>>(places);
  }
};

/// Called when a port is made.
template <typename T>
[[gnu::noinline]] void MakeTypedPortsKnown() {
  static const TypedPortsOf<T> ports;
  static const bool are_known = (AddTypedPorts(TypeOf<T>(), ports), true);
  (void)are_known;
}

// Those of the usual types are compiled once, in the core: they are two fifths of what a port type costs.
extern template void MakeTypedPortsKnown<bool>();
extern template void MakeTypedPortsKnown<int>();
extern template void MakeTypedPortsKnown<float>();
extern template void MakeTypedPortsKnown<double>();
extern template void MakeTypedPortsKnown<std::string>();

}  // namespace internal

}  // namespace runnel
