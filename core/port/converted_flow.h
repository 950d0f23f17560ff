#pragma once

#include <memory>
#include <vector>

#include "core/conversion/conversion.h"
#include "core/port/port.h"

namespace runnel::internal {

/// The values of one connection that are converted on their way. For each output that reaches it there is a
/// link, with a channel of its own, to which the inputs behind the connection are bound:
///
///     Output ── Channel ◀── link: probe, conversion, Channel ◀── Binding ── Input
///
/// The link is a subscriber of the output's channel: who publishes there takes the value out of the link's probe
/// at once, converts it, and publishes what it has become, with the same times. So queues, wakers and readers
/// of the newest value find in the link's channel what they would find in any, and outputs that no such
/// connection leads from know nothing of it.
///
/// Links are made and removed under the structure lock. Who connects may find a value that is there already
/// while its publisher brings the next: they take turns (TakingTurns), so that one at a time publishes. What a
/// publisher may still be in outlives the link, until nobody can see it (Retire()).
class ConvertedFlow {
 public:
  /// `first`: what readers find until something has come from its source.
  ConvertedFlow(std::shared_ptr<const Conversion> conversion, const Port& target, AnyValue first = {});
  ~ConvertedFlow();
  ConvertedFlow(const ConvertedFlow&) = delete;
  ConvertedFlow& operator=(const ConvertedFlow&) = delete;

  [[nodiscard]] const Conversion& conversion() const noexcept { return *conversion_; }
  /// How many values have become nothing.
  [[nodiscard]] std::uint64_t failures() const noexcept;
  /// Where it leads to.
  [[nodiscard]] const Port& target() const noexcept { return *target_; }
  void set_target(const Port& target) noexcept;

  /// The output of the link of `source`, made now if there is none and `makes`; nullptr if there is none then.
  [[nodiscard]] Port* OutputFor(Port& source, bool makes);
  /// Whether it is the output of one of the links.
  [[nodiscard]] bool Makes(const Port& output) const noexcept;
  /// What takes the values of `source`; nullptr if there is no such link.
  [[nodiscard]] Port* InputFor(const Port& source) const noexcept;
  /// Removes the links of those that are none of `sources`.
  void KeepOnly(const std::vector<Port*>& sources);

 private:
  class Worker;
  class LinkInput;
  struct Link;

  const std::shared_ptr<const Conversion> conversion_;
  const AnyValue first_;
  const Port* target_;
  std::vector<std::unique_ptr<Link>> links_;
};

/// What the values of `from` need on their way to `to`; nullptr if nothing.
[[nodiscard]] Result<std::shared_ptr<const Conversion>> ConversionBetween(const Port& from, const Port& to,
                                                                          const std::string& part,
                                                                          const std::string& name);

}  // namespace runnel::internal
