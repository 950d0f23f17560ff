#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/port/output.h"
#include "plugins/behaviours/meta_signal.h"

namespace runnel {

class Behaviour;

/// Something that a behaviour publishes only once its meta signals have been found to keep the rules.
class HeldBack {
 public:
  virtual ~HeldBack() = default;
  HeldBack(const HeldBack&) = delete;
  HeldBack& operator=(const HeldBack&) = delete;

 protected:
  explicit HeldBack(Behaviour& behaviour);

 private:
  friend class Behaviour;
  /// What has been set since the last call.
  virtual void Publish() = 0;
  virtual void Discard() = 0;
};

/// An output of a behaviour: what Behave() sets is published when the rules hold, and not at all when they do not.
///
///     ControlOutput<Twist2> twist{this, "twist"};
///     …
///     twist.Set({.forward = 0.3});
///
/// Ownership:   a member of its behaviour, as other ports are.
/// Threads:     as Output. Allocation: as Output.
template <typename T>
class ControlOutput final : public HeldBack {
 public:
  template <typename SomeBehaviour>
  ControlOutput(SomeBehaviour* behaviour, std::string name, OutputOptions options = {})
      : HeldBack(*behaviour), port(behaviour, std::move(name), std::move(options)) {}

  Output<T> port;

  /// The last one counts.
  void Set(const T& value) {
    if (!loan_) loan_ = port.Loan();
    if (loan_) *loan_ = value;
  }
  /// A buffer to fill, for values that are not to be copied; empty if a pool of fixed size is exhausted.
  [[nodiscard]] Loan<T>& Fill() {
    if (!loan_) loan_ = port.Loan();
    return loan_;
  }

 private:
  void Publish() override {
    if (loan_) port.Publish(std::exchange(loan_, {}));
  }
  void Discard() override { loan_ = {}; }

  Loan<T> loan_;
};

/// A part of a behaviour's activity, by which it stimulates or inhibits others. It stays as it was until
/// Behave() sets it again, and may not be greater than the activity.
class DerivedActivity final : public HeldBack {
 public:
  template <typename SomeBehaviour>
  DerivedActivity(SomeBehaviour* behaviour, std::string name, OutputOptions options = {})
      : HeldBack(*behaviour),
        port(behaviour, std::move(name), std::move(options)),
        behaviour_(behaviour),
        place_(AddTo(*behaviour)) {}

  Output<Activity> port;

  /// Between 0 and the activity.
  void Set(double value);

 private:
  using Place = std::size_t;
  static Place AddTo(Behaviour& behaviour);
  void Publish() override;
  void Discard() override {}

  Behaviour* const behaviour_;
  const Place place_;
};

}  // namespace runnel
