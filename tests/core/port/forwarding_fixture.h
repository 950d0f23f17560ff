#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "tests/core/port/pull_fixture.h"

namespace runnel::test {

/// Refers to memory of a driver; a copy of it would not keep that.
struct Frame {
  const char* pixels = nullptr;
  std::size_t size = 0;
};
inline void Describe(TypeBuilder<Frame>& type) { type.Name("test::Frame"); }

}  // namespace runnel::test

template <>
inline constexpr bool runnel::kIsInlined<runnel::test::Frame> = false;
template <>
inline constexpr bool runnel::kIsCopiedInQueues<runnel::test::Frame> = false;

namespace runnel::test {

/// Outputs of scans, each with a reader.
class ForwardingTest : public PortTest {
 protected:
  // Publishes a scan with this number; where it lies.
  static const Scan* Publish(Output<Scan>& output, int number) {
    auto loan = output.Loan();
    if (!loan) return nullptr;
    loan->number = number;
    loan->ranges.assign(20, static_cast<float>(number));
    const Scan* const written = &*loan;
    output.Publish(std::move(loan));
    return written;
  }
  struct Link {
    Sender<Scan>& sender;
    Receiver<Scan>& receiver;
  };
  // An output, and a reader of it.
  Link MakeLink(const std::string& name, const OutputOptions& options = {}) {
    Link link{MakeSender<Scan>(name, options), MakeReceiver<Scan>(name + "_reader")};
    Connect(link.sender.out, link.receiver.in);
    return link;
  }
  static inline const OutputOptions kFixed{.pool = {.buffers = 2, .may_grow = false}};
};

/// For who lives longer than all ports.
template <typename T>
std::shared_ptr<ValueOwner<T>> Of(ValueOwner<T>& owner) {
  return {std::shared_ptr<void>(), &owner};
}

/// The owner of some scans that notes which have come back.
class Ring final : public ValueOwner<Scan> {
 public:
  Ring() {
    for (int i = 0; i < 4; ++i) scans[static_cast<std::size_t>(i)] = {{static_cast<float>(i), 2.0F}, i};
  }
  void TakeBack(const Scan& scan) noexcept override { back.push_back(static_cast<int>(&scan - scans.data())); }
  std::array<Scan, 4> scans;
  std::vector<int> back;
};

}  // namespace runnel::test
