#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fcntl.h>

#include "core/base/file_descriptor.h"
#include "core/base/result.h"
#include "plugins/wire/wire.h"
#include "plugins/wire_shared_memory/slot_hold.h"

namespace runnel {

/// Slots of a segment.
inline constexpr std::uint32_t kSlots = 64;
/// Of memory that others have open as well: nobody makes it shorter, which would end whoever looks.
inline constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;

/// Which slots of a segment one reader holds: a page of memory of its own, which the writer made and looks at.
class HoldTable {
 public:
  /// By the writer. Errors: of the system.
  static Result<std::shared_ptr<HoldTable>> Make();
  /// By the reader. Errors: it is no such memory, whoever has made it.
  static Result<std::unique_ptr<HoldTable>> Map(FileDescriptor file);
  ~HoldTable();

  [[nodiscard]] int descriptor() const noexcept { return file_.number(); }
  [[nodiscard]] SlotHold<>& operator[](std::uint32_t slot) const noexcept { return holds_[slot]; }

 private:
  HoldTable(FileDescriptor file, SlotHold<>* holds) : file_(std::move(file)), holds_(holds) {}

  const FileDescriptor file_;
  SlotHold<>* const holds_;
};

/// The readers of a segment, as its writer sees them. Threads: any.
class SegmentHolders {
 public:
  void Add(std::shared_ptr<const HoldTable> table) {
    const std::lock_guard lock(mutex_);
    tables_.push_back(std::move(table));
  }
  /// Of a reader that has ended, or reads no more: it holds nothing.
  void Remove(const HoldTable& table) {
    const std::lock_guard lock(mutex_);
    std::erase_if(tables_, [&](const auto& each) { return each.get() == &table; });
  }
  [[nodiscard]] bool Hold(std::uint32_t slot) const noexcept {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(tables_, [&](const auto& each) { return (*each)[slot].is_held(); });
  }
  [[nodiscard]] std::size_t count() const noexcept {
    const std::lock_guard lock(mutex_);
    return tables_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<const HoldTable>> tables_;
};

using SegmentId = std::array<std::byte, 16>;

/// Never twice, in whatever process.
[[nodiscard]] SegmentId NewSegmentId();

/// Where a value lies: what goes over the wire in the place of its octets.
struct SegmentPlace {
  SegmentId server{};  // who hands the segment out
  SegmentId segment{};
  std::uint64_t use = 0;   // of the slot
  std::uint64_t size = 0;  // octets
  std::uint32_t slot = 0;

  [[nodiscard]] std::shared_ptr<const Octets> ToOctets() const;
  /// Nothing if they are a value themselves.
  static std::optional<SegmentPlace> In(std::span<const std::byte> octets);
};

/// Memory that one process writes values to, and others of this machine read. It has no name: it is gone when nobody has it
/// open any more, however they end.
///
/// Each value lies in a slot, which is written to only while no reader holds it (slot_hold.h). Slots come into use as they are
/// needed: as many as readers hold, and kSpare besides, so that a value is there for a while before the next takes its place.
/// A value's encapsulation ends on a multiple of 64 octets, so that numbers are aligned in memory as in the message.
///
/// Threads: one at a time; holders() any.
class WrittenSegment {
 public:
  static constexpr std::uint32_t kSpare = 4;

  /// For values of up to `room` octets. Memory is taken as it is written to. Errors: of the system.
  static Result<std::unique_ptr<WrittenSegment>> Make(std::size_t room);
  ~WrittenSegment();

  [[nodiscard]] const SegmentId& id() const noexcept { return id_; }
  [[nodiscard]] int descriptor() const noexcept { return file_.number(); }
  [[nodiscard]] std::size_t room() const noexcept;
  /// Those who read it.
  [[nodiscard]] const std::shared_ptr<SegmentHolders>& holders() const noexcept { return holders_; }
  /// Nothing if all slots are held. Precondition: they have room. The server of the place is left out.
  [[nodiscard]] std::optional<SegmentPlace> Put(std::span<const std::byte> octets) noexcept;

 private:
  WrittenSegment(FileDescriptor file, std::byte* memory, std::size_t slot_size);
  // One that nobody holds, marked as being written.
  [[nodiscard]] std::optional<std::uint32_t> FindSlot(std::uint64_t use) noexcept;

  const FileDescriptor file_;
  std::byte* const memory_;
  const std::size_t slot_size_;
  const SegmentId id_ = NewSegmentId();
  const std::shared_ptr<SegmentHolders> holders_ = std::make_shared<SegmentHolders>();
  std::array<std::uint64_t, kSlots> uses_{};  // what has been written into each
  std::uint32_t in_use_ = 0;                  // the first so many
  std::uint64_t count_ = 0;
};

/// The same memory in a process that reads: it cannot be written there, nor made shorter by whoever has it. It stays as long
/// as anybody holds a value in it.
class ReadSegment : public std::enable_shared_from_this<ReadSegment> {
 public:
  /// `holds`: where the writer looks what is held; as long as `link` is open. Errors: it is no such memory, whoever has made it.
  static Result<std::shared_ptr<ReadSegment>> Map(const FileDescriptor& file, std::unique_ptr<HoldTable> holds,
                                                  FileDescriptor link);
  ~ReadSegment();

  /// The octets of the value, which stay as they are as long as anybody has what is returned; nullptr if the value has gone,
  /// never was there, or is held. One thread at a time. What is returned may be let go by any, and allocates a little.
  [[nodiscard]] std::shared_ptr<const std::byte> Hold(const SegmentPlace& place);
  /// How many values are held. Any thread.
  [[nodiscard]] std::uint32_t held() const noexcept { return held_.load(std::memory_order_relaxed); }

 private:
  ReadSegment(const std::byte* memory, std::size_t size, std::unique_ptr<HoldTable> holds, FileDescriptor link);
  void GiveBack(std::uint32_t slot) noexcept;

  const std::byte* const memory_;
  const std::size_t size_;
  std::size_t slot_size_ = 0;
  const std::unique_ptr<HoldTable> holds_;
  const FileDescriptor link_;
  std::atomic<std::uint32_t> held_{0};
};

}  // namespace runnel
