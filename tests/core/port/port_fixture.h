#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/port/proxy_port.h"

namespace runnel::test {

/// Travels in buffers, since it owns memory.
struct Scan {
  std::vector<float> ranges;
  int number = 0;
};
inline void Describe(TypeBuilder<Scan>& type) { type.Name("test::Scan"); }

/// Can be moved, not copied.
struct Token {
  std::unique_ptr<int> content;
};
inline void Describe(TypeBuilder<Token>& type) { type.Name("test::Token"); }

/// Can be neither copied nor moved, and has no default: only a factory makes it.
struct Sealed {
  explicit Sealed(int made_as) : number(made_as) {}
  Sealed(const Sealed&) = delete;
  Sealed& operator=(const Sealed&) = delete;
  int number;
};
inline void Describe(TypeBuilder<Sealed>& type) { type.Name("test::Sealed"); }

/// Plain, but too large to be copied in each cycle.
struct Image {
  std::array<char, 1000> pixels{};
};
inline void Describe(TypeBuilder<Image>& type) { type.Name("test::Image"); }

/// Small and plain, but asks to travel in buffers (below).
struct Stubborn {
  int number = 0;
};
inline void Describe(TypeBuilder<Stubborn>& type) { type.Name("test::Stubborn"); }

}  // namespace runnel::test

template <>
inline constexpr bool runnel::kIsInlined<runnel::test::Stubborn> = false;

namespace runnel::test {

/// How often an executor would have been told.
class CountingWaker final : public Waker {
 public:
  void Wake() noexcept override { ++wakes; }
  int wakes = 0;
};

/// An element to hang ports below.
class Box : public FrameworkElement {
 public:
  explicit Box(const Placement& placement) : FrameworkElement(placement) {}
};

template <typename T>
class Sender final : public Box {
 public:
  explicit Sender(const Placement& placement, OutputOptions options = {}, typename Output<T>::Factory factory = {})
      : Box(placement), out(*this, "out", std::move(options), std::move(factory)) {}
  Output<T> out;
};

template <typename T>
class Receiver final : public Box {
 public:
  explicit Receiver(const Placement& placement, InputOptions options = {})
      : Box(placement), in(*this, "in", std::move(options)) {}
  Input<T> in;
};

class PortTest : public testing::Test {
 protected:
  PortTest() { runtime.set_clock(clock); }

  template <typename T>
  Sender<T>& MakeSender(const std::string& name = "sender", OutputOptions options = {}) {
    return runtime.Create<Sender<T>>(runtime.root(), name, std::move(options));
  }
  template <typename T>
  Receiver<T>& MakeReceiver(const std::string& name = "receiver", InputOptions options = {}) {
    return runtime.Create<Receiver<T>>(runtime.root(), name, std::move(options));
  }
  static void Connect(Port& from, Port& to, const ConnectOptions& options = {}) {
    const auto connected = Port::Connect(from, to, options);
    ASSERT_TRUE(connected) << connected.error().ToString();
  }

  ManualClock clock;
  Runtime runtime;
};

template <typename T>
std::vector<T> TakeAll(Input<T>& input) {
  std::vector<T> values;
  input.Drain([&](const Lease<T>& lease) { values.push_back(*lease); });
  return values;
}

}  // namespace runnel::test
