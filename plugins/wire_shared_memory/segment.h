#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/base/result.h"
#include "plugins/wire/wire.h"

namespace runnel {

using SegmentId = std::array<std::byte, 16>;

/// Never twice, in whatever process.
[[nodiscard]] SegmentId NewSegmentId();

/// An open file of this process, closed with it.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) noexcept : number_(number) {}
  Descriptor(Descriptor&& from) noexcept : number_(from.number_) { from.number_ = -1; }
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor();
  [[nodiscard]] int number() const noexcept { return number_; }
  [[nodiscard]] bool is_open() const noexcept { return number_ >= 0; }

 private:
  int number_;
};

/// Where a value lies: what goes over the wire in the place of its octets.
struct SegmentPlace {
  SegmentId server{};   // who hands the segment out
  SegmentId segment{};
  std::uint64_t use = 0;   // of the slot
  std::uint64_t size = 0;  // octets
  std::uint32_t slot = 0;

  [[nodiscard]] std::shared_ptr<const Octets> ToOctets() const;
  /// Nothing if they are a value themselves.
  static std::optional<SegmentPlace> In(std::span<const std::byte> octets);
};

/// Memory that one process writes values to, in turn into each of its slots, and others of this machine read. It has no
/// name: it is gone when nobody has it open any more, however they end.
///
///     slot's use:   2 n - 1 while value n is written into it, 2 n once it is there
///
/// Who reads looks whether the use is that which it was told of, reads, and looks again. So readers write nothing, hold
/// nothing, and keep nobody waiting; one that is slower than all the slots last finds that its value has gone.
///
/// Threads: one at a time.
class WrittenSegment {
 public:
  static constexpr std::uint32_t kSlots = 4;

  /// For values of up to `room` octets. Memory is taken as it is written to. Errors: of the system.
  static Result<std::unique_ptr<WrittenSegment>> Make(std::size_t room);
  ~WrittenSegment();
  WrittenSegment(const WrittenSegment&) = delete;
  WrittenSegment& operator=(const WrittenSegment&) = delete;

  [[nodiscard]] const SegmentId& id() const noexcept { return id_; }
  [[nodiscard]] int descriptor() const noexcept { return file_.number(); }
  [[nodiscard]] std::size_t room() const noexcept { return room_; }
  /// Precondition: they have room. The server of the place is left out.
  SegmentPlace Put(std::span<const std::byte> octets) noexcept;

 private:
  WrittenSegment(Descriptor file, std::byte* memory, std::size_t room);

  const Descriptor file_;
  std::byte* const memory_;
  const std::size_t room_;
  const SegmentId id_ = NewSegmentId();
  std::uint64_t count_ = 0;
};

/// The same memory in a process that reads: it cannot be written there, nor made shorter by whoever has it.
///
/// Threads: any.
class ReadSegment {
 public:
  /// Errors: it is no such memory, whoever has made it.
  static Result<std::unique_ptr<ReadSegment>> Map(const Descriptor& file);
  ~ReadSegment();
  ReadSegment(const ReadSegment&) = delete;
  ReadSegment& operator=(const ReadSegment&) = delete;

  /// Nothing if the value has gone, or never was there. The octets may change at any time.
  [[nodiscard]] std::optional<std::span<const std::byte>> Find(const SegmentPlace& place) const noexcept;
  /// Whether what has been read was the value.
  [[nodiscard]] bool IsStill(const SegmentPlace& place) const noexcept;

 private:
  ReadSegment(const std::byte* memory, std::size_t size, std::size_t room) : memory_(memory), size_(size), room_(room) {}

  const std::byte* const memory_;
  const std::size_t size_;
  const std::size_t room_;
};

}  // namespace runnel
